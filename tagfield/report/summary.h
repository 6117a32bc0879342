// SPDX-License-Identifier: Apache-2.0
/// @file
/// Estimates compared with the truth, and which tags were read: the statistics of a run, and their
/// JSON.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/tag_estimate.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

/// The reads of one reader, or of one antenna.
struct InventoryShare {
  std::string name;
  std::string reader;  ///< The reader that an antenna belongs to; for a reader its own name.
  double tags = 0.0;   ///< Read at least once.
  double only = 0.0;   ///< Of these, read by no other reader (or antenna).
  double reads = 0.0;
};

/// The reads of tags in another zone by a reader.
struct CrossRead {
  std::string reader;
  double tags = 0.0;
  double reads = 0.0;
};

/// The tags of one zone.
struct ZoneInventory {
  std::string zone;
  std::vector<std::string> readers;  ///< Intended readers of the zone.
  std::size_t tags = 0;
  double read = 0.0;             ///< By any reader.
  double read_by_own = 0.0;      ///< By an intended reader.
  double crossed = 0.0;          ///< Read by an unintended reader.
  std::vector<CrossRead> cross;  ///< By unintended readers.
};

/// The tags between two heights.
struct LevelInventory {
  double low_m = 0.0;
  double high_m = 0.0;
  std::size_t tags = 0;
  double read = 0.0;
};

struct InventoryMoment {
  double time_s = 0.0;
  double share = 0.0;  ///< Of all tags, read at least once by that time.
};

/// The time when a share of all tags had been read.
struct ReachedShare {
  double share = 0.0;
  std::optional<double> time_s;  ///< None if it was not reached in every run.
};

/// The effect of omitting one antenna.
struct InventoryWithout {
  std::string antenna;
  double read = 0.0;  ///< Tags read without it, mean over the same seeds.
};

/// One run, or the mean of several, whose counts are then means, too.
struct InventorySummary {
  std::size_t tags = 0;
  double duration_s = 0.0;
  double read = 0.0;  ///< Tags read at least once.
  double reads = 0.0;
  double min_read = 0.0;  ///< Minimum over the runs; equal to `read` for one run.
  double max_read = 0.0;
  std::optional<double> median_reads;  ///< Of the tags that were read.
  std::vector<ReachedShare> reached;   ///< 50, 95 and 99 %.
  std::vector<InventoryMoment> curve;  ///< Of the first run; time and share are non-decreasing.
  std::vector<InventoryShare> readers;
  std::vector<InventoryShare> antennas;
  std::vector<ZoneInventory> zones;
  std::vector<LevelInventory> levels;     ///< From the lowest.
  std::vector<InventoryWithout> without;  ///< Each antenna in turn; empty if not requested.
};

/// The mean of several runs of one scenario; at least one.
InventorySummary mean_of(const std::vector<InventorySummary>& runs);

/// One tag in one run (one seed).
struct TagOutcome {
  std::uint64_t seed = 0;
  TagEstimate estimate;
  std::size_t reads = 0;  ///< All of the tag, whether or not localization could use them.
  std::optional<Eigen::Vector3d> truth_m;  ///< None if unknown, or if the tag moved.
  bool moved = false;      ///< The tag was not stationary, so it has no single true position.
  bool reference = false;  ///< Its position was given to localization, so it has no error.
};

/// |estimate − truth| [m] of a located tag with a known position that was not given to
/// localization.
std::optional<double> error_of(const TagOutcome& outcome);

struct ErrorStatistics {
  std::size_t count = 0;
  double mean = 0.0;  ///< [m], like all members below.
  double median = 0.0;
  double p95 = 0.0;  ///< Linear interpolation between ranks, as NumPy's default.
  double max = 0.0;
  double min = 0.0;
};

/// The quantile below which `fraction` of the values are, with linear interpolation between ranks,
/// as NumPy's default. `rising` must be sorted in ascending order and not be empty.
double quantile(const std::vector<double>& rising, double fraction);

/// Statistics of `errors_m`; none if it is empty.
std::optional<ErrorStatistics> statistics(std::vector<double> errors_m);

