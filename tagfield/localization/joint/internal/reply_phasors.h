// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phases of traced replies at many points near the one that they were traced to, a tile of points
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

/// Values at each point of a tile.
struct ReplyPhasors {
  // Cosine and sine of the reply's phase as measured, −arg of the forward and backward field: 2k|p
  // − p_WA| plus the bend.
  Tile in_phase = Tile::Zero();
  Tile quadrature = Tile::Zero();
  /// Share of the direct path's amplitude in the sum over all paths, the lesser of forward and
  /// backward; 0 if it is blocked.
  Tile directness = Tile::Zero();
  Tile slope = Tile::Zero();  ///< Gradient magnitude of bend/2k [m/m].
};

/// Phasors at points (x, y, z) relative to the reply's middle [m]. Bit-identical for every
/// instruction set; accurate to 10⁻³ if sources are within 100 m.
ReplyPhasors reply_phasors(const NearReply& reply, const Tile& x, const Tile& y, const Tile& z,
                           InstructionSet set = instruction_sets().back());

}  // namespace tagfield
