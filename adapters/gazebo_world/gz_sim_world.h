// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world or a model of Gazebo 11 with Tagfield's plugins as one of gz-sim.
#pragma once

#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

/// How to write it, as opposed to what is in it.
struct GzSimOptions {
  std::string mcap;           ///< File that the run is recorded to; "" for none.
  bool stops_at_end = false;  ///< The server ends with the first robot's path.
};

/// The text of an SDF file for gz-sim (Fortress and later), of that of a Gazebo 11 world or model:
///
///   sensors `rfid`, `rfidtag` with the plugins   → custom sensors `rfid_antenna`, `rfid_tag`
///   TagfieldTagSetPlugin on a model              → a custom sensor `rfid_tag_set` on its link
///   TagfieldMaterialsPlugin on the world         → the world's tagfield::systems::Rfid
///   TagfieldRobotPlugin                          → gz-sim's DiffDrive, and Waypoints where it has
///   a path TagfieldLiftPlugin                           → tagfield::systems::Lift sensors `ray` →
///   `gpu_lidar`
///
/// A world gets gz-sim's systems for physics, commands and the scene, unless it has plugins of
/// gz-sim already. What has no counterpart is left out with a warning. `file` is its name, for
/// messages. Throws Error if the text is no SDF.
std::string gz_sim_world(const std::string& text, const std::string& file,
                         const GzSimOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
