// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phases of traced replies at many places about the one that they were traced to, a tile of places
/// at a time: the inner loop of the search in a known world.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/grid_search.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// A reply in single precision, with its sources relative to a middle.
struct NearReply {
  struct Wave {
    float x = 0.0f, y = 0.0f, z = 0.0f;  ///< Source [m].
    float in_phase = 0.0f, quadrature = 0.0f;
    float amplitude = 0.0f;
    bool direct = false;
  };
  std::vector<Wave> forward, backward;
  float turns_per_metre = 0.0f;  ///< 1/λ of the carrier.
};

NearReply near_reply(const TracedReply& reply, const Eigen::Vector3d& middle, double carrier_hz);

/// By place of a tile.
struct ReplyPhasors {
  // Cosine and sine of the reply's phase as it is measured, −arg of forth and back: 2k|p − p_WA|
  // and the bend.
  Tile in_phase = Tile::Zero();
  Tile quadrature = Tile::Zero();
  /// The lesser share of the direct path's amplitude in the sum of all paths', forth and back; 0
  /// where it is blocked.
  Tile directness = Tile::Zero();
  Tile slope = Tile::Zero();  ///< Of the bend: by how much 1/2k of it grows with the place [m/m].
};

/// At places (x, y, z) relative to the reply's middle [m]. The same to the last bit for each set of
/// instructions; phasors to 10⁻³ where sources are within 100 m.
ReplyPhasors reply_phasors(const NearReply& reply, const Tile& x, const Tile& y, const Tile& z,
                           InstructionSet set = instruction_sets().back());

}  // namespace tagfield
