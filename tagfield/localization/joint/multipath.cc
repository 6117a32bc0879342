#include "tagfield/localization/joint/multipath.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/robust.h"
#include "tagfield/localization/holograms/stretches.h"
#include "tagfield/localization/joint/internal/joint_state.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

/// Places worse than this are no start [m].
constexpr double kWorstStart = 0.5;

/// The poses of an antenna at its samples: where these say, turned as its track.
std::vector<RigidTransform> poses_of(const LocalizationProblem& problem, const std::string& antenna,
                                     const std::vector<PhaseSample>& series) {
  std::vector<RigidTransform> poses;
  poses.reserve(series.size());
  const auto track = problem.tracks.find(antenna);
  for (const PhaseSample& sample : series) {
    RigidTransform X_WA;
    if (track != problem.tracks.end()) X_WA = held_pose_at(track->second.X_WA, sample.stamp);
    X_WA.translation = sample.p_WA;
    poses.push_back(X_WA);
  }
  return poses;
}

/// Replies of a tag about a place, by antenna and sample.
using TracedSamples = std::map<std::string, std::vector<TracedReply>>;

/// Doubled phases are as of twice the carrier.
double times_of(const LocalizationProblem& problem) { return problem.half_turns ? 2.0 : 1.0; }

/// Traced to `p_WT` from where the samples say that the antennas are.
TracedSamples traced(const LocalizationProblem& problem, const std::string& tag,
                     const SamplesOfTag& samples, const Vector3d& p_WT) {
  TracedSamples all;
  for (const auto& [antenna, series] : samples) {
    std::vector<double> carriers_hz;
    carriers_hz.reserve(series.size());
    for (const PhaseSample& sample : series) {
      carriers_hz.push_back(sample.frequency_hz / times_of(problem));
    }
    all[antenna] =
        problem.trace(tag, p_WT, antenna, poses_of(problem, antenna, series), carriers_hz);
  }
  return all;
}

/// What the waves come to at a place.
struct Field {
  std::complex<double> all = 0.0;
  double direct = 0.0;      ///< Amplitude of the direct wave,
  double amplitudes = 0.0;  ///< and the sum of all.
  // Each wave times its direction at the tag and at the antenna.
  Eigen::Vector3cd at_tag = Eigen::Vector3cd::Zero();
  Eigen::Vector3cd at_antenna = Eigen::Vector3cd::Zero();
  /// 0 where the direct way is blocked.
  [[nodiscard]] double directness() const { return amplitudes > 0.0 ? direct / amplitudes : 0.0; }
};

Field field_at(const std::vector<TracedWave>& waves, const Vector3d& p, double wavenumber) {
  Field field;
  for (const TracedWave& wave : waves) {
    const Vector3d way = p - wave.source_W;
    const double r = std::max(way.norm(), 0.01);
    const std::complex<double> here = wave.amplitude / r * std::polar(1.0, -wavenumber * r);
    field.all += here;
    field.at_tag += here * way / r;
    field.at_antenna += here * wave.departure_W;
    field.amplitudes += std::abs(here);
    if (wave.direct) field.direct = std::abs(here);
  }
  return field;
}

/// Phase of a reply less that of the direct path alone, 2k|p − p_WA|, and how direct it came.
struct Bend {
  double phase_rad = 0.0;
  double directness = 0.0;
  // By how much 1/2k of the phase grows with the tag's and with the antenna's place.
  Vector3d by_place = Vector3d::Zero();
  Vector3d by_antenna = Vector3d::Zero();
};

Bend bend_at(const TracedReply& reply, const Vector3d& p_WA, const Vector3d& p, double carrier_hz) {
  const double k = kTwoPi / wavelength(carrier_hz);
  const Field forward = field_at(reply.forward, p, k);
  const Field backward = reply.backward.empty() ? forward : field_at(reply.backward, p, k);
  const double range = std::max((p - p_WA).norm(), 0.01);
  Bend bend;
  bend.directness = std::min(forward.directness(), backward.directness());
  if (!(bend.directness > 0.0)) return bend;
  const Vector3d straight = (p - p_WA) / range;
  bend.phase_rad = -std::arg(forward.all) - std::arg(backward.all) - 2.0 * k * range;
  bend.by_place =
      0.5 * (forward.at_tag / forward.all + backward.at_tag / backward.all).real() - straight;
  bend.by_antenna =
      straight -
      0.5 * (forward.at_antenna / forward.all + backward.at_antenna / backward.all).real();
  return bend;
}

/// Near a null of the field phases turn so fast that no slope holds for long [m/m].
constexpr double kSteepest = 2.0;

