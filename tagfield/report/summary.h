// SPDX-License-Identifier: Apache-2.0
/// @file
/// Estimates judged against the truth, and who was read: the numbers of a run, and their JSON.
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

/// What one reader, or one antenna, read.
struct InventoryShare {
  std::string name;
  std::string reader;  ///< That an antenna belongs to; of a reader its own name.
  double tags = 0.0;   ///< Read at least once.
  double only = 0.0;   ///< Of these, read by no other of the kind.
  double reads = 0.0;
};

/// How much of another zone a reader reads.
struct CrossRead {
  std::string reader;
  double tags = 0.0;
  double reads = 0.0;
};

/// The tags of one zone.
struct ZoneInventory {
  std::string zone;
  std::vector<std::string> readers;  ///< That it is meant for.
  std::size_t tags = 0;
  double read = 0.0;             ///< By anyone.
  double read_by_own = 0.0;      ///< By a reader that it is meant for.
  double crossed = 0.0;          ///< Read by a reader that it is not meant for.
  std::vector<CrossRead> cross;  ///< By those readers.
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
  double share = 0.0;  ///< Of all tags, read by then at least once.
};

/// When a share of all tags had been read.
struct ReachedShare {
  double share = 0.0;
  std::optional<double> time_s;  ///< None where it was not reached in every run.
};

/// What it costs to do without one antenna.
struct InventoryWithout {
  std::string antenna;
  double read = 0.0;  ///< Tags read without it, the mean over the same seeds.
};

/// One run, or the mean of several: counts are then means, too.
struct InventorySummary {
  std::size_t tags = 0;
  double duration_s = 0.0;
  double read = 0.0;  ///< Tags read at least once.
  double reads = 0.0;
  double least_read = 0.0;  ///< Of the runs; the same as `read` of one.
  double most_read = 0.0;
  std::optional<double> median_reads;  ///< Of a tag that was read.
  std::vector<ReachedShare> reached;   ///< 50, 95 and 99 %.
  std::vector<InventoryMoment> curve;  ///< Of the first run; time and share do not fall.
  std::vector<InventoryShare> readers;
  std::vector<InventoryShare> antennas;
  std::vector<ZoneInventory> zones;
  std::vector<LevelInventory> levels;     ///< From the lowest.
  std::vector<InventoryWithout> without;  ///< Each antenna in turn; empty where that was not asked.
};

/// Share of all tags that were read; 0 of none.
double share_of(double part, std::size_t tags);

/// The mean of several runs of one scenario; at least one.
InventorySummary mean_of(const std::vector<InventorySummary>& runs);

/// One tag in one run (one seed).
struct TagOutcome {
  std::uint64_t seed = 0;
  TagEstimate estimate;
  std::size_t reads = 0;  ///< All of the tag, whether localization could use them or not.
  std::optional<Eigen::Vector3d> truth_m;  ///< None where unknown, or where the tag moved.
  bool moved = false;                      ///< The tag did not rest, so it has no one true place.
  bool reference = false;  ///< Localization was told its place, so that it has no error.
};

/// |estimate − truth| [m] of a located tag with a known place that localization was not told.
std::optional<double> error_of(const TagOutcome& outcome);

struct ErrorStatistics {
  std::size_t count = 0;
  double mean = 0.0;  ///< [m], as all below.
  double median = 0.0;
  double p95 = 0.0;  ///< Linear between the ranks around it, as NumPy's default.
  double max = 0.0;
  double min = 0.0;
};

/// The value below which `fraction` of the values lie, linear between the ranks around it, as
/// NumPy's default. `rising` must be sorted and not be empty.
double quantile(const std::vector<double>& rising, double fraction);

/// None where `errors_m` is empty.
std::optional<ErrorStatistics> statistics(std::vector<double> errors_m);

