#include "tagfield/base/number.h"

#include <locale.h>
#include <stdlib.h>

#include <cmath>

namespace tagfield {

std::optional<double> parse_number(const std::string& text) {
  // std::from_chars reads no double before GCC 11, and std::strtod obeys the process's locale.
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string::npos) return {};
  char* after = nullptr;
  const double value = strtod_l(text.c_str(), &after, plain);
  if (after != text.c_str() + text.size() || !std::isfinite(value)) return {};
  return value;
}

}  // namespace tagfield