/// Calls `use(antenna, number, bend)` for each sample that came direct enough if the tag is at `p`,
/// near the place that `replies` were traced to from `corrected`.
template <typename Use>
void for_each_bend(const LocalizationProblem& problem, const SamplesOfTag& corrected,
                   const TracedSamples& replies, const Vector3d& p, double least_directness,
                   const Use& use) {
  for (const auto& [antenna, series] : corrected) {
    const std::vector<TracedReply>& of_antenna = replies.at(antenna);
    for (std::size_t i = 0; i < series.size(); ++i) {
      const Bend bend =
          bend_at(of_antenna[i], series[i].p_WA, p, series[i].frequency_hz / times_of(problem));
      const bool is_used = bend.directness >= least_directness &&
                           std::max(bend.by_place.norm(), bend.by_antenna.norm()) < kSteepest;
      if (is_used) use(antenna, i, bend);
    }
  }
}

/// Samples freed of the bends.
SamplesOfTag straightened(const LocalizationProblem& problem, const SamplesOfTag& samples,
                          const SamplesOfTag& corrected, const TracedSamples& replies,
                          const Vector3d& p, double least_directness) {
  SamplesOfTag straight;
  for_each_bend(problem, corrected, replies, p, least_directness,
                [&](const std::string& antenna, std::size_t i, const Bend& bend) {
                  PhaseSample sample = samples.at(antenna)[i];
                  sample.phase_rad =
                      wrap_to_two_pi(sample.phase_rad - times_of(problem) * bend.phase_rad);
                  straight[antenna].push_back(sample);
                });
  return straight;
}

/// A tag's samples, and where the antennas truly are, as far as that is known.
struct Sight {
  SamplesOfTag samples;
  SamplesOfTag corrected;
};

/// ln of the likelihood of the tag at `p` with its bends taken out. Reads that hardly came the
/// direct way tell nothing.
double likelihood_at(const LocalizationProblem& problem, const Sight& sight,
                     const TracedSamples& replies, const Vector3d& p, double least_directness) {
  SamplesOfTag straight =
      straightened(problem, sight.samples, sight.corrected, replies, p, least_directness);
  const TagPhases phases = coherent_reads(problem, straight);
  if (phases.size() == 0) return 0.0;
  const double wavelength = 2.0 * times_of(problem) * longest_cycle(phases);
  const StretchedReads reads = stretched_reads(phases, wavelength, p.z(), p.head<2>());
  const Tile here = Tile::Zero();
  return static_cast<double>(
      stretch_likelihood(reads, {1, kStretchLengths - 1}, here, here, here)[0]);
}

/// A start with what is known of its uncertainty.
struct Start {
  Vector3d p_WT;
  double log_likelihood = 0.0;
};

SamplesOfTag some_of(const SamplesOfTag& samples, std::size_t count) {
  const std::size_t stride = count_reads(samples) / count + 1;
  SamplesOfTag some;
  for (const auto& [antenna, series] : samples) {
    for (std::size_t i = 0; i < series.size(); i += stride) some[antenna].push_back(series[i]);
  }
  return some;
}

Sight some_of(const Sight& sight, std::size_t count) {
  return {some_of(sight.samples, count), some_of(sight.corrected, count)};
}

bool is_likelier(const Start& a, const Start& b) { return a.log_likelihood > b.log_likelihood; }

/// Likely places, the best first.
using Starts = std::vector<Start>;

/// A square of places, `step` [m] apart.
struct Square {
  Vector3d middle = Vector3d::Zero();
  int steps = 1;  ///< To each side.
  double step = 0.024;
};

/// Looks at the places of a square, with the replies traced to about there.
Starts look_about(const LocalizationProblem& problem, const Sight& sight,
                  const TracedSamples& replies, const Square& square, double least_directness) {
  Starts all;
  const std::size_t width = 2 * static_cast<std::size_t>(square.steps) + 1;
  all.reserve(width * width);
  for (int i = -square.steps; i <= square.steps; ++i) {
    for (int j = -square.steps; j <= square.steps; ++j) {
      const Vector3d p = square.middle + square.step * Vector3d(i, j, 0.0);
      all.push_back({p, likelihood_at(problem, sight, replies, p, least_directness)});
    }
  }
  std::stable_sort(all.begin(), all.end(), is_likelier);
  return all;
}

