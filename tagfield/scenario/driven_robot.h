// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot of a scenario that is driven from outside.
#pragma once

#include <string>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Lets the robot be driven from outside, so that it believes its wheel odometry. The other robots
/// keep the scenario's pose source, unless that is their own map: nobody maps while a robot is
/// driven. Warns of what then does not hold as the scenario states it.
void let_be_driven(const std::string& robot, Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
