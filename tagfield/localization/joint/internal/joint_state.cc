// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/joint_state.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/median.h"
#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/fit/envelope_matrix.h"
#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/holograms/coherent_reads.h"
#include "tagfield/localization/joint/drift_steps.h"
#include "tagfield/localization/joint/internal/joint_equations.h"
#include "tagfield/localization/joint/internal/periods.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/phase_curves/least_squares.h"
#include "tagfield/localization/phase_noise.h"
#include "tagfield/localization/residuals.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// Knots per time constant: linear interpolation misses 2 % of the variance.
constexpr double kStateKnots = 40.0;
constexpr double kMaxWork = 3e10;  ///< Multiplications per solution: about a second.
constexpr double kKnotsToLook = 1000.0;

PoseErrorModel model_of(const LocalizationProblem& problem) {
  return problem.pose_error.value_or(kUsualPoseError);
}

bool has_stated_covariances(const LocalizationProblem& problem) {
  return std::any_of(problem.tracks.begin(), problem.tracks.end(),
                     [](const auto& named) { return !named.second.covariance.empty(); });
}

/// Periods with reads, separated by pauses longer than `longest_pause_s`.
std::vector<Period> reading_periods(const LocalizationProblem& problem, double longest_pause_s) {
  std::vector<double> times_s;
  for (const auto& [tag, of_tag] : problem.samples) {
    for (const auto& [antenna, series] : of_tag) append_times(series, times_s);
  }
  return periods_of(std::move(times_s), longest_pause_s);
}

/// Multiplications to factorize the knots' matrix after eliminating the tags: each tag couples all
/// knots of its reads, starting with the first.
double work_of(const LocalizationProblem& problem, const PoseKnots& knots) {
  std::vector<Index> firsts(static_cast<std::size_t>(knots.count()));
  for (std::size_t k = 1; k < firsts.size(); ++k) firsts[k] = static_cast<Index>(k) - 1;
  for (const auto& [tag, of_tag] : problem.samples) {
    std::vector<Index> own;
    for (const auto& [antenna, series] : of_tag) {
      const auto chain = knots.chain_of.find(antenna);
      if (chain == knots.chain_of.end()) continue;
      for (const PhaseSample& sample : series) {
        const double time_s = to_seconds(sample.stamp);
        own.push_back(place_in(knots, knots.chains[chain->second], time_s).at);
      }
    }
    if (own.empty()) continue;
    const Index first = *std::min_element(own.begin(), own.end());
    for (const Index knot : own) {
      for (const auto k : {static_cast<std::size_t>(knot), static_cast<std::size_t>(knot) + 1}) {
        firsts[k] = std::min(firsts[k], first);
      }
    }
  }
  return work_of_factors(firsts) * std::pow(knots.size, 3.0);
}

/// Time between knots: finer if few tags make that cheap, and wider if reads of the same tags over
/// a long time make the knots' system large.
double knot_spacing(const LocalizationProblem& problem, std::size_t tags,
                    const PoseErrorModel& model) {
  constexpr Index kUnknownsOfTag = 4;
  const double fine = model.time_constant_s / kStateKnots;
  const std::vector<Period> periods = reading_periods(problem, model.time_constant_s);
  double duration = 0.0;
  for (const Period& period : periods) duration += period.end_s - period.begin_s;
  const auto unknowns =
      static_cast<Index>(2.0 * duration / fine) + 2 * static_cast<Index>(periods.size());
  const auto of_tags = static_cast<Index>(tags) * kUnknownsOfTag;
  if (eliminates_knots_first(unknowns, of_tags, 2.0 * kMaxWork)) return fine;
  // The envelope's work grows with the cube of the number of knots, so an estimate with wide
  // spacing suffices.
  const double wide = std::max(fine, duration / kKnotsToLook);
  const double work = work_of(problem, make_knots(problem, &model, wide));
  return std::max(fine, wide * std::cbrt(work / kMaxWork));
}