/// Those at least so far from better ones [m].
Starts apart(const Starts& all, double distance, std::size_t count) {
  Starts kept;
  for (const Start& one : all) {
    const bool is_apart = std::all_of(kept.begin(), kept.end(), [&](const Start& other) {
      return (other.p_WT - one.p_WT).norm() > distance;
    });
    if (is_apart) kept.push_back(one);
    if (kept.size() == count) break;
  }
  return kept;
}

/// All places within `reach` [m] of a candidate, in squares of 0.24 m to the middles of which
/// replies are traced, as paths come and go.
Starts look_far(const LocalizationProblem& problem, const std::string& tag, const Sight& sight,
                const Candidate& candidate, double reach, double least_directness) {
  constexpr int kSteps = 5;
  constexpr int kMostSquares = 3;  // To each side.
  const double width = (2 * kSteps) * Square{}.step;
  const int squares = std::clamp(static_cast<int>(std::ceil(reach / width - 0.5)), 0, kMostSquares);
  Starts all;
  for (int i = -squares; i <= squares; ++i) {
    for (int j = -squares; j <= squares; ++j) {
      const Square square{candidate.p_WT + width * Vector3d(i, j, 0.0), kSteps};
      const TracedSamples replies = traced(problem, tag, sight.corrected, square.middle);
      const Starts here = look_about(problem, sight, replies, square, least_directness);
      all.insert(all.end(), here.begin(), here.end());
    }
  }
  std::stable_sort(all.begin(), all.end(), is_likelier);
  return all;
}

/// The best place about a candidate: of those within two and a half deviations, seen with few
/// reads, the better ones are looked at more closely with many.
Start best_about(const LocalizationProblem& problem, const std::string& tag, const Sight& sight,
                 const Candidate& candidate, double least_directness) {
  constexpr std::size_t kFewReads = 200;
  constexpr std::size_t kManyReads = 500;
  constexpr std::size_t kCloser = 8;
  constexpr double kApart = 0.03;  // [m]
  const double reach = 2.5 * candidate.expected_error_m / std::sqrt(2.0);
  const Starts far =
      look_far(problem, tag, some_of(sight, kFewReads), candidate, reach, least_directness);
  const Sight many = some_of(sight, kManyReads);
  Start best{candidate.p_WT, -1.0};
  for (const Start& start : apart(far, kApart, kCloser)) {
    const TracedSamples here = traced(problem, tag, many.corrected, start.p_WT);
    Start closer = start;
    for (const double step : {0.008, 0.003}) {
      closer = look_about(problem, many, here, {closer.p_WT, 2, step}, least_directness).front();
    }
    if (closer.log_likelihood > best.log_likelihood) best = closer;
  }
  return best;
}

Start best_start(const LocalizationProblem& problem, const TagEstimate& estimate,
                 const Sight& sight, double least_directness) {
  Start best{Vector3d::Zero(), -1.0};
  for (const Candidate& candidate : estimate.candidates) {
    const Start start = best_about(problem, estimate.tag, sight, candidate, least_directness);
    if (start.log_likelihood > best.log_likelihood) best = start;
  }
  return best;
}

/// Robust estimates, loosely limited: they are but starts.
std::vector<TagEstimate> robust_estimates(const LocalizationProblem& problem, int threads,
                                          Diagnostics& diagnostics) {
  LocalizationProblem loose = problem;
  loose.limits.max_expected_error_m = std::max(kWorstStart, problem.limits.max_expected_error_m);
  return robust_method().locate(loose, threads, diagnostics).estimates;
}

Sight sight_of(const JointState& state, const SamplesOfTag& samples) {
  return {samples, corrected_samples(*state.problem, state.system.knots, state.system.u, samples)};
}

/// By antenna and time [s], so that phases find those of their reads.
using BendsByRead = std::map<std::pair<std::string, double>, Bend>;

/// One tag's samples without their bends, which are those of where the state stands.
struct Straight {
  SamplesOfTag samples;
  BendsByRead bends;
};

Straight straighten(const JointState& state, std::size_t index, const SamplesOfTag& given,
                    double least_directness) {
  const LocalizationProblem& problem = *state.problem;
  const JointTag& tag = state.system.tags[index];
  const Sight sight = sight_of(state, given);
  const Vector3d p = to_place(tag.height, tag.fit.unknowns);
  const TracedSamples replies = traced(problem, tag.id, sight.corrected, p);
  Straight straight;
  straight.samples =
      straightened(problem, sight.samples, sight.corrected, replies, p, least_directness);
  for_each_bend(problem, sight.corrected, replies, p, least_directness,
                [&](const std::string& antenna, std::size_t i, const Bend& bend) {
                  const Time stamp = given.at(antenna)[i].stamp;
                  straight.bends[{antenna, to_seconds(stamp)}] = bend;
                });
  return straight;
}

