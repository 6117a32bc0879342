// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/domain.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>

#include "tagfield/base/error.h"
#include "tagfield/base/number.h"

namespace tagfield::ros2 {

std::uint32_t domain_in(const std::string& text, const std::string& place) {
  const std::optional<double> number = parse_number(text);
  if (!number || *number < 0.0 || *number > kLastDomain ||
      *number != static_cast<double>(static_cast<std::uint32_t>(*number))) {
    throw Error(fmt::format("{} is '{}', expected a whole number from 0 to {:g}", place, text,
                            kLastDomain));
  }
  return static_cast<std::uint32_t>(*number);
}

std::uint32_t domain_of_environment() {
  const char* const text = std::getenv("ROS_DOMAIN_ID");
  return text == nullptr || *text == '\0' ? 0 : domain_in(text, "ROS_DOMAIN_ID");
}

}  // namespace tagfield::ros2
