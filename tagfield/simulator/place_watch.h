// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether a robot that was not told where it is finds out, judged against the truth.
#pragma once

#include <optional>
#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// Why a robot does not know where it is.
enum class PlaceLoss {
  kStart,    ///< It was not told.
  kCarried,  ///< It was put elsewhere.
  kLost,     ///< It gave its place up by itself.
};

/// One time that a robot had to find out where it is.
struct Finding {
  PlaceLoss why = PlaceLoss::kStart;
  bool noticed = false;  ///< That it does not know.
  /// Until it knew its place and went on knowing it; none where it never did.
  std::optional<double> seconds;
  double driven_m = 0.0;  ///< Likewise; without turns on the spot.
  int wrong = 0;          ///< Times that it believed to have found itself and was elsewhere.
};

/// What there is to see of a robot at one moment.
struct PlaceGlance {
  Time now;
  double driven_m = 0.0;     ///< In all.
  bool knows_place = false;  ///< As it believes.
  double off_m = 0.0;        ///< Distance between believed and true place.
  double off_rad = 0.0;      ///< Likewise of the heading, ≥ 0.
};

/// A robot is right that is off by less than kRight_m and kRight_rad, and knows its place once it
/// has believed so and been right for kHolds_s running; the time and way are those at its first.
class PlaceWatch {
 public:
  static constexpr double kRight_m = 0.5;
  static constexpr double kRight_rad = 0.2;
  static constexpr double kHolds_s = 1.0;

  /// From the next glance on the robot is where it does not know. What it loses by itself is seen.
  void put(PlaceLoss why) { put_ = why; }
  void look(const PlaceGlance& glance);
  /// All up to now, in order of time.
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::vector<Finding> findings_;
  std::optional<PlaceLoss> put_;
  bool is_open_ = false;              ///< The last of them is not at its end.
  bool knew_place_ = false;           ///< At the last glance.
  PlaceGlance begin_;                 ///< Of the last of them.
  std::optional<PlaceGlance> right_;  ///< Since when it has been right.
};

}  // namespace tagfield