BendSlopes slopes_of(const JointState& state, const JointTag& tag, const BendsByRead& bends) {
  BendSlopes slopes;
  slopes.p_WT = to_place(tag.height, tag.fit.unknowns);
  slopes.moved.resize(2, tag.phases.size());
  slopes.by_place.resize(3, tag.phases.size());
  slopes.by_antenna.resize(3, tag.phases.size());
  for (const TagPhases::Span& span : tag.phases.spans) {
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const Bend& bend = bends.at({span.antenna, tag.phases.time_s[i]});
      slopes.moved.col(i) = displacement_at(state.system, tag, i);
      slopes.by_place.col(i) = bend.by_place;
      slopes.by_antenna.col(i) = bend.by_antenna;
    }
  }
  return slopes;
}

std::vector<Vector3d> places_of(const JointState& state) {
  std::vector<Vector3d> places;
  places.reserve(state.system.tags.size());
  for (const JointTag& tag : state.system.tags) {
    places.push_back(to_place(tag.height, tag.fit.unknowns));
  }
  return places;
}

double farthest_move(const std::vector<Vector3d>& before, const std::vector<Vector3d>& after) {
  double most = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    most = std::max(most, (after[i] - before[i]).norm());
  }
  return most;
}

/// Of the waves that add up at the tag's place with the corrected poses, less their bends.
double share_at(const JointState& state, std::size_t index) {
  const LocalizationProblem& problem = *state.problem;
  const JointTag& tag = state.system.tags[index];
  const TagPhases phases =
      coherent_reads(problem, sight_of(state, *state.samples[index]).corrected);
  return coherent_share(phases, tag.height, tag.fit.unknowns);
}

/// Less is a wrong place, or a wrong world: noise alone leaves e^(−σ²/2).
double least_share(const JointState& state) {
  constexpr double kOfNoiseAlone = 0.85;
  return kOfNoiseAlone * std::exp(-0.5 * state.system.noise_rad * state.system.noise_rad);
}

/// A run of the method under way.
struct Run {
  JointState state;
  std::vector<TagEstimate> starts;         ///< By tag of the state, as are
  std::vector<const SamplesOfTag*> given;  ///< the samples as they were measured,
  std::vector<Straight> straight;          ///< and without their bends.
};

/// Tags whose waves don't add up are looked for anew, now that others tell the pose error.
void find_lost(Run& run, const MultipathOptions& options, int threads) {
  JointState& state = run.state;
  parallel_for(run.given.size(), threads, [&](std::size_t i) {
    JointTag& tag = state.system.tags[i];
    if (tag.fixed || share_at(state, i) >= least_share(state)) return;
    const Sight sight = sight_of(state, *run.given[i]);
    tag.fit.unknowns = to_unknowns(
        tag.height,
        best_start(*state.problem, run.starts[i], sight, options.least_directness).p_WT);
  });
}

/// Takes the bends out where the state stands.
void straighten_all(Run& run, const MultipathOptions& options, int threads) {
  JointState& state = run.state;
  std::vector<Straight> next(run.given.size());
  parallel_for(run.given.size(), threads, [&](std::size_t i) {
    next[i] = straighten(state, i, *run.given[i], options.least_directness);
  });
  run.straight = std::move(next);
  for (std::size_t i = 0; i < run.straight.size(); ++i) {
    take_samples(state, i, run.straight[i].samples);
    JointTag& tag = state.system.tags[i];
    tag.slopes = slopes_of(state, tag, run.straight[i].bends);
  }
}

/// Traces and fits, again and again.
void fit_through_world(Run& run, const MultipathOptions& options, int threads) {
  constexpr double kSettled = 3e-4;  // [m]
  JointState& state = run.state;
  for (int round = 0; round < options.rounds; ++round) {
    const std::vector<Vector3d> before = places_of(state);
    straighten_all(run, options, threads);
    fit_unwrapped_jointly(state, threads);
    if (round == 1 && !state.problem->pose_error) learn_pose_error(state, threads);
    if (round == 2 || round == 4) {
      find_lost(run, options, threads);
    } else if (round > 1 && farthest_move(before, places_of(state)) < kSettled) {
      break;
    }
  }
}

/// Whether what is left of the tag's phases is about their noise: its reads count for at least so
/// much.
bool fits_world(const JointState& state, std::size_t index, double least_weight) {
  return state.system.tags[index].weight >= least_weight &&
         share_at(state, index) >= least_share(state);
}