/// Covariances that come with the poses are used only if no model was given.
PoseKnots knots_of(const LocalizationProblem& problem, const PoseErrorModel& model,
                   double spacing_s) {
  const bool uses_covariances = !problem.pose_error && has_stated_covariances(problem);
  PoseKnots knots = make_knots(problem, uses_covariances ? nullptr : &model, spacing_s);
  knots.time_constant_s = model.time_constant_s;
  if (!problem.drift.empty()) take_drift(problem, knots);
  return knots;
}

JointTag joint_tag(const LocalizationProblem& problem, const std::string& tag,
                   UnwrappedFit unwrapped) {
  JointTag joint;
  joint.id = tag;
  joint.phases = std::move(unwrapped.phases);
  joint.height = unwrapped.height;
  joint.fit = unwrapped.fits.front();
  const auto known = problem.reference_tags.find(tag);
  if (known == problem.reference_tags.end()) return joint;
  joint.fixed = true;
  joint.height = {HeightModel::Kind::kKnown, known->second.z(), 1.0};
  joint.fit.unknowns = to_unknowns(joint.height, known->second);
  joint.fit.offsets = offsets_at(joint.phases, joint.height, joint.fit.unknowns);
  return joint;
}

/// Residuals of one tag at the current state [m], in the order of its reads.
Eigen::ArrayXd residuals_of(const JointSystem& system, const JointTag& tag) {
  Eigen::ArrayXd residuals(tag.phases.size());
  for (std::size_t s = 0; s < tag.phases.spans.size(); ++s) {
    const TagPhases::Span& span = tag.phases.spans[s];
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      residuals[i] = read_now(system, tag, s, i).error;
    }
  }
  return residuals;
}

/// Phase noise from differences of neighbouring residuals of all tags.
double noise_of_neighbours(const JointSystem& system) {
  constexpr std::size_t kFewest = 30;
  std::vector<double> all;
  for (const JointTag& tag : system.tags) {
    const auto of_tag = neighbour_differences(tag.phases, residuals_of(system, tag));
    all.insert(all.end(), of_tag.begin(), of_tag.end());
  }
  return all.size() < kFewest ? system.noise_rad : noise_of_differences(std::move(all));
}

/// Reduces the weight of tags with residuals far above the noise (reflections, a moving tag).
void weigh(JointSystem& system) {
  constexpr double kTolerated = 2.0;
  for (JointTag& tag : system.tags) {
    const auto unknowns = static_cast<double>(tag.phases.spans.size()) + 2.0;
    const auto reads = static_cast<double>(tag.phases.size());
    const double freedom = std::max(reads - unknowns, 0.5 * reads);
    const double excess = tag.fit.cost / (freedom * system.noise_rad * system.noise_rad);
    if (excess < kTolerated) {
      tag.weight = 1.0;
      continue;
    }
    const double correlation = correlation_factor(tag.phases.spans, residuals_of(system, tag));
    tag.weight = 1.0 / (excess * correlation);
  }
}

/// Fit of one tag as if the corrected poses were the believed ones.
UnwrappedFit fit_corrected(const JointState& state, std::size_t index) {
  const JointSystem& system = state.system;
  const SamplesOfTag corrected =
      corrected_samples(*state.problem, system.knots, system.u, *state.samples[index]);
  return fit_unwrapped(*state.problem, system.tags[index].id, corrected);
}

/// Wrapped fit with corrected poses, starting from the tag's current position.
JointTag wrapped_tag(const JointState& state, std::size_t index) {
  const JointSystem& system = state.system;
  const JointTag& tag = system.tags[index];
  std::vector<std::string> antennas;
  for (const TagPhases::Span& span : tag.phases.spans) antennas.push_back(span.antenna);
  JointTag wrapped = tag;
  wrapped.phases = wrapped_phases(*state.problem, *state.samples[index], antennas);
  attach(*state.problem, system.knots, wrapped);
  const SamplesOfTag corrected =
      corrected_samples(*state.problem, system.knots, system.u, *state.samples[index]);
  const TagPhases phases = wrapped_phases(*state.problem, corrected, antennas);
  if (tag.fixed) {
    wrapped.fit.offsets = offsets_at(phases, tag.height, tag.fit.unknowns);
  } else {
    wrapped.fit = fit_tag(phases, tag.height, tag.fit.unknowns);
  }
  wrapped.fit.cost =
      (tagfield::residuals_of(phases, tag.height, wrapped.fit) * phases.wavenumber).square().sum();
  return wrapped;
}

