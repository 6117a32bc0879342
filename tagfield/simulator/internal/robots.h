// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario's robots, each with its driver.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/internal/self_driving.h"
#include "tagfield/simulator/remote_driver.h"
#include "tagfield/simulator/robot.h"

namespace tagfield {

/// All robots, in the scenario's order. Throws Error if two have the same name, or if none has the
/// name of the one to be driven remotely.
std::vector<Robot> robots_of(const Scenario& scenario, std::uint64_t seed,
                             const SelfDriving* driving, const RemoteDriving* remote);

/// Null if there is no such robot.
const Robot* robot_named(const std::vector<Robot>& robots, const std::string& name);

/// Throws Error, at `location`, if `name` is not empty and there is no such robot.
void require_robot(const std::vector<Robot>& robots, const std::string& name,
                   const Location& location);

/// Progress of the slowest one, 0 to 1; 1 without robots.
double progress_of(const std::vector<Robot>& robots);

/// Distance driven by all of them [m].
double travelled_by(const std::vector<Robot>& robots);

}  // namespace tagfield
