// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/range_check.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"

namespace tagfield {

void require(bool holds, std::string_view name, std::string_view expected, double value) {
  if (!holds) throw Error(fmt::format("{} must be {}, is {:g}", name, expected, value));
}

void require_in_range(std::string_view name, double value, double least, double most,
                      std::string_view unit) {
  if (value >= least && value <= most) return;
  throw Error(fmt::format("{} must be from {:g} to {:g}{}{}, is {:g}", name, least, most,
                          unit.empty() ? "" : " ", unit, value));
}

void require_positive(std::string_view name, double value) {
  require(value > 0.0 && std::isfinite(value), name, "a finite number greater than 0", value);
}

void require_not_negative(std::string_view name, double value) {
  require(value >= 0.0 && std::isfinite(value), name, "a finite number, 0 or more", value);
}

}  // namespace tagfield
