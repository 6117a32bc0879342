// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/number_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "tagfield/base/number.h"
#include "tagfield/base/read_range.h"
#include "tagfield/files/units_seen.h"

namespace tagfield {
namespace {

std::string fault_of_nan(const std::string& word) {
  if (!std::isnan(std::strtod(word.c_str(), nullptr))) return "";
  return fmt::format("'{}' is not a number", word);
}

}  // namespace

std::string fault_of_positive(const std::string& word) {
  const auto number = parse_number(word);
  if (number && *number > 0.0) return "";
  return fmt::format("'{}' is not a number greater than 0", word);
}

std::string fault_of_non_negative(const std::string& word) {
  const auto number = parse_number(word);
  if (number && *number >= 0.0) return "";
  return fmt::format("'{}' is not 0 or a greater number", word);
}

std::string fault_of_carrier(const std::string& word) {
  const auto number = parse_number(word);
  if (number && is_carrier(*number)) return "";
  return fmt::format("'{}' is not a carrier in Hz, from {:g} to {:g}{}", word, kMinCarrierHz,
                     kMaxCarrierHz, number ? likely_unit(*number) : "");
}

void refuse_nan(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_name().rfind("FLOAT", 0) == 0) option->check(fault_of_nan);
  }
  for (CLI::App* command : app.get_subcommands({})) refuse_nan(*command);
}

}  // namespace tagfield