/// Error of the believed antenna pose, if it is not the true one.
struct PoseErrorSummary {
  double sigma_m = 0.0;  ///< As stated in the scenario, per axis.
  double time_constant_s = 0.0;
  double yaw_sigma_rad = 0.0;
  double position_rms_m = 0.0;  ///< Actual horizontal error of the antenna in this run.
  /// Errors of localization from the same reads with the true poses, for comparison.
  std::optional<ErrorStatistics> error_with_true_pose_m;
  /// As position_rms_m, after localization corrected the poses; none if it did not.
  std::optional<double> corrected_rms_m{};
};

/// The same reads located with other poses, for comparison.
struct ComparedPose {
  std::string pose;  ///< Their kind, as in Summary::pose.
  /// Horizontal distance between these and the poses of the run [m].
  double position_rms_m = 0.0;
  std::optional<ErrorStatistics> error_m;  ///< Of the tags located with them.
  std::size_t located = 0;
};

/// Results of a method for the reads of all seeds.
struct MethodSummary {
  std::string method;
  std::size_t located = 0;
  std::size_t ambiguous = 0;
  std::size_t not_located = 0;
  std::optional<ErrorStatistics> error_m;
  /// See aligned_errors(); none if the pose is the true one.
  std::optional<ErrorStatistics> aligned_error_m;
};

/// How robots found their poses, over all seeds.
struct FindingSummary {
  std::size_t count = 0;    ///< Number of times that they had to.
  std::size_t noticed = 0;  ///< Of these, times that they noticed that they don't know.
  std::size_t found = 0;    ///< Of all, those that ended with the right pose.
  std::size_t wrong = 0;    ///< Number of times that they believed in a wrong pose.
  std::optional<ErrorStatistics> seconds;   ///< [s], of those found.
  std::optional<ErrorStatistics> driven_m;  ///< [m], of those found.
};

/// A goal that was not reached.
struct UnreachedGoal {
  std::uint64_t seed = 0;
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();  ///< x, y [m], yaw [rad].
  std::string reason;
};

/// Results of robot navigation by laser, map and odometry. The worst of several seeds, unless
/// stated otherwise.
struct NavigationSummary {
  /// Share of the cells of walls visible to a laser that have a mapped one within one cell.
  double walls_found = 0.0;
  double walls_false = 0.0;     ///< Share of mapped walls' cells with no true one within two.
  double walls_double = 0.0;    ///< Share of the walls' cells that were mapped twice.
  double floor_known = 0.0;     ///< Share of the reachable free cells.
  double mapping_path_m = 0.0;  ///< Of the first seed; 0 if the map was given.
  double mapping_s = 0.0;       ///< Simulated, of the first seed.
  std::optional<ErrorStatistics> position_error_m;  ///< Of the belief at 10 Hz, all seeds.
  std::optional<ErrorStatistics> yaw_error_rad;
  std::size_t goals = 0;  ///< Over all seeds.
  std::size_t goals_reached = 0;
  std::vector<UnreachedGoal> goals_unreached;
  double closest_m = 0.0;      ///< Minimum distance between a robot's outline and anything.
  std::size_t collisions = 0;  ///< Number of contacts with anything, over all seeds.
  std::size_t times_lost = 0;  ///< Over all seeds.
  // None if it did not happen.
  std::optional<FindingSummary> unknown_starts;
  std::optional<FindingSummary> kidnapped;
  std::optional<FindingSummary> lost;  ///< Losses without being kidnapped.
};

/// Which effects of the physical models were enabled.
enum class EffectSet { kNone, kAlone, kAllButThis, kAll };

/// The result of the experiment with a selection of effects.
struct EffectCost {
  std::string effect;  ///< Human-readable; "" for none and all.
  EffectSet set = EffectSet::kNone;
  std::size_t tags = 0;  ///< Over all seeds, like all members below.
  std::size_t located = 0;
  std::size_t reads = 0;
  std::optional<ErrorStatistics> error_m;  ///< Of the located ones.
};

