/// @file
/// A scenario's robots, each with whoever drives it.
#pragma once

#include <cstdint>
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

}  // namespace tagfield
