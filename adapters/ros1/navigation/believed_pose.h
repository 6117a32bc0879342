// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a robot believes to be: its place by odometry now, on the map as far as that is known.
#pragma once

#include <optional>

#include "adapters/ros1/navigation/frame_listener.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// The map's frame may lag behind, as whatever localizes takes its time; odometry goes on
/// meanwhile.
class BelievedPose {
 public:
  /// Nothing is believed of a map frame that is older than `most_age_s` than odometry's.
  BelievedPose(const FrameListener& frames, FrameNames names, double most_age_s)
      : frames_(frames), names_(std::move(names)), most_age_s_(most_age_s) {}

  /// X_MR now.
  [[nodiscard]] std::optional<PlanarPose> now() const;
  /// X_MR where odometry says `odometry`.
  [[nodiscard]] std::optional<PlanarPose> at(const PlanarPose& odometry) const;
  /// X_OR now.
  [[nodiscard]] std::optional<PlanarPose> odometry() const;
  /// Why there is none, in words.
  [[nodiscard]] std::string trouble() const;

 private:
  [[nodiscard]] std::optional<PlanarPose> odom_on_map() const;

  const FrameListener& frames_;
  FrameNames names_;
  double most_age_s_;
};

}  // namespace tagfield
