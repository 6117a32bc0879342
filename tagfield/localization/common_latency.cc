// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/common_latency.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "tagfield/base/median.h"
#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/at_rest.h"
#include "tagfield/localization/drift.h"
#include "tagfield/localization/holograms/coherent_reads.h"
#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/holograms/segments.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/poses/trajectory.h"

namespace tagfield {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Reads per tag. With few reads a latency is now and then found where there is none, or missed:
/// they only decide whether to search with many.
constexpr std::size_t kFewReads = 400;
constexpr std::size_t kManyReads = 3000;
constexpr std::size_t kMaxTags = 20;
constexpr double kMaxTravel = 1.2;    ///< During the latency [m].
constexpr double kMaxLatency = 10.0;  ///< [s]
constexpr double kSuspicious = 4.6;   ///< ln of 10².
constexpr double kCertain = 9.2;      ///< ln of 10⁴.
constexpr double kMinSpeed = 1e-3;    ///< Below this speed no latency is observable [m/s].

/// A located tag whose reads are used.
struct Witness {
  TagPhases phases;
  SegmentedReads layout;  ///< About the position; its antennas are shifted according to a latency.
  Vector3d p_WT = Vector3d::Zero();
};

/// Distance and duration of the antennas' travel while they read a tag, without pauses.
struct Travelled {
  double metres = 0.0;
  double seconds = 0.0;
};

Travelled travelled(const TagPhases& phases) {
  constexpr double kPause = 2.0;  // [s]
  Travelled sum;
  for (const TagPhases::Span& span : phases.spans) {
    for (Index i = span.begin + 1; i < span.begin + span.count; ++i) {
      const double seconds = phases.time_s[i] - phases.time_s[i - 1];
      if (seconds > kPause) continue;
      sum.metres += std::hypot(phases.x[i] - phases.x[i - 1], phases.y[i] - phases.y[i - 1]);
      sum.seconds += seconds;
    }
  }
  return sum;
}

bool have_tracks(const LocalizationProblem& problem, const TagPhases& phases) {
  return std::all_of(phases.spans.begin(), phases.spans.end(), [&](const TagPhases::Span& span) {
    const auto track = problem.tracks.find(span.antenna);
    return track != problem.tracks.end() && !track->second.X_WA.empty();
  });
}

/// Position of a read's antenna `late_s` before the stamp [m].
Vector3d antenna_before(const LocalizationProblem& problem, const std::string& antenna, Time stamp,
                        double late_s) {
  const Trajectory& track = problem.tracks.at(antenna).X_WA;
  return held_position_at(track, stamp - duration_from_seconds(late_s));
}

/// Moves the antennas of a layout to where they were `late_s` before the reads' stamps.
void move_antennas(const LocalizationProblem& problem, double late_s, Witness& witness) {
  for (const TagPhases::Span& span : witness.phases.spans) {
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      const Time stamp = time_from_seconds(witness.phases.time_s[i]);
      const Vector3d p_TA = antenna_before(problem, span.antenna, stamp, late_s) - witness.p_WT;
      SearchRead& read = witness.layout.reads.reads[static_cast<std::size_t>(i)];
      read.x = static_cast<float>(p_TA.x());
      read.y = static_cast<float>(p_TA.y());
      read.z = static_cast<float>(p_TA.z());
    }
  }
}

/// Displacement of the antennas during a latency, for a tag's reads in one direction of travel.
struct Travel {
  Vector3d sum = Vector3d::Zero();  ///< Horizontal [m].
  std::size_t reads = 0;
  [[nodiscard]] Vector3d mean() const { return sum / static_cast<double>(reads); }
};

/// Octants: a tag may be read while passing in either direction.
constexpr int kDirections = 8;
using TravelByDirection = std::array<Travel, kDirections>;

void add_travel(Vector3d travel, TravelByDirection& travels) {
  travel.z() = 0.0;
  const double turns = std::atan2(travel.y(), travel.x()) / kTwoPi + 1.0;
  Travel& of_direction =
      travels[static_cast<std::size_t>(std::lround(turns * kDirections) % kDirections)];
  of_direction.sum += travel;
  ++of_direction.reads;
}

TravelByDirection travels_of(const LocalizationProblem& problem, const SamplesOfTag& samples,
                             double late_s) {
  TravelByDirection travels;
  for (const auto& [antenna, series] : samples) {
    const auto track = problem.tracks.find(antenna);
    if (track == problem.tracks.end() || track->second.X_WA.empty()) continue;
    for (const PhaseSample& sample : series) {
      add_travel(sample.p_WA - antenna_before(problem, antenna, sample.stamp, late_s), travels);
    }
  }
  return travels;
}