/// Everything that a page needs in addition to the files in the run's folder.
struct Summary {
  std::string scenario;              ///< Name.
  std::string description;           ///< One line from the scenario, or "".
  std::vector<std::uint64_t> seeds;  ///< Empty if the reads are external.
  std::string method;                ///< The method used: "hyperbola".
  std::string method_asked;          ///< "auto" if that chose `method`, else the same.
  std::string method_why;            ///< Why it was chosen; "" if it was requested.
  /// The kind of believed pose: "true", "noisy", "odometry", "tf" (transforms), "given".
  std::string pose;
  bool complete = true;  ///< False if the run was interrupted.
  double path_length_m = 0.0;
  std::size_t reads = 0;     ///< Of the first seed.
  double simulated_s = 0.0;  ///< Of the first seed.
  double wall_s = 0.0;       ///< Simulation and localization of all seeds, without file output.
  double real_time_factor = 0.0;  ///< Simulated time of all seeds, including mapping, over wall_s.
  std::optional<PoseErrorSummary> pose_error;
  std::optional<ComparedPose> compared_pose;
  /// The method of the run and others; empty if none were compared.
  std::vector<MethodSummary> compared_methods;
  std::optional<NavigationSummary> navigation;
  std::optional<InventorySummary> inventory;
  std::vector<EffectCost> effects;  ///< Empty if no breakdown was requested.
  std::vector<TagOutcome> tags;     ///< By seed, then by ID.
  std::vector<std::string> warnings;
};

/// "none", "alone", "all_but_this", "all".
std::string to_string(EffectSet set);

/// Number of reads of each tag.
std::map<std::string, std::size_t> count_by_tag(const std::vector<TagRead>& reads);

/// Root mean square of the horizontal distance between poses of the same antenna at the same time
/// [m]: of those in `a` with the interpolated ones of `b`, which must be in chronological order.
/// Antennas with a single pose in `b` are stationary and don't count. None if no poses can be
/// compared.
std::optional<double> position_rms(const std::vector<AntennaPose>& a,
                                   const std::vector<AntennaPose>& b);

/// Errors of all located tags, over all seeds, ascending [m].
std::vector<double> all_errors(const Summary& summary);
std::optional<ErrorStatistics> error_statistics(const Summary& summary);

/// Number of outcomes with this verdict, over all seeds, without reference tags, whose positions
/// were given.
std::size_t count(const Summary& summary, Verdict verdict);

/// Number of outcomes of tags other than reference tags, over all seeds.
std::size_t count_to_locate(const Summary& summary);

/// Number of located tags with an error above `limit_m`.
std::size_t count_over(const Summary& summary, double limit_m);

/// summary.json: scenario, description, seeds, method, method_asked, method_why, pose, complete,
/// path_length_m, reads, simulated_s, wall_s, real_time_factor, pose_error, compared_pose: {pose,
/// position_rms_m, error_m, located} or null, compared_methods: [{method, located, ambiguous,
/// not_located, error_m, aligned_error_m}], inventory: as InventorySummary or null, tags: [{id,
/// seed, verdict, reason, truth_m, moved, estimate_m, error_m, rms_m, expected_error_m,
/// candidates_m, candidates_rms_m, candidates_expected_error_m, reads, reads_used, reference}],
/// error_m: {mean, median, p95, max, min, count}, over_0_3_m, located, ambiguous, not_located,
/// warnings. Values that are unknown or not finite are null. `estimate_m` is null unless the tag is
/// located; `rms_m` and `expected_error_m` are the best candidate's, and the three lists of
/// candidates have the same length. Bytes that are not UTF-8 become U+FFFD.
std::string to_json(const Summary& summary);

/// The inventory alone, in the same format.
std::string to_json(const InventorySummary& inventory);
/// Inverse of that. Throws Error naming `file` and the member that is missing or wrong.
InventorySummary inventory_from_json(const std::string& text, const std::string& file);

/// Inverse of to_json; derived values (errors, counts) are not read, and a number that is null is
/// read as 0. Throws Error "FILE: tags[3].moved is null, expected true or false", on one line, on
/// text that is not such a summary.
Summary summary_from_json(const std::string& text, const std::string& file);

}  // namespace tagfield
