// SPDX-License-Identifier: Apache-2.0
/// @file
/// Outputs of a run besides its folder: ROS 2, or a file of its messages.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "adapters/ros2/dds_sink.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/simulator/remote_driver.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

struct OutletArguments {
  bool ros2 = false;
  std::optional<std::uint32_t> domain;
  std::optional<double> speed;
  std::string drive;
  std::string mcap;  ///< File to record to, or "".
};

/// Further parts of a run besides its outlets.
struct RunOutlets {
  std::vector<std::shared_ptr<ros2::MessageSink>> sinks;  ///< To be finished after the run.
  std::optional<RemoteDriving> driving;  ///< Of the externally driven robot, if any.
};

void add_outlet_options(CLI::App& command, OutletArguments& arguments);

/// Sets the speed of a run: that of the command line, or else, with ROS 2, real time unless the
/// scenario states one. If a robot is driven externally, its poses are by odometry, whatever the
/// scenario states: nothing else in here estimates them (let_be_driven()).
void apply(const OutletArguments& arguments, Scenario& scenario, Diagnostics& diagnostics);

/// Attaches the requested outlets, and waits a moment for existing subscribers. Throws Error if the
/// domain can't be joined, or the robot to be driven does not exist.
RunOutlets attach_outlets(const OutletArguments& arguments, const ScenarioWithWorld& loaded,
                          RunControl& control);

}  // namespace tagfield
