// SPDX-License-Identifier: Apache-2.0
/// @file
/// Input of a localization method: reads joined with believed antenna positions, and all prior
/// knowledge, such as the area where tags can be. True positions are not part of it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <complex>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/time.h"
#include "tagfield/localization/tag_estimate.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Side of the antennas' path on which tags are: left or right in the direction of travel, or
/// towards a world axis.
enum class TagSide { kLeft, kRight, kPlusX, kMinusX, kPlusY, kMinusY };

/// Names of the values, in their order.
const std::vector<std::string>& tag_sides();

/// The side with this name; throws Error on any other.
TagSide tag_side(const std::string& word);

/// Area where tags can be: anywhere, if nothing is set.
struct TagArea {
  std::optional<TagSide> side;
  std::optional<Eigen::AlignedBox2d> box;  ///< Seen from above [m, world].
};

/// Whether a tag may be at `p`, relative to the line through `middle` in the direction `along`.
bool is_within(const TagArea& area, const Eigen::Vector2d& middle, const Eigen::Vector2d& along,
               const Eigen::Vector2d& p);

/// Line along the antennas' path: the midpoint, and the direction of the longest extent, pointing
/// away from the first position.
struct PathLine {
  Eigen::Vector2d middle{0.0, 0.0};
  Eigen::Vector2d along{1.0, 0.0};
};
PathLine path_line(const std::vector<Eigen::Vector2d>& places);

/// Removes the candidates outside the area. If a single one of several is left, the tag becomes
/// located; if none is left, it is not located. The same holds if the expected error of the best
/// one left exceeds `max_error_m`.
void keep_within(const TagArea& area, const PathLine& way, double max_error_m,
                 TagEstimate& estimate);

/// One phase measurement at one antenna position.
struct PhaseSample {
  Time stamp;
  double phase_rad = 0.0;     ///< In [0, 2π).
  double frequency_hz = 0.0;  ///< Carrier: reads with equal ones share an offset (phase_jumps.h).
  Eigen::Vector3d p_WA;       ///< Antenna [m].
  double rssi_dbm = 0.0;
};

/// Placeholder for an RSSI that was not reported [dBm].
inline constexpr double kNoRssi = -200.0;

/// Samples of one tag by antenna, each series sorted by time.
using SamplesOfTag = std::map<std::string, std::vector<PhaseSample>>;

/// All samples by tag.
using SamplesByTag = std::map<std::string, SamplesOfTag>;

struct BelievedTrack;

/// Believed poses by antenna, sorted by time. Poses that are not finite, repeat a stamp, or were
/// stamped by a wrong clock (strays.h) are left out and counted in a warning for each antenna.
std::map<std::string, BelievedTrack> tracks_of(const std::vector<AntennaPose>& poses,
                                               Diagnostics& diagnostics);

/// Calls a callback for each read, always in the same order; the reads are in memory, or in a table
/// that is read anew each time.
struct EachRead {
  using Take = std::function<void(const TagRead&)>;
  explicit EachRead(std::function<void(const Take&)> of_all) : call(std::move(of_all)) {}
  void operator()(const Take& take) const { call(take); }
  std::function<void(const Take&)> call;
};
/// Iterates over reads in memory, which must outlive the result.
EachRead each_of(const std::vector<TagRead>& reads);

/// Whether the reads have phases: false for eight or more reads with identical phases, as from
/// readers and tables that lack phases and report 0.
bool has_phases(const std::vector<TagRead>& reads);

/// Joins reads with the antennas' poses, interpolated at each read's stamp. A read whose antenna
/// has no pose at its stamp (poses further apart than `max_pose_gap_s` while the antenna moved, or
/// the stamp before the first or after the last) is left out and counted in one warning for each
/// antenna, which gives the reason. An antenna with a single pose is stationary. Of several reads
/// of a tag by an antenna at the same stamp the first is used, and a warning counts the others.
/// Reads stamped by a wrong clock (strays.h) are left out with a warning.
SamplesByTag join_reads_with_tracks(const std::vector<TagRead>& reads,
                                    const std::map<std::string, BelievedTrack>& tracks,
                                    double max_pose_gap_s, Diagnostics& diagnostics);
/// Samples, and has_phases() of the reads. The reads are traversed twice.
struct JoinedReads {
  SamplesByTag samples;
  bool has_phases = true;
};
JoinedReads join_reads_with_tracks(const EachRead& each_read,
                                   const std::map<std::string, BelievedTrack>& tracks,
                                   double max_pose_gap_s, Diagnostics& diagnostics);

