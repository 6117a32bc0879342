// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of a Gazebo 11 world or model with Tagfield's plugins to gz-sim.
#pragma once

#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

/// How to write the world, as opposed to its contents.
struct GzSimOptions {
  std::string mcap;           ///< File to record the run to; "" for none.
  bool stops_at_end = false;  ///< The server exits when the first robot finishes its path.
};

/// The text of an SDF file for gz-sim (Fortress and later), converted from that of a Gazebo 11
/// world or model:
///
///   sensors `rfid`, `rfidtag` with the plugins   → custom sensors `rfid_antenna`, `rfid_tag`
///   TagfieldTagSetPlugin on a model              → a custom sensor `rfid_tag_set` on its link
///   TagfieldMaterialsPlugin on the world         → the world's tagfield::systems::Rfid
///   TagfieldRobotPlugin                          → gz-sim's DiffDrive; with a path, also Waypoints
///   TagfieldLiftPlugin                           → tagfield::systems::Lift
///   sensors `ray`                                → `gpu_lidar`
///
/// Gz-sim's systems for physics, commands and the scene are added to a world, unless it has gz-sim
/// plugins already. Anything without a counterpart is left out with a warning. `file` is the name
/// of the source, for messages. Throws Error if the text is not SDF.
std::string gz_sim_world(const std::string& text, const std::string& file,
                         const GzSimOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
