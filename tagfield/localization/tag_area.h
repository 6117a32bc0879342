// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where tags can be: on one side of the antennas' way, or in a box. From a straight way a tag and
/// its mirror image look alike; what is known of the place tells them apart.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Of the antennas' way: as one goes along it, or towards an axis of the world.
enum class TagSide { kLeft, kRight, kPlusX, kMinusX, kPlusY, kMinusY };

/// Its words, in the order of its values.
inline const std::vector<std::string> kTagSides = {"left", "right", "+x", "-x", "+y", "-y"};

/// Of one of these words; throws Error on another.
TagSide tag_side(const std::string& word);

/// Nothing told: anywhere.
struct TagArea {
  std::optional<TagSide> side;
  std::optional<Eigen::AlignedBox2d> box;  ///< Seen from above [m, world].
};

/// Whether a tag may be at `p`, beside the line through `middle` in the direction `along`.
bool is_within(const TagArea& area, const Eigen::Vector2d& middle, const Eigen::Vector2d& along,
               const Eigen::Vector2d& p);

/// The line along which antennas went, by their places: middle, and the direction of the longest
/// extent from the first place on.
struct WayLine {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
};
WayLine way_line(const std::vector<Eigen::Vector2d>& places);

/// Without the candidates where no tag can be. Several of which one is left become a place; where
/// none is left the tag is not located. `most_error_m`: a place expected to be worse is none.
void keep_within(const TagArea& area, const WayLine& way, double most_error_m,
                 TagEstimate& estimate);

}  // namespace tagfield