/// Whether a tag of unknown height is above or below the antennas: from a level path only its
/// vertical distance from that level can be determined.
enum class HeightSide { kAbove, kBelow };

/// What is known of the tags' heights [m, world]. If nothing is known of a tag, its height is
/// assumed to be the mean height of the antennas, or is estimated.
struct TagHeights {
  std::optional<double> of_all;
  std::map<std::string, double> of_tag;  ///< Takes precedence over `of_all`.
  std::optional<HeightSide> estimated;   ///< Unknown heights are estimated, on this side.
};

/// Error of the believed poses: an Ornstein-Uhlenbeck process in x, y and yaw, with variances σ²
/// and the correlation e^(−|Δt|/τ).
struct PoseErrorModel {
  double sigma_m = 0.0;  ///< Standard deviation in x and in y; 0 if the pose is exact.
  double yaw_sigma_rad = 0.0;
  double time_constant_s = 5.0;  ///< τ > 0.
};

/// Global error of the map in which the believed poses are given: a shift and a rotation about the
/// origin, common to all poses. For a map that a robot built, the origin is where it started.
struct MapError {
  std::optional<Eigen::Vector2d> origin_W;  ///< [m]; nullopt for the position of the first pose.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of x, y, yaw [m², m·rad, rad²].
};

/// Error by dead reckoning at one time: a shift, and a rotation about the body's believed position.
/// Covariances are of x, y, yaw [m², m·rad, rad²], in the world's axes.
struct Drift {
  Time stamp;
  Eigen::Vector2d origin_W{0.0, 0.0};                     ///< Believed position of the body [m].
  Eigen::Matrix3d since_start = Eigen::Matrix3d::Zero();  ///< As accumulated.
  /// Gained since the previous one, independent.
  Eigen::Matrix3d since_last = Eigen::Matrix3d::Zero();
};

/// The drift at the poses of an antenna's believed trajectory, in their order; empty for an antenna
/// whose poses don't drift.
using DriftOf =
    std::function<std::vector<Drift>(const std::string& antenna, const Trajectory& X_WA)>;

/// Believed trajectory of an antenna.
struct BelievedTrack {
  Trajectory X_WA;  ///< Sorted by time.
  /// Covariance of x, y, yaw at each of these poses [m², m·rad, rad²]; empty if not given.
  std::vector<Eigen::Matrix3d> covariance;
};

/// Whether the track has orientations; if not, all rotations are the identity.
bool is_orientation_known(const BelievedTrack& track);

/// A known phase offset, e.g. from a calibration.
struct KnownOffset {
  std::string antenna;
  std::optional<double> frequency_hz;  ///< Of one channel; nullopt for all of them.
  double offset_rad = 0.0;             ///< φ = offset + 4π r/λ.
};

/// Handedness of circular polarization, as seen along the direction of propagation.
enum class Hand { kRight, kLeft };

/// Limits beyond which an estimate is not reported as located.
struct EstimateLimits {
  double max_expected_error_m = 0.15;
  double max_rms_m = 0.08;  ///< With a larger misfit the phases don't fit a tag at rest.
};

/// One path in a known world from an antenna to a position, as if it came straight from a mirror
/// image of the antenna: at a point p near the position, its field is amplitude / |p − source|
/// e^(−jk |p − source|).
struct TracedWave {
  Eigen::Vector3d source_W;  ///< [m]
  std::complex<double> amplitude;
  Eigen::Vector3d departure_W;  ///< Unit vector: direction of travel at the antenna.
  bool direct = false;          ///< The source is the antenna itself.
};

/// All paths of a reply. `backward` is empty if one antenna transmits and receives.
struct TracedReply {
  std::vector<TracedWave> forward, backward;
};

/// Poses of an antenna, and the carrier of its read at each pose.
struct TracedFrom {
  std::vector<RigidTransform> X_WA;
  std::vector<double> carriers_hz;
};

/// Replies by antenna, one for each of its poses; without waves for antennas that can't be traced.
using TracedReplies = std::map<std::string, std::vector<TracedReply>>;

/// Replies of a tag at `p_WT` [m] to antennas.
using TraceReplies =
    std::function<TracedReplies(const std::string& tag, const Eigen::Vector3d& p_WT,
                                const std::map<std::string, TracedFrom>& antennas)>;

