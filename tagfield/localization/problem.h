// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a localization method is given: reads joined with believed antenna places, and all that is
/// known besides, such as where tags can be. Nothing of where they really are.
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

/// One phase measured at one place.
struct PhaseSample {
  Time stamp;
  double phase_rad = 0.0;     ///< In [0, 2π).
  double frequency_hz = 0.0;  ///< Carrier.
  Eigen::Vector3d p_WA;       ///< Antenna [m].
  double rssi_dbm = 0.0;
};

/// Stands for an RSSI that was not reported [dBm].
inline constexpr double kNoRssi = -200.0;

/// Samples of one tag, by antenna, each in rising order of time.
using SamplesOfTag = std::map<std::string, std::vector<PhaseSample>>;

/// All samples, by tag.
using SamplesByTag = std::map<std::string, SamplesOfTag>;

struct BelievedTrack;

/// The antennas' believed poses by antenna, in rising order of time. Poses that are not finite,
/// repeat a stamp, or whose clock must have been wrong (strays.h) are left out, which is counted in
/// one warning for each antenna.
std::map<std::string, BelievedTrack> tracks_of(const std::vector<AntennaPose>& poses,
                                               Diagnostics& diagnostics);

/// Calls what it is given for each read, every time in the same order: reads in memory, or of a
/// table that is read anew each time.
struct EachRead {
  using Take = std::function<void(const TagRead&)>;
  explicit EachRead(std::function<void(const Take&)> of_all) : call(std::move(of_all)) {}
  void operator()(const Take& take) const { call(take); }
  std::function<void(const Take&)> call;
};
/// Those in memory, which must outlive it.
EachRead each_of(const std::vector<TagRead>& reads);

/// Whether the reads have phases: false of eight or more whose phases are all one, as of readers
/// and tables that have none and say 0.
bool has_phases(const std::vector<TagRead>& reads);

/// Joins reads with the antennas' poses, interpolated at each read's stamp. A read whose antenna
/// has no pose at its stamp (poses further apart than `max_pose_gap_s` while the antenna moved, or
/// the stamp before the first or after the last) is left out and counted in one warning for each
/// antenna, which says why. An antenna with one pose stands still. Two reads of a tag by an antenna
/// at the same stamp: the first counts, and a warning counts the others. Reads whose clock must
/// have been wrong (strays.h) are left out, which is told, too.
SamplesByTag join_reads_with_tracks(const std::vector<TagRead>& reads,
                                    const std::map<std::string, BelievedTrack>& tracks,
                                    double max_pose_gap_s, Diagnostics& diagnostics);
/// Samples, and has_phases() of the reads, which are gone through twice.
struct JoinedReads {
  SamplesByTag samples;
  bool has_phases = true;
};
JoinedReads join_reads_with_tracks(const EachRead& each_read,
                                   const std::map<std::string, BelievedTrack>& tracks,
                                   double max_pose_gap_s, Diagnostics& diagnostics);

/// On which side of the antennas' heights a tag of unknown height is: from a level path only its
/// distance from that level can be told.
enum class HeightSide { kAbove, kBelow };

/// What is known of the tags' heights [m, world]. Where nothing is, a tag is taken to be as high
/// as the antennas are in the mean, or its height is estimated.
struct TagHeights {
  std::optional<double> of_all;
  std::map<std::string, double> of_tag;  ///< Goes before `of_all`.
  std::optional<HeightSide> estimated;  ///< Heights that are not known are estimated, on this side.
};

/// Error of the believed poses: an Ornstein-Uhlenbeck process in x, y and yaw, with variances σ²
/// and the correlation e^(−|Δt|/τ).
struct PoseErrorModel {
  double sigma_m = 0.0;  ///< Standard deviation in x and in y; 0 where the pose is true.
  double yaw_sigma_rad = 0.0;
  double time_constant_s = 5.0;  ///< τ > 0.
};

/// Error of the map that the believed poses are on, as a whole: a shift and a turn about the
/// origin, the same for all poses. For a map that a robot made the origin is where it began.
struct MapError {
  std::optional<Eigen::Vector2d> origin_W;               ///< [m]; none for that of the first pose.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of x, y, yaw [m², m·rad, rad²].
};

/// Where an antenna was believed to be.
struct BelievedTrack {
  Trajectory X_WA;  ///< In rising order of time.
  /// Covariance of x, y, yaw at each of these [m², m·rad, rad²]; empty where it is not told.
  std::vector<Eigen::Matrix3d> covariance;
};

/// Whether it says how the antenna lay: of a track that doesn't all rotations are the identity.
bool is_orientation_told(const BelievedTrack& track);

/// A phase offset that is known, as from a calibration.
struct KnownOffset {
  std::string antenna;
  std::optional<double> frequency_hz;  ///< Of one channel; none for all of them.
  double offset_rad = 0.0;             ///< φ = offset + 4π r/λ.
};

/// Of circular polarization, as seen along the wave.
enum class Hand { kRight, kLeft };

