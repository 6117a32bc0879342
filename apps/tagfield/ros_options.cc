// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/ros_options.h"

#include "apps/tagfield/number_checks.h"
#include "tagfield/base/error.h"

namespace tagfield {

void add_ros_options(CLI::App& command, RosOptions& options) {
  command.add_option(
      "--frame", options.frame,
      "With a recording of ROS: fixed frame of tf (default: the first of map, world, "
      "odom that can express the antennas)");
  command
      .add_option("--frequency", options.frequency_hz,
                  "With a bag of rfid_sensor/TagArray: the carrier [Hz] (default 865.7e6)")
      ->check(fault_of_carrier);
}

void refuse_ros_options(const std::string& command, const RosOptions& options) {
  if (!options.frame.empty()) {
    throw Error(command + ": --frame can only be used with a recording of ROS");
  }
  if (options.frequency_hz) {
    throw Error(command + ": --frequency can only be used with a recording of ROS");
  }
}

}  // namespace tagfield