/// Overload for a witness whose antennas have been moved.
TravelByDirection travels_of(const Witness& witness) {
  TravelByDirection travels;
  const TagPhases& phases = witness.phases;
  for (Index i = 0; i < phases.size(); ++i) {
    const SearchRead& moved = witness.layout.reads.reads[static_cast<std::size_t>(i)];
    const Vector3d p_TA = Vector3d(phases.x[i], phases.y[i], phases.z[i]) - witness.p_WT;
    add_travel(p_TA - Vector3d(moved.x, moved.y, moved.z), travels);
  }
  return travels;
}

/// Shifts of a tag's position that a latency, to which the antennas have been moved, may cause:
/// opposite to their displacement in each direction in which at least a tenth of the reads were
/// taken [m].
std::vector<Vector3d> moves_of(const Witness& witness, double late_s) {
  if (late_s == 0.0) return {Vector3d::Zero()};
  const auto reads = static_cast<std::size_t>(witness.phases.size());
  std::vector<Vector3d> moves;
  for (const Travel& travel : travels_of(witness)) {
    if (travel.reads > 0 && 10 * travel.reads >= reads) moves.emplace_back(-travel.mean());
  }
  return moves;
}

/// Mean displacement of the antennas during a latency, over the reads of a tag [m].
double mean_travel(const LocalizationProblem& problem, const SamplesOfTag& samples, double late_s) {
  double sum = 0.0;
  std::size_t reads = 0;
  for (const Travel& travel : travels_of(problem, samples, late_s)) {
    sum += travel.sum.norm();
    reads += travel.reads;
  }
  return reads == 0 ? 0.0 : sum / static_cast<double>(reads);
}

struct LikelyMove {
  Vector3d move = Vector3d::Zero();  ///< From the witness's position [m].
  double log_likelihood = 0.0;
};

/// The most likely position on a square grid with `steps` steps to each side.
LikelyMove likeliest_about(const Witness& witness, const Vector3d& middle, int steps, double step) {
  std::vector<Vector3d> moves;
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j) moves.emplace_back(middle + step * Vector3d(i, j, 0.0));
  }
  const std::vector<double> likelihoods =
      by_tiles(moves, [&](const Tile& x, const Tile& y, const Tile& z) {
        return segment_likelihood(witness.layout, kForPlaces, x, y, z);
      });
  const auto best = std::max_element(likelihoods.begin(), likelihoods.end());
  return {moves[static_cast<std::size_t>(best - likelihoods.begin())], *best};
}

/// ln of the likelihood of the best position within 0.2 m of where the latency may shift a
/// witness's.
double log_likelihood_of(const LocalizationProblem& problem, double late_s, Witness& witness) {
  move_antennas(problem, late_s, witness);
  LikelyMove best{Vector3d::Zero(), -std::numeric_limits<double>::infinity()};
  for (const Vector3d& move : moves_of(witness, late_s)) {
    const LikelyMove there = likeliest_about(witness, move, 10, 0.02);
    if (there.log_likelihood > best.log_likelihood) best = there;
  }
  for (const double step : {0.007, 0.0025}) best = likeliest_about(witness, best.move, 3, step);
  return best.log_likelihood;
}

std::optional<Witness> witness_of(const LocalizationProblem& problem,
                                  const LocalizationResult& result, std::size_t index,
                                  std::size_t reads) {
  const TagEstimate& estimate = result.estimates[index];
  const SamplesOfTag& samples = problem.samples.at(estimate.tag);
  const Vector3d& p_WT = estimate.candidates.front().p_WT;
  if (!leaves_slow_errors(problem, estimate.tag, samples, p_WT)) return std::nullopt;
  Witness witness{thinned(coherent_reads(problem, samples), reads), {}, p_WT};
  if (!have_tracks(problem, witness.phases)) return std::nullopt;
  const double wavelength = 2.0 * problem.multiple() * longest_cycle(witness.phases);
  witness.layout = segmented_reads(witness.phases, wavelength, p_WT.z(), p_WT.head<2>());
  return witness;
}

std::vector<Witness> witnesses_of(const LocalizationProblem& problem, int threads,
                                  const LocalizationResult& result, std::size_t reads) {
  const std::vector<std::size_t> some = some_of(claimed_tags(problem, result), kMaxTags);
  std::vector<std::optional<Witness>> found(some.size());
  parallel_for(some.size(), threads,
               [&](std::size_t i) { found[i] = witness_of(problem, result, some[i], reads); });
  std::vector<Witness> witnesses;
  for (std::optional<Witness>& one : found) {
    if (one) witnesses.push_back(std::move(*one));
  }
  return witnesses;
}

