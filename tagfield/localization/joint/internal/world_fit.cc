// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/world_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/joint/internal/joint_equations.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

/// Search radius around the starts of tags that don't fit [standard deviations].
constexpr double kFurther = 5.0;
/// Minimum decrease of a cost for which a tag moves elsewhere.
constexpr double kClearly = 6.0;

Sight sight_of(const JointState& state, const SamplesOfTag& samples) {
  return {samples, corrected_samples(*state.problem, state.system.knots, state.system.u, samples)};
}

/// Slopes per phase of the tag that the samples belong to; an antenna reads a tag at most once at a
/// time.
BendSlopes slopes_of(const JointState& state, const JointTag& tag, const Straightened& straight) {
  std::map<std::pair<std::string, double>, const Bend*> bends;
  for (const auto& [antenna, series] : straight.samples) {
    const std::vector<Bend>& of_antenna = straight.bends.at(antenna);
    for (std::size_t i = 0; i < series.size(); ++i) {
      bends[{antenna, to_seconds(series[i].stamp)}] = &of_antenna[i];
    }
  }
  BendSlopes slopes;
  slopes.p_WT = to_position(tag.height, tag.fit.unknowns);
  slopes.moved.resize(2, tag.phases.size());
  slopes.by_place.resize(3, tag.phases.size());
  slopes.by_antenna.resize(3, tag.phases.size());
  for (const TagPhases::Span& span : tag.phases.spans) {
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const Bend& bend = *bends.at({span.antenna, tag.phases.time_s[i]});
      slopes.moved.col(i) = displacement_at(state.system, tag, i);
      slopes.by_place.col(i) = bend.by_place;
      slopes.by_antenna.col(i) = bend.by_antenna;
    }
  }
  return slopes;
}

/// Removes the bends at the current state.
void straighten_all(WorldFit& fit, const MultipathOptions& options, int threads) {
  JointState& state = fit.state;
  const LocalizationProblem& problem = *state.problem;
  std::vector<Straightened> next(fit.given.size());
  parallel_for(fit.given.size(), threads, [&](std::size_t i) {
    const JointTag& tag = state.system.tags[i];
    const Sight sight = sight_of(state, *fit.given[i]);
    const Vector3d p = to_position(tag.height, tag.fit.unknowns);
    next[i] = straightened(problem, sight, traced(problem, tag.id, sight.corrected, p), p,
                           options.min_directness, state.system.noise_rad);
  });
  fit.straight = std::move(next);
  for (std::size_t i = 0; i < fit.straight.size(); ++i) {
    take_samples(state, i, fit.straight[i].samples);
    JointTag& tag = state.system.tags[i];
    tag.slopes = slopes_of(state, tag, fit.straight[i]);
  }
}

