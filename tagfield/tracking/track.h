// SPDX-License-Identifier: Apache-2.0
/// @file
/// What tracking says of one tag: where it was and how it moved, from its first read to its last.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Place and velocity of a tag at one time.
struct TrackPoint {
  Time stamp;
  Eigen::Vector3d p_WT;  ///< [m]
  Eigen::Vector3d v_WT;  ///< [m/s]
  /// Covariance of (p_WT, v_WT): [m², m²/s, m²/s²].
  Matrix6d covariance = Matrix6d::Zero();
};

enum class TrackVerdict {
  kTracked,     ///< One track.
  kAmbiguous,   ///< Several that the data can't tell apart, such as mirror images.
  kNotTracked,  ///< None; `reason` is "cannot track: " and why.
};

/// "tracked", "ambiguous", "not_tracked".
std::string to_string(TrackVerdict verdict);

/// A way that a tag may have gone.
struct Track {
  std::vector<TrackPoint> points;  ///< At each stamp of a read, in rising order.
  double rms_rad = 0.0;            ///< Rms of the phases that the track leaves unexplained.
  /// Quality: length of the mean of e^(j·residual), 1 for a perfect track, near 0 for none.
  double coherence = 0.0;
  /// Logarithm of the Bayes factor of this motion against phases that are random: how many times
  /// likelier the reads are if the tag went such a way, counted over all the ways it may have gone.
  double log_evidence = 0.0;
  double log_likelihood = 0.0;  ///< To compare tracks of the same tag, up to a constant.
  /// Root of the horizontal covariance's trace where the tag came nearest to an antenna [m].
  double expected_error_m = 0.0;
  std::size_t left_out = 0;  ///< Reads beyond the gate.
};

struct TagTrack {
  std::string tag;
  TrackVerdict verdict = TrackVerdict::kNotTracked;
  std::string reason;         ///< One line; empty where tracked without remark.
  std::vector<Track> tracks;  ///< Best first.
  std::size_t reads = 0;      ///< Reads of this tag that were used.
};

}  // namespace tagfield