/// An estimate worse than this is not given as located.
struct EstimateLimits {
  double max_expected_error_m = 0.15;
  double max_rms_m = 0.08;  ///< A worse misfit than this is no tag at rest.
};

/// One path of a known world from an antenna to a place, as if it came straight from a mirrored
/// antenna: near the place, p, its field is amplitude / |p − source| e^(−jk |p − source|).
struct TracedWave {
  Eigen::Vector3d source_W;  ///< [m]
  std::complex<double> amplitude;
  Eigen::Vector3d departure_W;  ///< Unit vector: direction of travel at the antenna.
  bool direct = false;          ///< The source is the antenna itself.
};

/// All paths of a reply. `backward` is empty where one antenna sends and receives.
struct TracedReply {
  std::vector<TracedWave> forward, backward;
};

/// Poses of an antenna, and the carriers on which it reads there; as many.
struct TracedFrom {
  std::vector<RigidTransform> X_WA;
  std::vector<double> carriers_hz;
};

/// By antenna, one for each of its poses; of antennas that can't be traced without waves.
using TracedReplies = std::map<std::string, std::vector<TracedReply>>;

/// Replies of a tag at `p_WT` [m] to antennas.
using TraceReplies =
    std::function<TracedReplies(const std::string& tag, const Eigen::Vector3d& p_WT,
                                const std::map<std::string, TracedFrom>& antennas)>;

/// Called now and then, from any thread, with what is being done and how much of that is, 0 to 1.
using OnLocating = std::function<void(const std::string& what, double share)>;

/// All that the methods share. Phases in `samples` have the known offsets taken out.
struct LocalizationProblem {
  SamplesByTag samples;                         ///< In order; see join_reads_with_poses().
  std::map<std::string, BelievedTrack> tracks;  ///< By antenna.
  TagHeights heights;
  std::map<std::string, Eigen::Vector3d> reference_tags;  ///< Tags at known places [m, world].
  /// Antennas that send and receive circularly polarized waves by one element, and so turn the
  /// phase of a tag with one wire (circular_polarization.h).
  std::map<std::string, Hand> circular;
  std::set<std::string> offset_known;        ///< Antennas whose offset is known, in all channels.
  std::optional<PoseErrorModel> pose_error;  ///< None where nothing is known of it.
  std::optional<MapError> map_error;         ///< Likewise; with an origin.
  bool has_phases = true;                    ///< False where they are all one: the reads have none.
  bool half_turns = false;                   ///< Phases and carriers were doubled (half_turns.h).
  TagArea area;                              ///< Where tags can be.
  EstimateLimits limits;
  TraceReplies trace;          ///< Through the world, where that is known; else null.
  double world_sigma_m = 0.0;  ///< How far its surfaces may be from where they are said to be.
  OnLocating on_locating;      ///< Or null.

  /// By which phases and carriers in `samples` were multiplied.
  [[nodiscard]] double multiple() const { return half_turns ? 2.0 : 1.0; }
};

/// What a problem is made from, besides reads and poses.
struct KnownBeforehand {
  TagHeights heights;
  std::map<std::string, Eigen::Vector3d> reference_tags;
  std::vector<KnownOffset> offsets;
  std::optional<PoseErrorModel> pose_error;
  std::optional<MapError> map_error;
  double max_pose_gap_s = 0.5;  ///< Reads between poses further apart than this are left out.
  /// Whether phases are known but for half a turn; where not told, the reads tell it.
  std::optional<bool> half_turns;
  TagArea area;  ///< Where tags can be.
  EstimateLimits limits;
  TraceReplies trace{};  ///< Through the world, where that is known. Called by several threads.
  /// How far its surfaces may be from where they are said to be, standard deviation along each
  /// axis.
  double world_sigma_m = 0.0;
  std::map<std::string, Hand> circular{};  ///< Antennas that are known to be circularly polarized.
};

/// Warns of tags whose height is neither known nor to be estimated; reference tags need none.
void warn_of_unknown_heights(const KnownBeforehand& known, const std::vector<std::string>& tags,
                             Diagnostics& diagnostics);

/// Joins reads (in any order) with the antennas' believed poses, interpolated at each read's stamp,
/// takes known offsets out, doubles phases with half turns and merges reads at stops (stops.h).
/// Reads without a pose are left out with a warning. Throws Error on what is known beforehand where
/// it is not finite or out of range.
LocalizationProblem make_problem(const std::vector<TagRead>& reads,
                                 const std::vector<AntennaPose>& poses,
                                 const KnownBeforehand& known, Diagnostics& diagnostics);
LocalizationProblem make_problem(const EachRead& each_read, const std::vector<AntennaPose>& poses,
                                 const KnownBeforehand& known, Diagnostics& diagnostics);

/// Height of a tag's plane [m]: known, or else that of the antennas that moved while they read it,
/// in the mean.
double plane_height(const LocalizationProblem& problem, const std::string& tag);

/// Whether the tag's height is to be estimated, and on which side.
std::optional<HeightSide> side_to_estimate(const LocalizationProblem& problem,
                                           const std::string& tag);

}  // namespace tagfield
