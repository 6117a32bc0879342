// SPDX-License-Identifier: Apache-2.0
/// @file
/// One-way gains of the direct paths from an antenna to many tags.
#pragma once

#include <array>
#include <complex>
#include <span>

#include "tagfield/base/lanes.h"
#include "tagfield/channel/path_gain.h"

namespace tagfield {

/// Batch size at which all data of a batch stays in the L1 cache.
inline constexpr std::size_t kStraightLinks = 64;

/// One element per link.
struct StraightLinks {
  using Lane = std::array<double, kStraightLinks>;
  struct Vectors {
    Lane x;
    Lane y;
    Lane z;
  };
  Lane re;  ///< The complex amplitude gain,
  Lane im;
  Lane power_db;  ///< and its squared magnitude as given by to_db().
  /// −∂ arg h/∂p_WA [rad/m]: a vector towards the antenna whose length is the wave number. 0 where
  /// the gain is 0.
  Vectors slope_W;
};

/// A tag's orientation and position, stored elsewhere.
struct PoseRef {
  const Eigen::Quaterniond* R_WT;
  const Eigen::Vector3d* p_WT;
};

/// free_space_gain() between `antenna` and each of the tags, all with the same pattern, at most
/// kStraightLinks of them. Relative accuracy 1e-12; a link's result is bit-identical whatever else
/// is in the batch and whatever the instruction set.
void free_space_gains(const RadioEnd& antenna, const AntennaPattern& tag,
                      std::span<const PoseRef> tags, const Carrier& carrier,
                      const ChannelEffects& effects, StraightLinks& links,
                      InstructionSet set = instruction_sets().back());

}  // namespace tagfield
