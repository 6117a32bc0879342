/// @file
/// Where a run goes besides its folder: into ROS 2.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "adapters/ros2/dds_sink.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

struct Ros2Arguments {
  bool ros2 = false;
  std::optional<std::uint32_t> domain;
  std::optional<double> speed;
};

void add_ros2_options(CLI::App& command, Ros2Arguments& arguments);

/// Sets the pace of a run that others listen to: that of the command line, or else of real time
/// unless the scenario names one.
void set_pace(const Ros2Arguments& arguments, Scenario& scenario);

/// Attaches what was asked for, and waits a moment for those who listen already; null for nothing.
/// Throws Error where the domain can't be joined.
std::shared_ptr<ros2::DdsSink> attach_ros2(const Ros2Arguments& arguments, Outlets& outlets);

}  // namespace tagfield