std::vector<Vector3d> places_of(const JointState& state) {
  std::vector<Vector3d> places;
  places.reserve(state.system.tags.size());
  for (const JointTag& tag : state.system.tags) {
    places.push_back(to_position(tag.height, tag.fit.unknowns));
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

/// Coherent share at the tag's position with the corrected poses and the bends removed.
double share_at(const JointState& state, std::size_t index) {
  const JointTag& tag = state.system.tags[index];
  const TagPhases phases =
      coherent_reads(*state.problem, sight_of(state, *state.samples[index]).corrected);
  return coherent_share(phases, tag.height, tag.fit.unknowns);
}

/// Lower shares mean a wrong position or a wrong world: noise alone leaves e^(−σ²/2).
double min_share(const JointState& state) {
  constexpr double kOfNoiseAlone = 0.85;
  return kOfNoiseAlone * std::exp(-0.5 * state.system.noise_rad * state.system.noise_rad);
}

double fit_weight(const JointState& state, std::size_t index) {
  const bool adds_up = share_at(state, index) >= min_share(state);
  return adds_up ? state.system.tags[index].weight : 0.0;
}

bool any_fits(const std::vector<double>& weights) {
  return std::any_of(weights.begin(), weights.end(), fits_somewhat);
}

/// Search radius around the starts of a tag that does not fit.
enum class Reach { kFurther, kAnywhere };

TracedSearch search_for(const JointState& state, const Sight& sight,
                        const MultipathOptions& options) {
  return {*state.problem, sight, options.min_directness, state.system.noise_rad};
}

Fit fit_of(const WorldFit& fit, const MultipathOptions& options, std::size_t index) {
  const JointState& state = fit.state;
  const JointTag& tag = state.system.tags[index];
  const Sight sight = sight_of(state, *fit.given[index]);
  return fit_at(search_for(state, sight, options), tag.id,
                to_position(tag.height, tag.fit.unknowns));
}

/// Searches again for tags that do not fit, now that others determine the pose error.
void find_lost(WorldFit& fit, const MultipathOptions& options, Reach reach, int threads) {
  JointState& state = fit.state;
  parallel_for(fit.given.size(), threads, [&](std::size_t i) {
    JointTag& tag = state.system.tags[i];
    if (tag.fixed || fits_somewhat(fit_weight(state, i))) return;
    const Sight sight = sight_of(state, *fit.given[i]);
    const TracedSearch search = search_for(state, sight, options);
    const Vector3d there =
        reach == Reach::kFurther
            ? likeliest_position(search, fit.starts[i], kFurther)
            : likeliest_anywhere(search, tag.id, fit.starts[i].candidates.front().p_WT);
    tag.fit.unknowns = to_unknowns(tag.height, there);
    fit.looked_about[i] = 0;
  });
}

/// A step of the joint fit can cross a ridge of a likelihood with many peaks, and a search can end
/// on a lesser peak: each tag with more than noise left moves to the best position near its
/// previous and current ones, if clearly better. Late in the fit, a wider neighbourhood is searched
/// once.
void climb_all(WorldFit& fit, const std::vector<Vector3d>& before, const MultipathOptions& options,
               bool is_late, int threads) {
  constexpr double kAbout = 0.3;  // [m]
  constexpr double kFar = 0.01;   // [m]
  JointState& state = fit.state;
  parallel_for(fit.given.size(), threads, [&](std::size_t i) {
    JointTag& tag = state.system.tags[i];
    if (tag.fixed) return;
    const Sight sight = sight_of(state, *fit.given[i]);
    const TracedSearch search = search_for(state, sight, options);
    const Vector3d now = to_position(tag.height, tag.fit.unknowns);
    const Fit here = fit_at(search, tag.id, now);
    if (is_settled(here)) return;
    std::vector<Vector3d> places{now};
    if ((before[i] - now).norm() > kFar) places.push_back(before[i]);
    if (is_late && fit.looked_about[i] == 0 && fits_somewhat(fit_weight(state, i))) {
      fit.looked_about[i] = 1;
      for (const LikelyPosition& about : likeliest_about(search, tag.id, now, kAbout).places) {
        places.push_back(about.p_WT);
      }
    }
    double best = here.cost - kClearly;
    for (const Vector3d& place : places) {
      const Vector3d there = climbed(search, tag.id, place).p_WT;
      const double cost = fit_at(search, tag.id, there).cost;
      if (cost >= best) continue;
      best = cost;
      tag.fit.unknowns = to_unknowns(tag.height, there);
    }
  });
}

/// Positions of the tags in the last round.
struct LastRound {
  std::vector<Vector3d> straightened;  ///< Where the bends were removed,
  std::vector<Vector3d> fitted;        ///< and where the joint fit ended.
};

/// Removes the bends, fits jointly, and moves tags to clearly likelier positions.
LastRound fit_once(WorldFit& fit, const MultipathOptions& options, bool is_late, int threads) {
  LastRound last;
  last.straightened = places_of(fit.state);
  straighten_all(fit, options, threads);
  fit_unwrapped_jointly(fit.state, threads);
  last.fitted = places_of(fit.state);
  climb_all(fit, last.straightened, options, is_late, threads);
  return last;
}

bool has_settled(const JointState& state, const LastRound& last) {
  constexpr double kSettled = 3e-4;  // [m]
  return farthest_move(last.straightened, places_of(state)) < kSettled;
}

/// What a trial may change in a fit.
struct Solution {
  std::vector<PositionVector> unknowns;
  std::vector<double> weights;
  Eigen::VectorXd u;
  double noise_rad = 0.0;
  LastRound last;
};

Solution solution_of(const JointState& state, const LastRound& last) {
  Solution solution{{}, {}, state.system.u, state.system.noise_rad, last};
  for (const JointTag& tag : state.system.tags) {
    solution.unknowns.push_back(tag.fit.unknowns);
    solution.weights.push_back(tag.weight);
  }
  return solution;
}

/// Afterwards, the bends, slopes and offsets belong to the solution's positions.
void return_to(const Solution& solution, WorldFit& fit, const MultipathOptions& options,
               int threads) {
  JointSystem& system = fit.state.system;
  for (std::size_t i = 0; i < system.tags.size(); ++i) {
    system.tags[i].fit.unknowns = solution.unknowns[i];
    system.tags[i].weight = solution.weights[i];
  }
  system.u = solution.u;
  system.noise_rad = solution.noise_rad;
  straighten_all(fit, options, threads);
}

/// −2 ln of the likelihood of all reads and of the pose error, up to a constant, for comparison at
/// equal noise.
double cost_at(WorldFit& fit, const MultipathOptions& options, double noise_rad, int threads) {
  JointSystem& system = fit.state.system;
  const double own_noise_rad = std::exchange(system.noise_rad, noise_rad);
  double cost = prior_cost(system);
  for (const Fit& of_tag : fits_of(fit, options, threads)) cost += of_tag.cost;
  system.noise_rad = own_noise_rad;
  return cost;
}

/// The tags most likely to be at a wrong position, worst first: those with more than noise left,
/// and if the pose error and the reads together cost more than noise would, the others too.
std::vector<std::size_t> doubtful_tags(WorldFit& fit, const MultipathOptions& options,
                                       int threads) {
  constexpr std::size_t kMost = 8;
  constexpr double kMoreThanNoise = 1.1;
  JointSystem& system = fit.state.system;
  const double cost = cost_of(system);
  double reads = 0.0;
  for (const JointTag& tag : system.tags) reads += static_cast<double>(tag.phases.size());
  const std::vector<Fit> fits = fits_of(fit, options, threads);
  std::vector<std::pair<double, std::size_t>> doubtful;
  for (std::size_t i = 0; i < system.tags.size(); ++i) {
    const JointTag& tag = system.tags[i];
    const bool is_doubtful = cost > kMoreThanNoise * reads || !is_settled(fits[i]);
    const double share = tag.fit.cost / std::max(static_cast<double>(tag.phases.size()), 1.0);
    if (!tag.fixed && is_doubtful) doubtful.emplace_back(-share, i);
  }
  std::sort(doubtful.begin(), doubtful.end());
  std::vector<std::size_t> numbers;
  for (const auto& [share, i] : doubtful) {
    if (numbers.size() < kMost) numbers.push_back(i);
  }
  return numbers;
}

/// Moves the tag to its likeliest position with the pose error that the other tags determine.
void place_by_others(WorldFit& fit, const MultipathOptions& options, std::size_t index,
                     int threads) {
  constexpr double kNothing = 1e-6;
  JointState& state = fit.state;
  JointTag& tag = state.system.tags[index];
  tag.weight = kNothing;
  minimize(state.system, kMaxRoundsOfJointFit, threads);
  const Sight sight = sight_of(state, *fit.given[index]);
  const Vector3d there =
      likeliest_position(search_for(state, sight, options), fit.starts[index], kFurther);
  tag.fit.unknowns = to_unknowns(tag.height, there);
  tag.weight = 1.0;
}

/// A tag at a wrong position and a pose error that is bent to suit it can explain each other so
/// well that no step leads away from them: doubtful tags are placed anew by the pose error of the
/// others, where all reads then cost clearly less.
void place_doubtful_anew(WorldFit& fit, const MultipathOptions& options, LastRound& last,
                         int threads) {
  constexpr int kRounds = 4;
  if (fit.given.size() < 2) return;
  for (const std::size_t index : doubtful_tags(fit, options, threads)) {
    const Solution before = solution_of(fit.state, last);
    const double cost = cost_at(fit, options, before.noise_rad, threads);
    place_by_others(fit, options, index, threads);
    for (int round = 0; round < kRounds; ++round) {
      last = fit_once(fit, options, false, threads);
      if (has_settled(fit.state, last)) break;
    }
    if (cost_at(fit, options, before.noise_rad, threads) < cost - kClearly) continue;
    return_to(before, fit, options, threads);
    last = before.last;
  }
}

/// Updates the bends, slopes and offsets of all tags, which belong to where they were before the
/// last fit, and the weights of those that have moved since to where only noise remains.
void come_to_rest(WorldFit& fit, const std::vector<Vector3d>& fitted,
                  const MultipathOptions& options, int threads) {
  JointState& state = fit.state;
  const std::vector<Vector3d> places = places_of(state);
  straighten_all(fit, options, threads);
  parallel_for(places.size(), threads, [&](std::size_t i) {
    JointTag& tag = state.system.tags[i];
    if (tag.fixed || places[i] == fitted[i]) return;
    if (is_settled(fit_of(fit, options, i))) tag.weight = 1.0;
  });
}

}  // namespace

void fit_through_world(WorldFit& fit, const MultipathOptions& options, int threads) {
  JointState& state = fit.state;
  LastRound last{places_of(state), places_of(state)};
  for (int round = 0; round < options.rounds; ++round) {
    tell(*state.problem, "the known world", static_cast<double>(round) / options.rounds);
    last = fit_once(fit, options, round > 2, threads);
    if (round == 1 && is_pose_error_unknown(*state.problem)) learn_pose_error(state, threads);
    if (round == 2) {
      // No tag's reads fit this world: it is a different one, or the reads are not what they seem.
      if (!any_fits(fit_weights(state, threads))) break;
      find_lost(fit, options, Reach::kFurther, threads);
    } else if (round == 4 && is_right_world(fit_weights(state, threads))) {
      find_lost(fit, options, Reach::kAnywhere, threads);
    } else if (round > 1 && has_settled(state, last)) {
      break;
    }
  }
  if (is_right_world(fit_weights(state, threads))) {
    place_doubtful_anew(fit, options, last, threads);
  }
  come_to_rest(fit, last.fitted, options, threads);
}

std::vector<double> fit_weights(const JointState& state, int threads) {
  std::vector<double> weights(state.system.tags.size());
  parallel_for(weights.size(), threads, [&](std::size_t i) { weights[i] = fit_weight(state, i); });
  return weights;
}

bool is_right_world(const std::vector<double>& weights) {
  constexpr double kFitsWell = 0.2;
  const auto fitting = std::count_if(weights.begin(), weights.end(),
                                     [](double weight) { return weight >= kFitsWell; });
  return 2 * static_cast<std::size_t>(fitting) >= weights.size();
}

bool fits_somewhat(double weight) {
  constexpr double kLeast = 0.1;
  return weight >= kLeast;
}

std::vector<Fit> fits_of(const WorldFit& fit, const MultipathOptions& options, int threads) {
  std::vector<Fit> of_tags(fit.given.size());
  parallel_for(of_tags.size(), threads,
               [&](std::size_t i) { of_tags[i] = fit_of(fit, options, i); });
  return of_tags;
}

}  // namespace tagfield