/// Latencies to be tried, 0 first: antennas travel an eighth of a wavelength from one to the next.
std::vector<double> latencies_for(const LocalizationProblem& problem,
                                  const std::vector<Witness>& witnesses) {
  Travelled sum;
  double wavelength = 0.0;
  for (const Witness& witness : witnesses) {
    const Travelled one = travelled(witness.phases);
    sum.metres += one.metres;
    sum.seconds += one.seconds;
    wavelength = std::max(wavelength, 2.0 * problem.multiple() * longest_cycle(witness.phases));
  }
  std::vector<double> all{0.0};
  const double speed = sum.seconds > 0.0 ? sum.metres / sum.seconds : 0.0;
  if (!(speed > kMinSpeed)) return all;
  const double step = wavelength / 8.0 / speed;
  const double most = std::min(kMaxTravel / speed, kMaxLatency);
  for (int k = 1; k * step <= most; ++k) {
    all.push_back(k * step);
    all.push_back(-k * step);
  }
  return all;
}

struct CommonLatency {
  double late_s = 0.0;
  double log_gain = 0.0;
  std::size_t in_favour = 0;  ///< Number of witnesses.
};

/// The most likely of `latencies`, the first of which is 0, by the witnesses' log-likelihoods of
/// each.
CommonLatency likeliest_of(const std::vector<double>& latencies,
                           const std::vector<std::vector<double>>& of_witnesses) {
  CommonLatency best;
  for (std::size_t k = 1; k < latencies.size(); ++k) {
    CommonLatency one{latencies[k]};
    for (const std::vector<double>& log_likelihoods : of_witnesses) {
      const double gain = log_likelihoods[k] - log_likelihoods[0];
      one.log_gain += gain;
      if (gain > 0.0) ++one.in_favour;
    }
    if (one.log_gain > best.log_gain) best = one;
  }
  return best;
}

/// The most likely latency from `reads` reads per tag [s]; nullopt if its log-likelihood does not
/// exceed that of no latency by `min_gain`.
std::optional<double> latency_by(const LocalizationProblem& problem, int threads,
                                 const LocalizationResult& result, std::size_t reads,
                                 double min_gain) {
  std::vector<Witness> witnesses = witnesses_of(problem, threads, result, reads);
  const std::vector<double> latencies = latencies_for(problem, witnesses);
  std::vector<std::vector<double>> log_likelihoods(witnesses.size());
  parallel_for(witnesses.size(), threads, [&](std::size_t i) {
    for (const double late_s : latencies) {
      log_likelihoods[i].push_back(log_likelihood_of(problem, late_s, witnesses[i]));
    }
  });
  const CommonLatency best = likeliest_of(latencies, log_likelihoods);
  if (best.log_gain < min_gain || 2 * best.in_favour < witnesses.size()) return std::nullopt;
  return best.late_s;
}

void refuse_moved(const LocalizationProblem& problem, double late_s, LocalizationResult& result) {
  for (const std::size_t i : claimed_tags(problem, result)) {
    TagEstimate& estimate = result.estimates[i];
    const Candidate& claim = estimate.candidates.front();
    const double moved = mean_travel(problem, problem.samples.at(estimate.tag), late_s);
    if (moved < kElsewhere * claim.expected_error_m) continue;
    estimate = not_located(std::move(estimate),
                           fmt::format("the phases of all tags fit reads stamped {:.2f} s {} "
                                       "relative to the poses, which puts it {:.2f} m elsewhere",
                                       std::abs(late_s), late_s > 0.0 ? "late" : "early", moved));
  }
}

/// Whether the drift of the poses explains as much as the latency does: it usually moves the
/// antennas by at most three standard deviations of that.
bool is_drift(const LocalizationProblem& problem, const LocalizationResult& result, double late_s) {
  constexpr double kWithin = 3.0;
  if (problem.drift.empty()) return false;
  std::vector<double> travels;
  for (const std::size_t i : claimed_tags(problem, result)) {
    travels.push_back(mean_travel(problem, problem.samples.at(result.estimates[i].tag), late_s));
  }
  return median(std::move(travels)) <= kWithin * usual_drift_while_read(problem);
}

}  // namespace

void refuse_common_latency(const LocalizationProblem& problem, int threads,
                           LocalizationResult& result, Diagnostics& diagnostics) {
  const bool is_error_stated = stated_pose_error(problem) || !problem.drift.empty();
  if (!result.corrected_poses.empty() && is_error_stated) return;
  if (!latency_by(problem, threads, result, kFewReads, kSuspicious)) return;
  const std::optional<double> late_s = latency_by(problem, threads, result, kManyReads, kCertain);
  if (!late_s || is_drift(problem, result, *late_s)) return;
  warn_of_latency(*late_s, diagnostics);
  refuse_moved(problem, *late_s, result);
}

}  // namespace tagfield
