// SPDX-License-Identifier: Apache-2.0
/// @file
/// Public interface of this room: takes reads joined with antenna positions, gives a track for each
/// tag and the order in which tags pass a line. Has no access to the ground truth.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/setting.h"
#include "tagfield/base/time.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// A path that tags are known to take, such as a conveyor: a level line and the tags' deviation
/// from it (one sigma).
struct Lane {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< A point on its centre line [m, world].
  double heading_rad = 0.0;                         ///< Direction of travel, from x towards y.
  double lateral_sigma_m = 0.1;                     ///< Of a tag's lateral position.
  double heading_sigma_rad = 0.02;                  ///< Of a tag's direction.
  bool bidirectional = false;                       ///< Whether tags may also move backwards.
  /// Process noise along the lane, as of a belt that starts and stops, if it is more than that of
  /// the options [m/s²/√Hz].
  double acceleration_noise = 0.0;
};

/// How a track is smoothed once its start is found.
enum class TrackMethod { kEkf, kUkf, kParticle };

/// "ekf", "ukf", "particle".
std::string to_string(TrackMethod method);
/// Inverse of to_string; throws Error on any other string.
TrackMethod track_method(const std::string& word);

struct TrackingOptions {
  TrackMethod method = TrackMethod::kEkf;
  std::optional<Lane> lane;
  double min_speed_m_s = 0.05;  ///< Of horizontal motion.
  double max_speed_m_s = 3.0;
  /// Process noise: square root of the acceleration's power density [m/s²/√Hz], in x and in y. The
  /// velocity drifts by this times √t. The least that is assumed: where the phases of a tag demand
  /// more, up to 30 times as much is taken, or 100 times along a lane, and the covariances are
  /// four times as large.
  double acceleration_noise = 0.005;
  double height_sigma_m = 0.005;        ///< Of a known height.
  double unknown_height_sigma_m = 0.5;  ///< Of an unknown height.
  double vertical_speed_sigma_m_s = 1e-3;
  double reach_m = 4.0;  ///< Maximum distance of a tag from the antennas halfway through its reads.
  double gate_sigmas = 4.5;            ///< Outlier gate; reads outside are left out.
  double max_gap_s = 3.0;              ///< A tag is not tracked across longer gaps.
  double max_expected_error_m = 0.15;  ///< Tracks with a larger one are not returned.
  double min_coherence = 0.5;          ///< Nor are tracks with a lower one.
  std::size_t particles = 4000;
  std::uint64_t seed = 1;  ///< Of the particles.
};

/// Keys of all options except method and lane; the second has those of the particles only.
const std::vector<Setting<TrackingOptions>>& tracking_settings();
const std::vector<Setting<TrackingOptions>>& particle_track_settings();

/// Throws Error naming the option that is out of range or not finite.
void check(const TrackingOptions& options);

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Position and velocity of a tag at one time.
struct TrackPoint {
  Time stamp;
  Eigen::Vector3d p_WT;  ///< [m]
  Eigen::Vector3d v_WT;  ///< [m/s]
  /// Covariance of (p_WT, v_WT): [m², m²/s, m²/s²].
  Matrix6d covariance = Matrix6d::Zero();
};

enum class TrackVerdict {
  kTracked,     ///< One track.
  kAmbiguous,   ///< Several that the data cannot distinguish, such as mirror images.
  kNotTracked,  ///< None; `reason` is "cannot track: " followed by the cause.
};

/// "tracked", "ambiguous", "not_tracked".
std::string to_string(TrackVerdict verdict);

/// A possible trajectory of a tag.
struct Track {
  std::vector<TrackPoint> points;  ///< At the timestamp of each read, in ascending order.
  double rms_rad = 0.0;            ///< Rms of the phase residuals.
  /// Quality: magnitude of the mean of e^(j·residual), 1 for a perfect track, near 0 for none.
  double coherence = 0.0;
  /// Logarithm of the Bayes factor of this motion against random phases: how many times likelier
  /// the reads are if the tag moved like this, marginalized over all possible motions.
  double log_evidence = 0.0;
  double log_likelihood = 0.0;  ///< To compare tracks of the same tag, up to a constant.
  /// Square root of the horizontal covariance's trace at the closest approach to an antenna [m].
  double expected_error_m = 0.0;
  std::size_t left_out = 0;  ///< Reads outside the gate.
  std::size_t jumps = 0;     ///< Jumps of an antenna's phases that no motion explains.
  /// Correlated residuals that count as one independent one, at least 1; the covariances allow for
  /// it (docs/tracking.md).
  double correlation_factor = 1.0;
  double acceleration_noise = 0.0;  ///< Process noise that it was smoothed with [m/s²/√Hz].
};

struct TagTrack {
  std::string tag;
  TrackVerdict verdict = TrackVerdict::kNotTracked;
  std::string reason;         ///< One line; empty if tracked without remark.
  std::vector<Track> tracks;  ///< Best first.
  std::size_t reads = 0;      ///< Number of reads of this tag that were used.
};

/// Tracks each tag in the problem's samples except reference tags; results are sorted by ID.
/// Deterministic, independent of the number of threads. Throws Error on options out of range.
std::vector<TagTrack> track_tags(const LocalizationProblem& problem, const TrackingOptions& options,
                                 int threads, Diagnostics& diagnostics);

/// A vertical plane that tags pass.
struct PassingLine {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< [m, world]
  double heading_rad = 0.0;                         ///< Along the line.
};

/// Passage of a tag.
struct Passing {
  std::string tag;
  Time stamp;
  double sigma_s = 0.0;
};

/// Order in which tags passed a line or an antenna, sorted by timestamp.
struct PassingOrder {
  std::string name;  ///< "line", or the antenna's name.
  std::vector<Passing> passings;
};

/// Time at which the track first crosses the line; none if it does not during its reads. σ_t = √(nᵀ
/// P n)/|n·v|, with n the normal of the line and P the position's covariance.
std::optional<Passing> passing_of(const Track& track, const PassingLine& line);

/// Time at which the track is closest to a point a: (p − a)·v = 0, of several such times the one
/// with the least distance; σ_t follows from δt = −(v·δp + (p − a)·δv)/v². None if it only comes
/// nearer or only leaves.
std::optional<Passing> nearest_of(const Track& track, const Eigen::Vector3d& place);

/// Passing orders of all unambiguously tracked tags: at the line, if given, then at each stationary
/// antenna.
std::vector<PassingOrder> passing_orders(const LocalizationProblem& problem,
                                         const std::vector<TagTrack>& tracks,
                                         const std::optional<PassingLine>& line);

/// Probability that `first` passed before `second`, assuming independent errors.
double probability_before(const Passing& first, const Passing& second);

}  // namespace tagfield
