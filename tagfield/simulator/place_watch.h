// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether a robot with unknown pose finds it out, compared with the ground truth.
#pragma once

#include <optional>
#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// Why a robot does not know its pose.
enum class PositionLoss {
  kStart,      ///< Its start pose is unknown.
  kKidnapped,  ///< It was moved elsewhere.
  kLost,       ///< It lost its pose by itself.
};

/// One occasion on which a robot had to find out its pose.
struct Finding {
  PositionLoss why = PositionLoss::kStart;
  bool noticed = false;  ///< Whether it noticed that it does not know its pose.
  /// Time until it knew its pose and kept knowing it; none if it never did.
  std::optional<double> seconds;
  double driven_m = 0.0;  ///< Distance driven until then, without turns on the spot.
  int wrong = 0;          ///< Number of times it wrongly believed it had found its pose.
};

/// The state of a robot at one time.
struct PlaceGlance {
  Time now;
  double driven_m = 0.0;        ///< In total.
  bool knows_position = false;  ///< By its own belief.
  double off_m = 0.0;           ///< Distance between believed and true position.
  double off_rad = 0.0;         ///< Same, but of the heading, ≥ 0.
};

/// A robot's belief is right if it is off by less than kRight_m and kRight_rad. The robot has found
/// its pose once it has believed to know it and been right for kHolds_s without interruption; time
/// and distance are those at the beginning of that interval.
class PlaceWatch {
 public:
  static constexpr double kRight_m = 0.5;
  static constexpr double kRight_rad = 0.2;
  static constexpr double kHolds_s = 1.0;

  /// From the next glance on the robot is at an unknown pose. A loss by itself (kLost) is detected
  /// without this call.
  void put(PositionLoss why) { put_ = why; }
  void look(const PlaceGlance& glance);
  /// All findings so far, in chronological order.
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::vector<Finding> findings_;
  std::optional<PositionLoss> put_;
  bool is_open_ = false;              ///< The last finding is not complete.
  bool knew_place_ = false;           ///< At the last glance.
  PlaceGlance begin_;                 ///< Of the last finding.
  std::optional<PlaceGlance> right_;  ///< Beginning of the interval in which it has been right.
};

}  // namespace tagfield