/// Error of the believed antenna pose, where it is not the true one.
struct PoseErrorSummary {
  double sigma_m = 0.0;  ///< As stated in the scenario, per axis.
  double time_constant_s = 0.0;
  double yaw_sigma_rad = 0.0;
  double position_rms_m = 0.0;  ///< Of the antenna in this run, horizontally, as it came out.
  /// Tags located from the same reads with the true poses, for comparison.
  std::optional<ErrorStatistics> error_with_true_pose_m;
  /// As position_rms_m, after localization corrected the poses; none where it did not.
  std::optional<double> corrected_rms_m{};
};

/// The same reads located with other poses, for comparison.
struct ComparedPose {
  std::string pose;  ///< What they are, in the words of Summary::pose.
  /// Between these and the poses of the run [m], horizontally.
  double position_rms_m = 0.0;
  std::optional<ErrorStatistics> error_m;  ///< Of the tags that they locate.
  std::size_t located = 0;
};

/// What a method makes of the reads of all seeds.
struct MethodSummary {
  std::string method;
  std::size_t located = 0;
  std::size_t ambiguous = 0;
  std::size_t not_located = 0;
  std::optional<ErrorStatistics> error_m;
  /// See aligned_errors(); none where the pose is the true one.
  std::optional<ErrorStatistics> aligned_error_m;
};

/// How robots found out where they are, over all seeds.
struct FindingSummary {
  std::size_t count = 0;                   ///< Times that they had to.
  std::size_t noticed = 0;                 ///< Of these, times that they knew that they don't know.
  std::size_t found = 0;                   ///< Of all, those that ended with the right place.
  std::size_t wrong = 0;                   ///< Times that they took another place for theirs.
  std::optional<ErrorStatistics> seconds;  ///< [s], of those found.
  std::optional<ErrorStatistics> driven_m;  ///< Likewise.
};

/// A goal that was not reached.
struct UnreachedGoal {
  std::uint64_t seed = 0;
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();  ///< x, y [m], yaw [rad].
  std::string reason;
};

/// How robots found their way by laser, map and wheels. Of several seeds the worst, where it does
/// not say otherwise.
struct NavigationSummary {
  /// Of the walls that a laser can see, the share of cells with a mapped one within one cell.
  double walls_found = 0.0;
  double walls_false = 0.0;     ///< Of the mapped walls' cells, those with no true one within two.
  double walls_double = 0.0;    ///< Of the walls' cells, those that were mapped twice.
  double floor_known = 0.0;     ///< Of the free cells that can be reached.
  double mapping_path_m = 0.0;  ///< Of the first seed; 0 where the map was given.
  double mapping_s = 0.0;       ///< Simulated, of the first seed.
  std::optional<ErrorStatistics> position_error_m;  ///< Of the belief, at 10 Hz, over all seeds.
  std::optional<ErrorStatistics> yaw_error_rad;
  std::size_t goals = 0;  ///< Over all seeds.
  std::size_t goals_reached = 0;
  std::vector<UnreachedGoal> goals_unreached;
  double closest_m = 0.0;      ///< Between a robot's outline and anything.
  std::size_t collisions = 0;  ///< Times that it came to touch anything, over all seeds.
  std::size_t times_lost = 0;  ///< Over all seeds.
  // None where it did not happen.
  std::optional<FindingSummary> unknown_starts;
  std::optional<FindingSummary> carried;
  std::optional<FindingSummary> lost;  ///< By themselves.
};

/// Which effects of the physical models were on.
enum class EffectSet { kNone, kAlone, kAllButThis, kAll };

/// What came of the experiment with a choice of effects.
struct EffectCost {
  std::string effect;  ///< For people; "" for none and all.
  EffectSet set = EffectSet::kNone;
  std::size_t tags = 0;  ///< Over all seeds, as all below.
  std::size_t located = 0;
  std::size_t reads = 0;
  std::optional<ErrorStatistics> error_m;  ///< Of the located ones.
};

