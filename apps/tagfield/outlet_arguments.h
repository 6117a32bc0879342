// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a run goes besides its folder: into ROS 2, or a file of its messages.
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
  std::string mcap;  ///< File to record into, or "".
};

/// What a run has besides its outlets.
struct RunOutlets {
  std::vector<std::shared_ptr<ros2::MessageSink>> sinks;  ///< To be finished after the run.
  std::optional<RemoteDriving> driving;  ///< Of the robot that is driven from outside, if one is.
};

void add_outlet_options(CLI::App& command, OutletArguments& arguments);

/// Sets the pace of a run that others listen to: that of the command line, or else of real time
/// unless the scenario names one. Where somebody outside drives, poses are believed by the wheels,
/// whatever the scenario says: nobody in here maps, or knows better.
void apply(const OutletArguments& arguments, Scenario& scenario);

/// Attaches what was asked for, and waits a moment for those who listen already. Throws Error where
/// the domain can't be joined, or a robot is to be driven that is not there.
RunOutlets attach_outlets(const OutletArguments& arguments, const ScenarioWithWorld& loaded,
                          RunControl& control);

}  // namespace tagfield
