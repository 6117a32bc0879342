// SPDX-License-Identifier: Apache-2.0
/// @file
/// The door of this room: reads joined with antenna places in, a track for each tag out, and in
/// which order tracks pass a line. Knows nothing of where the tags really are.
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

/// A way that tags are known to take, such as a conveyor: a level line and how far from it they
/// may be (one sigma).
struct Lane {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< A point of its middle [m, world].
  double heading_rad = 0.0;                         ///< Where it goes, from x towards y.
  double lateral_sigma_m = 0.1;                     ///< Of a tag's place, to the side.
  double heading_sigma_rad = 0.02;                  ///< Of a tag's direction.
  bool both_ways = false;                           ///< Whether tags may also run backwards.
};

/// How a track is smoothed once its beginning is found.
enum class TrackMethod { kEkf, kUkf, kParticle };

/// "ekf", "ukf", "particle".
std::string to_string(TrackMethod method);
/// Inverse of to_string; throws Error on another word.
TrackMethod track_method(const std::string& word);

struct TrackingOptions {
  TrackMethod method = TrackMethod::kEkf;
  std::optional<Lane> lane;
  double min_speed_m_s = 0.05;  ///< Of horizontal motion.
  double max_speed_m_s = 3.0;
  /// Process noise: root of the power density of the acceleration [m/s²/√Hz], in x and in y. The
  /// velocity strays by this times √t.
  double acceleration_noise = 0.005;
  double height_sigma_m = 0.005;        ///< Of a height that is known.
  double unknown_height_sigma_m = 0.5;  ///< Of one that is not.
  double vertical_speed_sigma_m_s = 1e-3;
  double reach_m = 4.0;      ///< How far from the antennas a tag may be halfway through its reads.
  double gate_sigmas = 4.5;  ///< Reads beyond are left out.
  double max_gap_s = 3.0;    ///< Over longer gaps a tag is not followed.
  double max_expected_error_m = 0.15;  ///< Tracks less sure than this are not given.
  double min_coherence = 0.5;          ///< Nor those that explain less.
  std::size_t particles = 4000;
  std::uint64_t seed = 1;  ///< Of the particles.
};

/// The keys of all options but method and lane; those of the particles alone stand in the second.
const std::vector<Setting<TrackingOptions>>& tracking_settings();
const std::vector<Setting<TrackingOptions>>& particle_track_settings();

/// Throws Error naming the option that is out of its range or not finite.
void check(const TrackingOptions& options);

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

/// A track for each tag in the problem's samples, in rising order of their IDs, reference tags
/// left out. Deterministic, whatever the number of threads. Throws Error on options out of range.
std::vector<TagTrack> track_tags(const LocalizationProblem& problem, const TrackingOptions& options,
                                 int threads, Diagnostics& diagnostics);

/// A vertical plane that tags pass.
struct PassingLine {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< [m, world]
  double heading_rad = 0.0;                         ///< Along the line.
};

/// A tag passed something.
struct Passing {
  std::string tag;
  Time stamp;
  double sigma_s = 0.0;
};

/// What tags passed, and in which order: rising stamps.
struct PassingOrder {
  std::string name;  ///< "line", or the antenna's name.
  std::vector<Passing> passings;
};

/// Time at which the track crosses the line for the first time; none where it does not within the
/// time of its reads. σ_t = √(nᵀ P n)/|n·v|, with n across the line and P the place's covariance.
std::optional<Passing> passing_of(const Track& track, const PassingLine& line);

/// Time at which the track is nearest to a place: (p − a)·v = 0, with δt = −(v·δp + (p − a)·δv)/v²
/// from which σ_t follows. None where that is at the track's begin or end.
std::optional<Passing> nearest_of(const Track& track, const Eigen::Vector3d& place);

/// Orders of all tags with one track: at the line, if there is one, then at each antenna that stood
/// still.
std::vector<PassingOrder> passing_orders(const LocalizationProblem& problem,
                                         const std::vector<TagTrack>& tracks,
                                         const std::optional<PassingLine>& line);

/// Probability that `first` passed before `second`, their errors being independent.
double probability_before(const Passing& first, const Passing& second);

}  // namespace tagfield
