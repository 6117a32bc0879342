// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/number.h"

#include <locale.h>
#include <stdlib.h>

#include <charconv>
#include <cmath>
#include <system_error>

namespace tagfield {

std::optional<double> parse_number(const std::string& text) {
#ifdef __cpp_lib_to_chars
  // Handles most numbers; but std::from_chars accepts no '+', and reports underflow and overflow
  // alike.
  double plain_value = 0.0;
  const char* end = text.data() + text.size();
  const auto [parsed, problem] = std::from_chars(text.data(), end, plain_value);
  if (problem == std::errc{} && parsed == end && std::isfinite(plain_value)) return plain_value;
#endif
  // std::from_chars for double needs GCC 11, and std::strtod obeys the process's locale.
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string::npos) return {};
  char* after = nullptr;
  const double value = strtod_l(text.c_str(), &after, plain);
  if (after != text.c_str() + text.size() || !std::isfinite(value)) return {};
  return value;
}

}  // namespace tagfield