/// Progress callback, called occasionally from any thread with the current step and the share of it
/// that is done, 0 to 1.
using OnLocating = std::function<void(const std::string& what, double share)>;

/// Input shared by all methods. Known offsets are already subtracted from the phases in `samples`.
struct LocalizationProblem {
  SamplesByTag samples;                         ///< Sorted by time; see join_reads_with_tracks().
  std::map<std::string, BelievedTrack> tracks;  ///< By antenna.
  TagHeights heights;
  std::map<std::string, Eigen::Vector3d> reference_tags;  ///< Tags at known positions [m, world].
  /// Antennas that transmit and receive circularly polarized waves with one element, and so rotate
  /// the phase of a linearly polarized tag (circular_polarization.h).
  std::map<std::string, Hand> circular;
  std::set<std::string> offset_known;        ///< Antennas whose offset is known on all channels.
  std::optional<PoseErrorModel> pose_error;  ///< nullopt if unknown.
  std::optional<MapError> map_error;         ///< nullopt if unknown; with an origin.
  /// By antenna, sorted by time; of those that drift.
  std::map<std::string, std::vector<Drift>> drift;
  /// By tag: horizontal standard deviation [m] due to jumps of the poses (jumping_bodies.h).
  std::map<std::string, double> pose_jump_m;
  bool has_phases = true;     ///< False if they are identical: the reads have none.
  bool pi_ambiguity = false;  ///< Phases and carriers were doubled (pi_ambiguity.h).
  TagArea area;               ///< Where tags can be.
  EstimateLimits limits;
  TraceReplies trace;          ///< Traces paths through the world if that is known, otherwise null.
  double world_sigma_m = 0.0;  ///< Standard deviation of its surfaces' positions along each axis.
  OnLocating on_locating;      ///< May be null.

  /// Factor by which phases and carriers in `samples` were multiplied.
  [[nodiscard]] double multiple() const { return pi_ambiguity ? 2.0 : 1.0; }
};

/// Prior knowledge from which a problem is made, besides reads and poses.
struct KnownBeforehand {
  TagHeights heights;
  std::map<std::string, Eigen::Vector3d> reference_tags;
  std::vector<KnownOffset> offsets;
  std::optional<PoseErrorModel> pose_error;
  std::optional<MapError> map_error;
  /// Of poses by dead reckoning, null if there are none. Without effect beside `pose_error`, which
  /// then includes it.
  DriftOf drift{};
  double max_pose_gap_s = 0.5;  ///< Reads between poses further apart than this are left out.
  /// Whether phases have a π ambiguity; if not given, it is detected from the reads.
  std::optional<bool> pi_ambiguity;
  TagArea area;  ///< Where tags can be.
  EstimateLimits limits;
  TraceReplies trace{};  ///< Through the world if that is known. Called from several threads.
  /// Standard deviation of its surfaces' positions along each axis.
  double world_sigma_m = 0.0;
  std::map<std::string, Hand> circular{};  ///< Antennas known to be circularly polarized.
};

/// Warns of tags whose height is neither known nor to be estimated; reference tags need none.
void warn_of_unknown_heights(const KnownBeforehand& known, const std::vector<std::string>& tags,
                             Diagnostics& diagnostics);

/// Joins reads (in any order) with the antennas' believed poses, interpolated at each read's stamp,
/// subtracts known offsets, doubles phases that have a π ambiguity, separates the channels before
/// and after a jump of the reader's phase (phase_jumps.h), leaves each tag the reads on one side of
/// a jump of the poses (jumping_bodies.h) and merges reads at stops (stops.h).
/// Reads without a pose are left out with a warning. Throws Error if values in `known` are not
/// finite or out of range.
LocalizationProblem make_problem(const std::vector<TagRead>& reads,
                                 const std::vector<AntennaPose>& poses,
                                 const KnownBeforehand& known, Diagnostics& diagnostics);
LocalizationProblem make_problem(const EachRead& each_read, const std::vector<AntennaPose>& poses,
                                 const KnownBeforehand& known, Diagnostics& diagnostics);

/// Height of a tag's plane [m]: the known one, otherwise the mean height of the antennas that moved
/// while they read it.
double plane_height(const LocalizationProblem& problem, const std::string& tag);

/// Side on which the tag's height is to be estimated; nullopt if it is not.
std::optional<HeightSide> side_to_estimate(const LocalizationProblem& problem,
                                           const std::string& tag);

}  // namespace tagfield
