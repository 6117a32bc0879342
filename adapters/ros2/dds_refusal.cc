// SPDX-License-Identifier: Apache-2.0
// Replaces dds_sink.cc in builds without DDS.
#include "adapters/ros2/dds_sink.h"
#include "tagfield/base/error.h"

namespace tagfield::ros2 {

const bool kHasDds = false;

struct DdsSink::Impl {};

DdsSink::DdsSink(std::uint32_t /*domain*/, const std::string& /*node_name*/) {
  throw Error(
      "this tagfield was built without ROS 2; build it again after 'scripts/setup --ros' "
      "(TAGFIELD_ROS2)");
}

DdsSink::~DdsSink() = default;
std::size_t DdsSink::advertise(const Ros2Topic& /*topic*/, const Ros2Type& /*type*/) { return 0; }
void DdsSink::publish(std::size_t /*topic*/, Time /*stamp*/, const void* /*message*/) {}
void DdsSink::finish() {}
std::size_t DdsSink::subscribe_twist(const std::string& /*topic*/) { return 0; }
std::optional<geometry_msgs::Twist> DdsSink::take_twist(std::size_t /*subscription*/) {
  return std::nullopt;
}
bool DdsSink::wait_for_reader(Duration /*most*/) const { return false; }

}  // namespace tagfield::ros2
