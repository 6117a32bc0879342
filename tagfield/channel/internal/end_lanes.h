// SPDX-License-Identifier: Apache-2.0
/// @file
/// One end of many paths in lanes: its pattern and polarization in the directions of the paths.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>

#include "tagfield/base/lanes.h"
#include "tagfield/channel/free_space_gains.h"

namespace tagfield::channel_internal {

/// The antenna's axes in W, the same for all links. Passed by value, so that loops keep it in
/// registers.
struct AntennaFrame {
  Eigen::Vector3d boresight;
  Eigen::Vector3d left;
  Eigen::Vector3d up;
};

/// The columns of a rotation matrix; Eigen's function doesn't guarantee a fixed order of summation.
AntennaFrame frame_of(const Eigen::Quaterniond& q);

/// A wire along of_left·left + of_up·up.
struct Wire {
  double of_left;
  double of_up;
};
Wire wire_of(const AntennaPattern& pattern);

/// Whether the end's field is that of a single wire, not of two crossed ones.
bool has_wire(const AntennaPattern& pattern);

/// Whether its gain depends on the direction other than by the angle to its wire, or its field is
/// that of crossed wires.
bool needs_frame(const AntennaPattern& pattern, const ChannelEffects& effects);

/// 1 for right-handed circular polarization, -1 for left-handed: crossed wires are along up +
/// j·hand·left.
double hand_of(const AntennaPattern& pattern);

/// The factors of one end for each link.
struct EndLanes {
  StraightLinks::Vectors way_own;  ///< Direction from this end, in its frame, if needs_frame().
  StraightLinks::Lane along_wire;  ///< Cosine of the angle between the direction from this end and
                                   ///< the wire, if has_wire().
  StraightLinks::Lane power;       ///< Gain multiplied by
  StraightLinks::Lane divisor;     ///< this, so that one division serves both ends.
};

/// Sets `power` and `divisor` of the first `count` paths.
void add_gains(const AntennaPattern& pattern, const ChannelEffects& effects, InstructionSet set,
               std::size_t count, EndLanes& end);

}  // namespace tagfield::channel_internal
