// SPDX-License-Identifier: Apache-2.0
/// @file
/// One-way gains of the straight ways from an antenna to many tags.
#pragma once

#include <array>
#include <complex>
#include <span>

#include "tagfield/base/lanes.h"
#include "tagfield/channel/path_gain.h"

namespace tagfield {

/// So many links at a time that all of theirs stays in the nearest cache.
inline constexpr std::size_t kStraightLinks = 64;

/// Of a link each.
struct StraightLinks {
  using Lane = std::array<double, kStraightLinks>;
  struct Vectors {
    Lane x;
    Lane y;
    Lane z;
  };
  Lane re;  ///< The amplitude gain,
  Lane im;
  Lane power_db;  ///< and its square, as to_db() has it.
  /// −∂ arg h/∂p_WA [rad/m]: the wave number, towards the antenna. 0 where there is no gain.
  Vectors slope_W;
};

/// Where a tag is and how it lies, wherever that is kept.
struct PoseRef {
  const Eigen::Quaterniond* R_WT;
  const Eigen::Vector3d* p_WT;
};

/// free_space_gain() of `antenna` and each of the tags, all of one pattern, at most kStraightLinks
/// of them, within 1e-12 of its length; the same bits whatever else is in the batch and whatever
/// the instruction set.
void free_space_gains(const RadioEnd& antenna, const AntennaPattern& tag,
                      std::span<const PoseRef> tags, const Carrier& carrier,
                      const ChannelEffects& effects, StraightLinks& links,
                      InstructionSet set = instruction_sets().back());

}  // namespace tagfield