/// Whether whole cycles can be resolved: the wrapped phases fit about as well as the unwrapped
/// ones.
bool fits_as_well(const JointTag& wrapped, const JointTag& unwrapped) {
  constexpr double kWorse = 1.3;
  const auto reads = static_cast<double>(unwrapped.phases.size());
  const double freedom =
      std::max(reads - static_cast<double>(unwrapped.phases.spans.size()), 0.5 * reads);
  return wrapped.fit.cost / static_cast<double>(wrapped.phases.size()) <
         kWorse * unwrapped.fit.cost / freedom;
}

/// Initial state for a given number of tags, before any is added.
JointState without_tags(const LocalizationProblem& problem, std::size_t tags) {
  JointState state;
  state.problem = &problem;
  state.system.noise_rad = first_noise(problem);
  const PoseErrorModel model = model_of(problem);
  state.system.knots = knots_of(problem, model, knot_spacing(problem, tags, model));
  state.system.u = Eigen::VectorXd::Zero(state.system.knots.count() * state.system.knots.size);
  return state;
}

}  // namespace

double first_noise(const LocalizationProblem& problem) {
  std::vector<double> of_series;
  for (const auto& [tag, of_tag] : problem.samples) {
    for (const auto& [antenna, series] : of_tag) {
      const double noise = phase_noise(series);
      if (noise > 0.0) of_series.push_back(noise);
    }
  }
  const double usual = problem.pi_ambiguity ? 0.2 : 0.1;
  return of_series.empty() ? usual : std::max(median(std::move(of_series)), 1e-3);
}

JointState begin_jointly(const LocalizationProblem& problem, const std::set<std::string>& without,
                         int threads) {
  std::vector<const SamplesByTag::value_type*> tags;
  for (const auto& entry : problem.samples) {
    if (without.count(entry.first) == 0) tags.push_back(&entry);
  }
  std::vector<UnwrappedFit> fits(tags.size());
  parallel_for(tags.size(), threads, [&](std::size_t i) {
    fits[i] = fit_unwrapped(problem, tags[i]->first, tags[i]->second);
  });
  JointState state = without_tags(problem, tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const auto& [tag, samples] = *tags[i];
    if (!fits[i].why_not.empty()) {
      state.not_located[tag] = not_located(begun(tag, samples), fits[i].why_not);
      continue;
    }
    JointTag joint = joint_tag(problem, tag, std::move(fits[i]));
    attach(problem, state.system.knots, joint);
    state.system.tags.push_back(std::move(joint));
    state.samples.push_back(&samples);
  }
  state.alternatives.resize(state.system.tags.size());
  return state;
}

JointState begin_at(const LocalizationProblem& problem, const std::vector<PlacedTag>& placed) {
  JointState state = without_tags(problem, placed.size());
  for (const PlacedTag& tag : placed) {
    JointTag joint;
    joint.id = tag.id;
    joint.fixed = problem.reference_tags.count(tag.id) > 0;
    const TagPhases phases = coherent_reads(problem, *tag.samples);
    joint.height = joint.fixed ? HeightModel{HeightModel::Kind::kKnown, tag.p_WT.z(), 1.0}
                               : height_model(problem, tag.id, phases);
    joint.fit.unknowns = to_unknowns(joint.height, tag.p_WT);
    state.system.tags.push_back(std::move(joint));
    state.samples.push_back(tag.samples);
    take_samples(state, state.system.tags.size() - 1, *tag.samples);
  }
  state.alternatives.resize(state.system.tags.size());
  return state;
}

void take_samples(JointState& state, std::size_t index, const SamplesOfTag& samples) {
  const LocalizationProblem& problem = *state.problem;
  JointTag& tag = state.system.tags[index];
  state.samples[index] = &samples;
  tag.phases = coherent_reads(problem, samples);
  attach(problem, state.system.knots, tag);
  const TagPhases corrected = coherent_reads(
      problem, corrected_samples(problem, state.system.knots, state.system.u, samples));
  tag.fit.offsets = offsets_at(corrected, tag.height, tag.fit.unknowns);
}

