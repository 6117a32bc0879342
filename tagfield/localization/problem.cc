// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/problem.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/range_check.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/jumping_bodies.h"
#include "tagfield/localization/phase_jumps.h"
#include "tagfield/localization/phase_unit.h"
#include "tagfield/localization/pi_ambiguity.h"
#include "tagfield/localization/stops.h"

namespace tagfield {
namespace {

void require_finite(double value, const std::string& what) {
  if (!std::isfinite(value)) throw Error(what + " must be finite");
}

void check(const PoseErrorModel& model) {
  if (!(std::isfinite(model.sigma_m) && model.sigma_m >= 0.0 &&
        std::isfinite(model.yaw_sigma_rad) && model.yaw_sigma_rad >= 0.0)) {
    throw Error("the standard deviations of the pose error must be finite and at least 0");
  }
  require_positive("time_constant_s", model.time_constant_s);
}

void check(const MapError& error) {
  const bool has_place = !error.origin_W || error.origin_W->allFinite();
  if (!has_place || !error.covariance.allFinite() ||
      (error.covariance.diagonal().array() < 0.0).any()) {
    throw Error("the map's error must be finite, and its variances at least 0");
  }
}

void check(const KnownBeforehand& known) {
  if (known.heights.of_all) require_finite(*known.heights.of_all, "the height of all tags");
  for (const auto& [tag, height] : known.heights.of_tag) {
    require_finite(height, "the height of tag '" + tag + "'");
  }
  for (const auto& [tag, place] : known.reference_tags) {
    if (!place.allFinite()) throw Error("the position of tag '" + tag + "' must be finite");
  }
  for (const KnownOffset& offset : known.offsets) {
    require_finite(offset.offset_rad, "the offset of antenna '" + offset.antenna + "'");
  }
  if (known.pose_error) check(*known.pose_error);
  if (known.map_error) check(*known.map_error);
  require_positive("max_expected_error_m", known.limits.max_expected_error_m);
  require_positive("max_rms_m", known.limits.max_rms_m);
}

/// The offset of a single channel takes precedence over that of all.
const KnownOffset* offset_of(const std::vector<KnownOffset>& offsets, const std::string& antenna,
                             double frequency_hz) {
  const KnownOffset* of_all = nullptr;
  for (const KnownOffset& offset : offsets) {
    if (offset.antenna != antenna) continue;
    if (!offset.frequency_hz) {
      of_all = &offset;
    } else if (std::abs(*offset.frequency_hz - frequency_hz) < 1.0) {
      return &offset;
    }
  }
  return of_all;
}

/// Subtracts known offsets and returns the antennas for which every sample had one.
std::set<std::string> take_out_offsets(const std::vector<KnownOffset>& offsets,
                                       SamplesByTag& samples) {
  std::set<std::string> known;
  std::set<std::string> unknown;
  for (auto& [tag, of_tag] : samples) {
    for (auto& [antenna, series] : of_tag) {
      for (PhaseSample& sample : series) {
        const KnownOffset* offset = offset_of(offsets, antenna, sample.frequency_hz);
        (offset == nullptr ? unknown : known).insert(antenna);
        if (offset == nullptr) continue;
        sample.phase_rad = wrap_to_two_pi(sample.phase_rad - offset->offset_rad);
      }
    }
  }
  for (const std::string& antenna : unknown) known.erase(antenna);
  return known;
}

/// Mean height of the antennas that moved while they read a tag, as only those locate it; of all
/// antennas if none moved; 0 without samples.
double mean_antenna_height(const SamplesOfTag& samples) {
  double sum[2] = {0.0, 0.0};
  double count[2] = {0.0, 0.0};
  for (const auto& [antenna, series] : samples) {
    const int moved = extent_of(series) >= kStillExtent ? 1 : 0;
    for (const PhaseSample& sample : series) sum[moved] += sample.p_WA.z();
    count[moved] += static_cast<double>(series.size());
  }
  for (const int moved : {1, 0}) {
    if (count[moved] > 0.0) return sum[moved] / count[moved];
  }
  return 0.0;
}

/// The map error with its origin filled in; nullopt if there is no pose.
std::optional<MapError> map_error_of(const KnownBeforehand& known,
                                     const std::map<std::string, BelievedTrack>& tracks) {
  std::optional<MapError> error = known.map_error;
  if (!error || error->origin_W) return error;
  const StampedPose* first = nullptr;
  for (const auto& [antenna, track] : tracks) {
    if (track.X_WA.empty()) continue;
    if (first == nullptr || track.X_WA.front().stamp < first->stamp) first = &track.X_WA.front();
  }
  if (first == nullptr) return std::nullopt;
  error->origin_W = first->X_WB.translation.head<2>();
  return error;
}

/// Whether the poses are stated to have no error, so that even a jump is no error.
bool is_exact(const std::optional<PoseErrorModel>& error) {
  return error && error->sigma_m <= 0.0 && error->yaw_sigma_rad <= 0.0;
}

std::map<std::string, std::vector<Drift>> drift_of(
    const KnownBeforehand& known, const std::map<std::string, BelievedTrack>& tracks) {
  std::map<std::string, std::vector<Drift>> by_antenna;
  if (!known.drift || known.pose_error) return by_antenna;
  for (const auto& [antenna, track] : tracks) {
    std::vector<Drift> drift = known.drift(antenna, track.X_WA);
    if (!drift.empty()) by_antenna[antenna] = std::move(drift);
  }
  return by_antenna;
}

std::optional<double> known_height(const LocalizationProblem& problem, const std::string& tag) {
  const auto known = problem.heights.of_tag.find(tag);
  if (known != problem.heights.of_tag.end()) return known->second;
  return problem.heights.of_all;
}

/// Whether the phases can be in radians. Warns if they can't.
bool are_radians(const SamplesByTag& samples, Diagnostics& diagnostics) {
  constexpr double kLeast = 0.4;
  const double share = occupied_cycle(samples);
  if (share >= kLeast) return true;
  diagnostics.warn(fmt::format(
      "all phases lie within {:.0f} % of a cycle, although the antennas moved by metres: they "
      "can't be in radians and are not used (a dataset's profile states the unit)",
      100.0 * share));
  return false;
}

void leave_one_side_of_jumps(LocalizationProblem& problem, Diagnostics& diagnostics) {
  std::vector<JumpingBody> bodies = jumping_bodies(problem);
  problem.pose_jump_m = keep_one_side(bodies, problem.samples);
  warn_of_pose_jumps(bodies, diagnostics);
}

}  // namespace

void warn_of_unknown_heights(const KnownBeforehand& known, const std::vector<std::string>& tags,
                             Diagnostics& diagnostics) {
  const TagHeights& heights = known.heights;
  if (heights.of_all || heights.estimated) return;
  std::vector<std::string> without;
  for (const std::string& tag : tags) {
    const bool is_known = heights.of_tag.count(tag) > 0 || known.reference_tags.count(tag) > 0;
    if (!is_known) without.push_back(tag);
  }
  if (without.empty()) return;
  const std::string whose =
      heights.of_tag.empty()
          ? "the tags' heights are not stated"
          : fmt::format("the heights of {} of {} tags are not stated, such as '{}'", without.size(),
                        tags.size(), without.front());
  diagnostics.warn(whose +
                   ": they are taken to be as high as the antennas, and the resulting shift of "
                   "positions is not in the expected errors");
}

LocalizationProblem make_problem(const std::vector<TagRead>& reads,
                                 const std::vector<AntennaPose>& poses,
                                 const KnownBeforehand& known, Diagnostics& diagnostics) {
  return make_problem(each_of(reads), poses, known, diagnostics);
}

LocalizationProblem make_problem(const EachRead& each_read, const std::vector<AntennaPose>& poses,
                                 const KnownBeforehand& known, Diagnostics& diagnostics) {
  check(known);
  LocalizationProblem problem;
  problem.tracks = tracks_of(poses, diagnostics);
  JoinedReads joined =
      join_reads_with_tracks(each_read, problem.tracks, known.max_pose_gap_s, diagnostics);
  problem.samples = std::move(joined.samples);
  if (!is_exact(known.pose_error)) leave_one_side_of_jumps(problem, diagnostics);
  problem.has_phases = joined.has_phases && are_radians(problem.samples, diagnostics);
  problem.offset_known = take_out_offsets(known.offsets, problem.samples);
  problem.pi_ambiguity =
      problem.has_phases && known.pi_ambiguity.value_or(has_pi_ambiguity(problem.samples));
  if (problem.pi_ambiguity) {
    if (!known.pi_ambiguity) {
      diagnostics.warn("phases jump by π: they are taken as ambiguous (φ or φ + π)");
    }
    double_phases(problem.samples);
  }
  if (problem.has_phases) {
    split_at_phase_jumps(find_phase_jumps(problem.samples), problem.multiple(), problem.samples,
                         problem.offset_known, diagnostics);
  }
  merge_stops(problem.samples);
  problem.area = known.area;
  problem.heights = known.heights;
  problem.reference_tags = known.reference_tags;
  problem.pose_error = known.pose_error;
  problem.map_error = map_error_of(known, problem.tracks);
  problem.drift = drift_of(known, problem.tracks);
  problem.limits = known.limits;
  problem.trace = known.trace;
  problem.world_sigma_m = known.world_sigma_m;
  problem.circular = known.circular;
  return problem;
}

bool is_orientation_known(const BelievedTrack& track) {
  return std::any_of(track.X_WA.begin(), track.X_WA.end(), [](const auto& stamped) {
    return !stamped.X_WB.rotation.isApprox(Eigen::Quaterniond::Identity(), 1e-9);
  });
}

double plane_height(const LocalizationProblem& problem, const std::string& tag) {
  const auto samples = problem.samples.find(tag);
  const SamplesOfTag none;
  return known_height(problem, tag)
      .value_or(mean_antenna_height(samples == problem.samples.end() ? none : samples->second));
}

std::optional<HeightSide> side_to_estimate(const LocalizationProblem& problem,
                                           const std::string& tag) {
  return known_height(problem, tag) ? std::nullopt : problem.heights.estimated;
}

}  // namespace tagfield
