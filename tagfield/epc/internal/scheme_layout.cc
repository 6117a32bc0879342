// SPDX-License-Identifier: Apache-2.0
#include "tagfield/epc/internal/scheme_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

using S = EpcScheme;

constexpr std::array<SchemeLayout, 11> kLayouts = {{
    {S::kSgtin, "sgtin", 0x30, "item reference", 44, 13, true, "serial number", 38},
    {S::kSscc, "sscc", 0x31, "serial reference", 58, 17, true, "", 0},
    {S::kSgln, "sgln", 0x32, "location reference", 41, 12, true, "extension", 41},
    {S::kGrai, "grai", 0x33, "asset type", 44, 12, true, "serial number", 38},
    {S::kGiai, "giai", 0x34, "individual asset reference", 82, 25, false, "", 0},
    {S::kGsrn, "gsrn", 0x2D, "service reference", 58, 17, true, "", 0},
    {S::kGsrnp, "gsrnp", 0x2E, "service reference", 58, 17, true, "", 0},
    {S::kGdti, "gdti", 0x2C, "document type", 41, 12, true, "serial number", 41},
    {S::kCpi, "cpi", 0x3C, "component or part reference", 51, 15, false, "serial number", 31},
    {S::kGid, "gid", 0x35, "", 0, 0, false, "serial number", 36},
    {S::kUsdod, "usdod", 0x2F, "", 0, 0, false, "serial number", 36},
}};

template <class Predicate>
const SchemeLayout* find_layout(const Predicate& is_it) {
  const auto* const found = std::find_if(kLayouts.begin(), kLayouts.end(), is_it);
  return found == kLayouts.end() ? nullptr : found;
}

bool is_decimal(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

const SchemeLayout& layout_of(EpcScheme scheme) {
  return *find_layout([scheme](const SchemeLayout& layout) { return layout.scheme == scheme; });
}

const SchemeLayout* layout_named(std::string_view name) {
  return find_layout([name](const SchemeLayout& layout) { return layout.name == name; });
}

const SchemeLayout* layout_of_header(std::uint8_t header) {
  return find_layout([header](const SchemeLayout& layout) { return layout.header == header; });
}

std::string scheme_names() {
  std::string names;
  for (const SchemeLayout& layout : kLayouts) {
    names += names.empty() ? "" : ", ";
    names += layout.name;
  }
  return names;
}

std::uint64_t number_of(const DecimalField& field, const std::string& text) {
  const auto length = static_cast<int>(text.size());
  if (field.is_padded) {
    if (length != field.digits || (length > 0 && !is_decimal(text))) {
      throw Error(fmt::format("{} '{}' must be {} digits", field.name, text, field.digits));
    }
    if (length == 0) return 0;
  } else if (!is_decimal(text) || (length > 1 && text.front() == '0')) {
    throw Error(fmt::format("{} '{}' must be a number without leading zeros to fit into 96 bits",
                            field.name, text));
  }
  std::uint64_t number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc{} || length > field.digits || number >> field.bits != 0) {
    throw Error(fmt::format("{} '{}' does not fit into {} bits and {} digits", field.name, text,
                            field.bits, field.digits));
  }
  return number;
}

std::optional<std::string> text_of(const DecimalField& field, std::uint64_t number) {
  if (field.digits == 0) return number == 0 ? std::optional<std::string>("") : std::nullopt;
  std::string text =
      field.is_padded ? fmt::format("{:0{}}", number, field.digits) : fmt::format("{}", number);
  if (static_cast<int>(text.size()) > field.digits) return std::nullopt;
  return text;
}

}  // namespace tagfield