void fit_unwrapped_jointly(JointState& state, int threads) {
  JointSystem& system = state.system;
  minimize(system, kMaxRoundsOfJointFit, threads);
  system.noise_rad = noise_of_neighbours(system);
  weigh(system);
  minimize(system, kMaxRoundsOfJointFit, threads);
}

void for_each_corrected_fit(const JointState& state, int threads,
                            const std::function<void(std::size_t, const UnwrappedFit&)>& use) {
  parallel_for(state.system.tags.size(), threads, [&](std::size_t i) {
    if (!state.system.tags[i].fixed) use(i, fit_corrected(state, i));
  });
}

bool go_on_from(JointState& state, const BestFits& best, double better, int threads) {
  constexpr double kMoved = 0.03;  // [m]
  bool any = false;
  for (std::size_t i = 0; i < best.size(); ++i) {
    JointTag& tag = state.system.tags[i];
    if (!best[i]) continue;
    const bool elsewhere = (best[i]->unknowns - tag.fit.unknowns).head<2>().norm() > kMoved;
    if (!elsewhere || best[i]->cost > better * tag.fit.cost) continue;
    tag.fit.unknowns = best[i]->unknowns;
    if (tag.phases.unwrapped) {
      tag.fit.offsets = offsets_at(tag.phases, tag.height, best[i]->unknowns);
    } else {
      // Wrapped phases converge to a position only from nearby, with offsets of the corrected
      // poses.
      tag = wrapped_tag(state, i);
    }
    any = true;
  }
  if (!any) return false;
  weigh(state.system);
  minimize(state.system, kMaxRoundsOfJointFit, threads);
  return true;
}

void find_better_positions(JointState& state, int threads) {
  constexpr int kMaxRounds = 3;
  constexpr double kBetter = 0.85;
  for (int round = 0; round < kMaxRounds; ++round) {
    BestFits best(state.system.tags.size());
    for_each_corrected_fit(state, threads, [&](std::size_t i, const UnwrappedFit& fit) {
      if (!fit.fits.empty()) best[i] = fit.fits.front();
    });
    if (!go_on_from(state, best, kBetter, threads)) return;
  }
}

void fit_wrapped_jointly(JointState& state, int threads) {
  JointSystem& system = state.system;
  cost_of(system);
  parallel_for(system.tags.size(), threads, [&](std::size_t i) {
    JointTag wrapped = wrapped_tag(state, i);
    if (fits_as_well(wrapped, system.tags[i])) system.tags[i] = std::move(wrapped);
  });
  minimize(system, kMaxRoundsOfJointFit, threads);
  system.noise_rad = noise_of_neighbours(system);
  weigh(system);
  minimize(system, kMaxRoundsOfJointFit, threads);
}

namespace {

/// Ratio of a tag's squared error by its residuals, including that those near in time are alike, to
/// that by the noise that its covariance was computed with; at least 1.
double left_over(const JointSystem& system, const JointTag& tag, const Eigen::ArrayXd& residuals) {
  const double noise_m2 =
      system.noise_rad * system.noise_rad / tag.phases.wavenumber.square().mean();
  const double variance = residual_variance(tag.phases.spans, residuals) *
                          correlation_factor(tag.phases.spans, residuals);
  const double away = fitted_away(tag.phases.spans, residuals);
  return std::max(1.0, away * away * tag.weight * variance / noise_m2);
}

}  // namespace

Candidate candidate_of(const JointSystem& system, std::size_t tag,
                       const Eigen::Matrix3d& covariance) {
  const JointTag& at = system.tags[tag];
  const Eigen::ArrayXd residuals = residuals_of(system, at);
  const double rms_m = std::sqrt(residuals.square().mean());
  return make_candidate(at.height, at.fit.unknowns, left_over(system, at, residuals) * covariance,
                        rms_m);
}

}  // namespace tagfield