/// A wrong world fits a tag here and there, a right one most.
bool is_right_world(const JointState& state) {
  constexpr double kLeastWeight = 0.2;
  std::size_t fitting = 0;
  for (std::size_t i = 0; i < state.system.tags.size(); ++i) {
    if (fits_world(state, i, kLeastWeight)) ++fitting;
  }
  return 2 * fitting > state.system.tags.size();
}

/// Where the waves don't add up the robust estimate stays, by the limits that were asked for.
TagEstimate estimate_of(const Run& run, const JointCovariance& covariance, std::size_t index) {
  constexpr double kLeastWeight = 0.1;
  const JointState& state = run.state;
  TagEstimate estimate = run.starts[index];
  if (fits_world(state, index, kLeastWeight)) {
    estimate.reads = static_cast<std::size_t>(state.system.tags[index].phases.size());
    estimate.candidates = {candidate_of(state.system, index, covariance.of_tag[index])};
  }
  judge(state.problem->limits, estimate);
  return estimate;
}

LocalizationResult without_world(const LocalizationProblem& problem) {
  LocalizationResult result;
  result.method = "multipath";
  result.estimates.reserve(problem.samples.size());
  for (const auto& [tag, samples] : problem.samples) {
    const auto known = problem.reference_tags.find(tag);
    result.estimates.push_back(
        known != problem.reference_tags.end()
            ? reference_estimate(tag, known->second)
            : not_located(begun(tag, samples),
                          "no world is known whose paths could be traced (a scenario with "
                          "model: multipath tells it)"));
  }
  return result;
}

LocalizationResult locate_through_world(const LocalizationProblem& problem, int threads,
                                        Diagnostics& diagnostics, const MultipathOptions& options) {
  if (!problem.trace) return without_world(problem);
  LocalizationResult result;
  result.method = "multipath";
  result.estimates = robust_estimates(problem, threads, diagnostics);
  std::vector<std::size_t> numbers;  // Of estimates that are a start.
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    if (!result.estimates[i].candidates.empty()) numbers.push_back(i);
  }
  if (numbers.empty()) return result;
  Run run;
  std::vector<PlacedTag> placed(numbers.size());
  run.given.resize(numbers.size());
  run.starts.resize(numbers.size());
  parallel_for(numbers.size(), threads, [&](std::size_t k) {
    const TagEstimate& estimate = result.estimates[numbers[k]];
    const SamplesOfTag& samples = problem.samples.at(estimate.tag);
    const bool is_known = problem.reference_tags.count(estimate.tag) > 0;
    run.given[k] = &samples;
    run.starts[k] = estimate;
    placed[k] = {
        estimate.tag, &samples,
        is_known
            ? problem.reference_tags.at(estimate.tag)
            : best_start(problem, estimate, {samples, samples}, options.least_directness).p_WT};
  });
  run.state = begin_at(problem, placed);
  fit_through_world(run, options, threads);
  if (!is_right_world(run.state)) {
    diagnostics.warn(
        "the phases of most tags don't fit the known world: reflections are not taken out");
    for (const std::size_t i : numbers) {
      const bool is_known = problem.reference_tags.count(result.estimates[i].tag) > 0;
      if (!is_known) judge(problem.limits, result.estimates[i]);
    }
    return result;
  }
  const JointCovariance covariance = covariance_of(run.state.system, threads);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (run.state.system.tags[k].fixed) continue;
    result.estimates[numbers[k]] = estimate_of(run, covariance, k);
  }
  result.corrected_poses = corrected_poses(problem, run.state.system.knots, run.state.system.u);
  return result;
}

const OptionTable<MultipathOptions>& option_table() {
  using O = MultipathOptions;
  static const OptionTable<O> of{
      {setting<O>("least_directness", "", "share of the direct path's amplitude in replies in use",
                  &O::least_directness, {0.0, true, 1.0}),
       setting<O>("rounds", "", "of tracing and fitting", &O::rounds, kAtLeastOne)}};
  return of;
}

LocateFunction bound_to(const MultipathOptions& options) {
  return [options](const LocalizationProblem& problem, int threads, Diagnostics& diagnostics) {
    return locate_through_world(problem, threads, diagnostics, options);
  };
}

}  // namespace

Method multipath_method(const MultipathOptions& options) {
  check_options(option_table(), options);
  return {"multipath", "all tags and the pose error, less the traced reflections of a known world",
          bound_to(options), helps_of(option_table().table, options),
          [options](const MethodSettings& settings) {
            return bound_to(changed_options(option_table(), options, settings));
          }};
}

}  // namespace tagfield
