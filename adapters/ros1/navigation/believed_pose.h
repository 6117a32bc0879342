// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot's estimate of its own pose: by odometry, and on the map if localized.
#pragma once

#include <optional>

#include "adapters/ros1/navigation/frame_listener.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// The map's frame may lag behind, as localization takes time; odometry continues in the meantime.
class BelievedPose {
 public:
  /// A map frame that is more than `max_age_s` older than odometry is not used.
  BelievedPose(const FrameListener& frames, FrameNames names, double max_age_s)
      : frames_(frames), names_(std::move(names)), max_age_s_(max_age_s) {}

  /// X_MR now.
  [[nodiscard]] std::optional<PlanarPose> now() const;
  /// X_MR when the pose by odometry is `odometry`.
  [[nodiscard]] std::optional<PlanarPose> at(const PlanarPose& odometry) const;
  /// X_OR now.
  [[nodiscard]] std::optional<PlanarPose> odometry() const;
  /// Why there is no pose, as text.
  [[nodiscard]] std::string trouble() const;

 private:
  [[nodiscard]] std::optional<PlanarPose> odom_on_map() const;

  const FrameListener& frames_;
  FrameNames names_;
  double max_age_s_;
};

}  // namespace tagfield
