// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options for ROS recordings only.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace tagfield {

struct RosOptions {
  std::string frame;  ///< Fixed frame of its transforms, or "".
  std::optional<double> frequency_hz;
};

/// Adds --frame and --frequency.
void add_ros_options(CLI::App& command, RosOptions& options);

/// Throws Error "COMMAND: …" if one of them is given.
void refuse_ros_options(const std::string& command, const RosOptions& options);

}  // namespace tagfield
