#include "tagfield/base/require.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"

namespace tagfield {

void require_positive(double value, const std::string& name) {
  if (std::isfinite(value) && value > 0.0) return;
  throw Error(fmt::format("{} must be finite and over 0, but is {}", name, value));
}

}  // namespace tagfield