/// Everything that a page needs besides the files in the run's folder.
struct Summary {
  std::string scenario;              ///< Name.
  std::string description;           ///< One line of the scenario, or "".
  std::vector<std::uint64_t> seeds;  ///< Empty where reads came from outside.
  std::string method;                ///< That was used: "hyperbola".
  std::string method_asked;          ///< "auto" where that chose `method`, else the same.
  std::string method_why;            ///< Why it was chosen; "" where it was asked for.
  /// What the believed pose is: "true", "noisy", "odometry", "tf" (transforms), "given".
  std::string pose;
  bool complete = true;  ///< False where the run was interrupted.
  double path_length_m = 0.0;
  std::size_t reads = 0;     ///< Of the first seed.
  double simulated_s = 0.0;  ///< Of the first seed.
  double wall_s = 0.0;       ///< Simulation and localization of all seeds, files and page excepted.
  double real_time_factor = 0.0;  ///< Simulated time of all seeds, mapping too, over wall_s.
  std::optional<PoseErrorSummary> pose_error;
  std::optional<ComparedPose> compared_pose;
  /// The method of the run and others; empty where none were compared.
  std::vector<MethodSummary> compared_methods;
  std::optional<NavigationSummary> navigation;
  std::optional<InventorySummary> inventory;
  std::vector<EffectCost> effects;  ///< Empty where they were not told apart.
  std::vector<TagOutcome> tags;     ///< By seed, then by ID.
  std::vector<std::string> warnings;
};

/// "none", "alone", "all_but_this", "all".
std::string to_string(EffectSet set);

/// How many reads there are of each tag.
std::map<std::string, std::size_t> count_by_tag(const std::vector<TagRead>& reads);

/// Root mean square of the horizontal distance between poses of the same antenna at the same time
/// [m]: of those in `a` with the interpolated ones of `b`, which must be in order of time. Antennas
/// with a single pose in `b` stand still and don't count. None where none does.
std::optional<double> position_rms(const std::vector<AntennaPose>& a,
                                   const std::vector<AntennaPose>& b);

/// Errors of all located tags, over all seeds, rising [m].
std::vector<double> all_errors(const Summary& summary);
std::optional<ErrorStatistics> error_statistics(const Summary& summary);

/// Outcomes with this verdict, over all seeds. Reference tags don't count: their positions were
/// given.
std::size_t count(const Summary& summary, Verdict verdict);

/// Outcomes of tags that are no reference tags, over all seeds.
std::size_t count_to_locate(const Summary& summary);

/// How many located tags are further off than `limit_m`.
std::size_t count_over(const Summary& summary, double limit_m);

/// summary.json: scenario, description, seeds, method, method_asked, method_why, pose, complete,
/// path_length_m, reads, simulated_s, wall_s, real_time_factor, pose_error, compared_pose: {pose,
/// position_rms_m, error_m, located} or null, compared_methods: [{method, located, ambiguous,
/// not_located, error_m, aligned_error_m}], inventory: as InventorySummary or null, tags: [{id,
/// seed, verdict, reason, truth_m, moved, estimate_m, error_m, rms_m, expected_error_m,
/// candidates_m, candidates_rms_m, candidates_expected_error_m, reads, reads_used, reference}],
/// error_m: {mean, median, p95, max, min, count}, over_0_3_m, located, ambiguous, not_located,
/// warnings. What is unknown or not finite is null. `estimate_m` is null unless the tag is located;
/// `rms_m` and `expected_error_m` are the best candidate's, and the three lists of candidates are
/// equally long. Bytes that are not UTF-8 become U+FFFD.
std::string to_json(const Summary& summary);

/// The inventory by itself, as it stands in there.
std::string to_json(const InventorySummary& inventory);
/// The same back. Throws Error naming `file` and the member that is missing or wrong.
InventorySummary inventory_from_json(const std::string& text, const std::string& file);

/// Inverse of to_json; what follows from the rest (errors, counts) is not read, and a figure that
/// is null reads as 0. Throws Error "FILE: tags[3].moved is null, expected true or false", on one
/// line, on text that is not such a summary.
Summary summary_from_json(const std::string& text, const std::string& file);

}  // namespace tagfield
