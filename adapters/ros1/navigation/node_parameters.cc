// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include "adapters/ros1/navigation/node_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

template <class Value>
Value value_of(const ros::NodeHandle& node, const std::string& name, const Value& fallback,
               const char* expected) {
  Value value = fallback;
  if (node.hasParam(name) && !node.getParam(name, value)) {
    throw Error(fmt::format("parameter {}: expected {}", node.resolveName(name), expected));
  }
  return value;
}

}  // namespace

std::string NodeParameters::text(const std::string& name, const std::string& fallback) const {
  return value_of(node_, name, fallback, "a text");
}

bool NodeParameters::flag(const std::string& name, bool fallback) const {
  return value_of(node_, name, fallback, "true or false");
}

double NodeParameters::number(const std::string& name, double fallback) const {
  const double value = value_of(node_, name, fallback, "a number");
  if (std::isfinite(value)) return value;
  throw Error(fmt::format("parameter {}: is {}", node_.resolveName(name), value));
}

double NodeParameters::positive(const std::string& name, double fallback) const {
  const double value = number(name, fallback);
  if (value > 0.0) return value;
  throw Error(fmt::format("parameter {}: is {}, expected > 0", node_.resolveName(name), value));
}

int NodeParameters::count(const std::string& name, int fallback) const {
  const int value = value_of(node_, name, fallback, "a whole number");
  if (value > 0) return value;
  throw Error(fmt::format("parameter {}: is {}, expected > 0", node_.resolveName(name), value));
}

PlanarPose NodeParameters::initial_pose() const {
  return {number("initial_pose_x", 0.0), number("initial_pose_y", 0.0),
          number("initial_pose_a", 0.0)};
}

}  // namespace tagfield
