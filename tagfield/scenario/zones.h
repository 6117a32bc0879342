// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which reader a tag is meant for: by the zone that it is in, or by what comes nearest.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

struct Scenario;

/// A part of the hall, such as a dock door or a shelf, and the readers that shall read it.
struct ZoneSpec {
  std::string name;
  Eigen::AlignedBox3d box_W;         ///< [m]; unbounded in z where the scenario gives no heights.
  std::vector<std::string> readers;  ///< Names as of reader_groups(); none: nobody's.
  Location location;                 ///< Where it was written, for messages.
};

/// Who reads by each of the scenario's antennas: the antenna's reader, or where it rides on a robot
/// the robot, whose antennas pass the same tags on the same way.
std::vector<std::string> reader_groups(const Scenario& scenario);

/// Each of `names` once, in the order in which they come.
std::vector<std::string> distinct(const std::vector<std::string>& names);

/// Throws Error where a zone names a reader that no antenna belongs to.
void require_readers_of_zones(const Scenario& scenario);

/// The first of the zones that holds `p_W`; their count where none does.
std::size_t zone_at(const std::vector<ZoneSpec>& zones, const Eigen::Vector3d& p_W);

}  // namespace tagfield
