// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario's robots, each with whoever drives it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/internal/self_driving.h"
#include "tagfield/simulator/remote_driver.h"
#include "tagfield/simulator/robot.h"

namespace tagfield {

/// In the scenario's order. Throws Error where two have one name, and where none has the name of
/// the one to be driven from outside.
std::vector<Robot> robots_of(const Scenario& scenario, std::uint64_t seed,
                             const SelfDriving* driving, const RemoteDriving* remote);

/// None where there is no such robot.
const Robot* robot_named(const std::vector<Robot>& robots, const std::string& name);

/// Throws Error, at `location`, where a robot is named and there is no such robot.
void require_robot(const std::vector<Robot>& robots, const std::string& name,
                   const Location& location);

/// Share done by the slowest, 0 to 1; 1 without robots.
double progress_of(const std::vector<Robot>& robots);

/// Path driven by all of them [m].
double travelled_by(const std::vector<Robot>& robots);

}  // namespace tagfield
