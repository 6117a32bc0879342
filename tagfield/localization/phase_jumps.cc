// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_jumps.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "tagfield/base/median.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/circle_density.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/phase_curves/phase_following.h"
#include "tagfield/localization/phase_noise.h"

namespace tagfield {
namespace {

/// Standard deviations are at least twice the spacing of the bins, so that sums stand for
/// integrals: 0.1 rad, 1.4 mm of distance.
constexpr double kLeastSigma = 2.0 * kTwoPi / static_cast<double>(kCircleBins);
/// Of what tags share; steps of a random walk over the whole circle would be 1.8 rad.
constexpr double kSharedSigmas[] = {0.05, 0.1, 0.2, 0.4, 0.8};
constexpr std::size_t kSharedCount = std::size(kSharedSigmas);
/// Two tags could have been moved together, or both be outliers.
constexpr std::size_t kFewestJumped = 3;
constexpr double kJumpFalseAlarms = 1e-4;  ///< Per survey.
constexpr std::size_t kMostJumps = 20;
constexpr double kHardly = 1e-300;  ///< Instead of 0, where the exponential function is.

/// The two ways in which a change is expected.
enum Way : std::size_t { kByPoses, kByNeighbours, kWays };

/// Change of a tag's phase from one of an antenna's stamps to another, by their numbers.
struct Change {
  std::uint32_t tag = 0;
  std::uint32_t from = 0, to = 0;
  PhaseDifference by[kWays];
};

/// The reads of one antenna.
struct AntennaChanges {
  std::string antenna;
  std::vector<Time> stamps;  ///< Ascending; interval i is from stamp i to i + 1.
  std::vector<Change> changes;
};

/// Evidence for a jump in each interval. There are as many as reads: single precision suffices.
struct Evidence {
  std::vector<float> log_factor;  ///< ln B; 0 if no tag tells.
  std::vector<std::uint32_t> tags;
  std::vector<float> step_rad;
};

double density_at(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(kTwoPi));
}

OnCircle angles() {
  return OnCircle::LinSpaced(0.0, static_cast<double>(kCircleBins - 1)) * (kTwoPi / kCircleBins);
}

/// Probability that a difference is arbitrary if a share of all are.
double is_arbitrary(const PhaseDifference& of, double share) {
  const double any = share / kTwoPi;
  return any / (any + (1.0 - share) * density_at(of.rad, of.sigma));
}

/// The share of arbitrary ones among the differences from `begin` to `end`, of which a share is
/// expected as if it had been that of two more.
double arbitrary_share(const std::vector<Change>& changes, std::size_t begin, std::size_t end,
                       Way way, double share, double expected) {
  double sum = 2.0 * expected;
  for (std::size_t i = begin; i < end; ++i) sum += is_arbitrary(changes[i].by[way], share);
  return sum / (static_cast<double>(end - begin) + 2.0);
}

/// Sets the share of arbitrary differences: by expectation and maximization, of all tags, and then
/// of each, which may be amid reflections. As if one of two more had been arbitrary (Laplace's rule
/// of succession). `begins`: of each tag's changes, and their end.
void set_arbitrary(const std::vector<std::size_t>& begins, Way way, std::vector<Change>& changes) {
  constexpr int kRounds = 20;
  double of_all = 0.5;
  for (int round = 0; round < kRounds; ++round) {
    of_all = arbitrary_share(changes, 0, changes.size(), way, of_all, 0.5);
  }
  for (std::size_t tag = 0; tag + 1 < begins.size(); ++tag) {
    const double share =
        arbitrary_share(changes, begins[tag], begins[tag + 1], way, of_all, of_all);
    for (std::size_t i = begins[tag]; i < begins[tag + 1]; ++i) {
      changes[i].by[way].arbitrary = static_cast<float>(share);
    }
  }
}

/// What the changes before and after a step lead to expect of it, if rates are the same over each
/// whole step.
struct ByNeighbours {
  double off_rad = 0.0;
  double slack_rad = 0.0;  ///< How much a change of the rate during the step may account for.
  double noise = 0.0;      ///< Standard deviation relative to that of a phase.
};

ByNeighbours by_neighbours(const std::vector<PhaseSample>& samples, const FollowedStep& step) {
  const auto seconds = [&](std::size_t from) {
    return to_seconds(samples[from + 1].stamp) - to_seconds(samples[from].stamp);
  };
  const double duration = seconds(step.from);
  const double before = duration / seconds(step.from - 1);
  const double after = duration / seconds(step.from + 1);
  ByNeighbours of;
  of.off_rad =
      wrap_to_pi(step.change_rad - 0.5 * (before * step.before_rad + after * step.after_rad));
  of.slack_rad = 0.5 * std::abs(after * step.after_rad - before * step.before_rad);
  // From the coefficients of the four phases.
  of.noise = std::sqrt(0.25 * before * before + (1.0 + 0.5 * before) * (1.0 + 0.5 * before) +
                       (1.0 + 0.5 * after) * (1.0 + 0.5 * after) + 0.25 * after * after);
  return of;
}

/// `value` nearer to 0 by `slack`.
double without_slack(double value, double slack) {
  return std::copysign(std::max(std::abs(value) - slack, 0.0), value);
}

std::uint32_t place_of(const std::vector<Time>& stamps, Time stamp) {
  return static_cast<std::uint32_t>(std::lower_bound(stamps.begin(), stamps.end(), stamp) -
                                    stamps.begin());
}

/// Phase noise by what neighbours lead to expect [rad].
double noise_by_neighbours(const std::vector<ByNeighbours>& all) {
  std::vector<double> deviations;
  deviations.reserve(all.size());
  for (const ByNeighbours& one : all) deviations.push_back(one.off_rad / one.noise);
  return sigma_by_median(std::move(deviations));
}

/// Adds a tag's changes.
void add_changes(const std::vector<PhaseSample>& series, std::uint32_t tag, AntennaChanges& to) {
  const std::vector<PhaseSample> samples = by_channel(series);
  const std::vector<FollowedStep> steps = followed_steps(samples, phase_noise(samples));
  std::vector<ByNeighbours> neighbours;
  neighbours.reserve(steps.size());
  for (const FollowedStep& step : steps) neighbours.push_back(by_neighbours(samples, step));
  const double noise = noise_by_neighbours(neighbours);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const ByNeighbours& of = neighbours[i];
    Change change;
    change.tag = tag;
    change.from = place_of(to.stamps, samples[steps[i].from].stamp);
    change.to = place_of(to.stamps, samples[steps[i].from + 1].stamp);
    change.by[kByPoses] = {static_cast<float>(steps[i].off_rad),
                           static_cast<float>(std::max(steps[i].sigma_rad, kLeastSigma))};
    change.by[kByNeighbours] = {static_cast<float>(without_slack(of.off_rad, of.slack_rad)),
                                static_cast<float>(std::max(noise * of.noise, kLeastSigma))};
    to.changes.push_back(change);
  }
}

std::vector<Time> all_stamps_of(const SamplesByTag& samples, const std::string& antenna) {
  std::vector<Time> stamps;
  for (const auto& [tag, of_tag] : samples) {
    const auto series = of_tag.find(antenna);
    if (series == of_tag.end()) continue;
    for (const PhaseSample& sample : series->second) stamps.push_back(sample.stamp);
  }
  std::sort(stamps.begin(), stamps.end());
  stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
  return stamps;
}

AntennaChanges changes_of(const SamplesByTag& samples, const std::string& antenna) {
  AntennaChanges of;
  of.antenna = antenna;
  of.stamps = all_stamps_of(samples, antenna);
  std::uint32_t number = 0;
  std::vector<std::size_t> begins = {0};
  for (const auto& [tag, of_tag] : samples) {
    const auto series = of_tag.find(antenna);
    if (series != of_tag.end() && extent_of(series->second) >= kStillExtent) {
      add_changes(series->second, number, of);
      begins.push_back(of.changes.size());
    }
    ++number;
  }
  for (const Way way : {kByPoses, kByNeighbours}) set_arbitrary(begins, way, of.changes);
  return of;
}

/// Sum of ln f over the tags with changes across an interval. A tag with several, on several
/// channels, counts once, by their mean: it may have moved.
class Sum {
 public:
  void add(std::uint32_t tag, const OnCircle& values) {
    OfTag& of = tags_.try_emplace(tag).first->second;
    if (of.count > 0) all_ -= of.mean();
    of.sum += values;
    ++of.count;
    all_ += of.mean();
  }

  /// `values` returns what was added.
  template <class Values>
  void take(std::uint32_t tag, const Values& values) {
    const auto found = tags_.find(tag);
    OfTag& of = found->second;
    all_ -= of.mean();
    --of.count;
    if (of.count == 0) {
      tags_.erase(found);
    } else {
      of.sum -= values();
      all_ += of.mean();
    }
    if (tags_.empty()) all_.setZero();
  }

  [[nodiscard]] const OnCircle& all() const { return all_; }
  [[nodiscard]] std::size_t tags() const { return tags_.size(); }

 private:
  struct OfTag {
    OnCircle sum = OnCircle::Zero();
    int count = 0;
    [[nodiscard]] OnCircle mean() const { return sum / static_cast<double>(count); }
  };
  std::map<std::uint32_t, OfTag> tags_;
  OnCircle all_ = OnCircle::Zero();
};

/// Numbers of changes in the order in which they begin, and in which they end.
std::vector<std::size_t> in_order(const std::vector<Change>& changes, std::uint32_t Change::*key) {
  std::vector<std::size_t> order(changes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return changes[a].*key < changes[b].*key; });
  return order;
}

/// Weights of δ for what tags share, normalized.
OnCircle weights_of(double sigma, const OnCircle& angles) {
  OnCircle off = angles;
  off -= kTwoPi * (off / kTwoPi).round();
  const OnCircle weights = (-0.5 * (off / sigma).square()).exp();
  return weights / weights.sum();
}

/// ln of the likelihoods of an interval's differences, but for a common factor.
struct Likelihoods {
  float jump = 0.0f;
  float none[kSharedCount] = {};
};

/// Evidence by one way.
class Search {
 public:
  explicit Search(Way way)
      : way_(way), angles_(angles()), sines_(angles_.sin()), cosines_(angles_.cos()) {
    for (std::size_t k = 0; k < kSharedCount; ++k) {
      weights_[k] = weights_of(kSharedSigmas[k], angles_);
    }
  }

  Evidence operator()(const AntennaChanges& of) {
    const std::size_t intervals = of.stamps.empty() ? 0 : of.stamps.size() - 1;
    Evidence evidence;
    evidence.log_factor.assign(intervals, 0.0f);
    evidence.tags.assign(intervals, 0);
    evidence.step_rad.assign(intervals, 0.0f);
    std::vector<Likelihoods> all(intervals);
    sweep(of.changes, [&](std::size_t interval, const Sum& sum) {
      evidence.tags[interval] = static_cast<std::uint32_t>(sum.tags());
      const OnCircle likelihood = (sum.all() - sum.all().maxCoeff()).exp();
      all[interval] = likelihoods_of(likelihood);
      evidence.step_rad[interval] = mean_angle(likelihood);
    });
    const std::size_t shared = likeliest(all);
    for (std::size_t i = 0; i < intervals; ++i) {
      if (evidence.tags[i] > 0) evidence.log_factor[i] = all[i].jump - all[i].none[shared];
    }
    return evidence;
  }

 private:
  /// Calls `take` for each interval that a change spans.
  template <class Take>
  void sweep(const std::vector<Change>& changes, const Take& take) const {
    const std::vector<std::size_t> begins = in_order(changes, &Change::from);
    const std::vector<std::size_t> ends = in_order(changes, &Change::to);
    Sum sum;
    std::size_t begun = 0;
    std::size_t ended = 0;
    while (ended < ends.size()) {
      const std::uint32_t next =
          begun < begins.size() ? changes[begins[begun]].from : changes[ends[ended]].to;
      std::uint32_t now = std::min(next, changes[ends[ended]].to);
      for (; ended < ends.size() && changes[ends[ended]].to == now; ++ended) {
        const Change& change = changes[ends[ended]];
        sum.take(change.tag, [&] { return values_of(change); });
      }
      for (; begun < begins.size() && changes[begins[begun]].from == now; ++begun) {
        const Change& change = changes[begins[begun]];
        sum.add(change.tag, values_of(change));
      }
      if (ended == ends.size()) break;
      std::uint32_t until = changes[ends[ended]].to;
      if (begun < begins.size()) until = std::min(until, changes[begins[begun]].from);
      for (; now < until && sum.tags() > 0; ++now) take(now, sum);
    }
  }

  [[nodiscard]] OnCircle values_of(const Change& change) const {
    return log_density(change.by[way_]);
  }

  /// Of an interval with this likelihood of δ.
  [[nodiscard]] Likelihoods likelihoods_of(const OnCircle& likelihood) const {
    Likelihoods of;
    of.jump = static_cast<float>(std::log(likelihood.mean()));
    for (std::size_t k = 0; k < kSharedCount; ++k) {
      const double none = (likelihood * weights_[k]).sum();
      of.none[k] = static_cast<float>(std::log(none + kHardly));
    }
    return of;
  }

  [[nodiscard]] float mean_angle(const OnCircle& likelihood) const {
    const double angle = std::atan2((likelihood * sines_).sum(), (likelihood * cosines_).sum());
    return static_cast<float>(wrap_to_pi(angle));
  }

  /// Number of the standard deviation of what tags share that makes all differences most likely.
  static std::size_t likeliest(const std::vector<Likelihoods>& all) {
    double sums[kSharedCount] = {};
    for (const Likelihoods& of : all) {
      for (std::size_t k = 0; k < kSharedCount; ++k) sums[k] += static_cast<double>(of.none[k]);
    }
    return static_cast<std::size_t>(std::max_element(std::begin(sums), std::end(sums)) -
                                    std::begin(sums));
  }

  Way way_;
  OnCircle angles_;
  OnCircle sines_, cosines_;
  OnCircle weights_[kSharedCount];
};

/// Makes evidence by poses 0 at most where neighbours don't support it clearly.
void confirm(const AntennaChanges& of, Evidence& evidence) {
  const Evidence by_neighbours = Search(kByNeighbours)(of);
  for (std::size_t i = 0; i < evidence.log_factor.size(); ++i) {
    float& factor = evidence.log_factor[i];
    if (by_neighbours.log_factor[i] < kMinLogEvidence) factor = std::min(factor, 0.0f);
  }
}

bool enough_tags(const Evidence& evidence, std::size_t interval) {
  return evidence.tags[interval] >= kFewestJumped;
}

std::size_t count_intervals(const std::vector<Evidence>& all) {
  std::size_t count = 0;
  for (const Evidence& evidence : all) {
    for (std::size_t i = 0; i < evidence.tags.size(); ++i) count += enough_tags(evidence, i);
  }
  return count;
}

/// The interval with the strongest evidence; nullopt if it is not over `least`.
std::optional<std::size_t> strongest(const Evidence& evidence, double least) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < evidence.tags.size(); ++i) {
    if (!enough_tags(evidence, i) || !(evidence.log_factor[i] > least)) continue;
    least = evidence.log_factor[i];
    best = i;
  }
  return best;
}

/// Takes out the changes across an interval.
void take_across(std::size_t interval, std::vector<Change>& changes) {
  changes.erase(std::remove_if(changes.begin(), changes.end(),
                               [&](const Change& change) {
                                 return change.from <= interval && interval < change.to;
                               }),
                changes.end());
}

/// Jumps that an antenna's own phases show.
std::vector<PhaseJump> own_jumps(AntennaChanges of, Evidence evidence, double least) {
  std::vector<PhaseJump> jumps;
  while (jumps.size() < kMostJumps) {
    const auto interval = strongest(evidence, least);
    if (!interval) break;
    jumps.push_back(
        {of.antenna, of.stamps[*interval], of.stamps[*interval + 1], evidence.step_rad[*interval]});
    take_across(*interval, of.changes);
    evidence = Search(kByPoses)(of);
    confirm(of, evidence);
  }
  return jumps;
}

/// The same jump of another antenna; nullopt if its phases speak against it, or if it has no reads
/// on one side.
std::optional<PhaseJump> shared_jump(const PhaseJump& jump, const AntennaChanges& of,
                                     const Evidence& evidence) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i + 1 < of.stamps.size(); ++i) {
    if (of.stamps[i] >= jump.first_after || of.stamps[i + 1] <= jump.last_before) continue;
    if (!best || evidence.log_factor[i] > evidence.log_factor[*best]) best = i;
  }
  if (!best || evidence.log_factor[*best] < 0.0) return std::nullopt;
  PhaseJump shared{of.antenna, of.stamps[*best], of.stamps[*best + 1], std::nullopt};
  if (evidence.tags[*best] > 0) shared.step_rad = evidence.step_rad[*best];
  return shared;
}

bool overlap(const PhaseJump& one, const PhaseJump& other) {
  return one.last_before < other.first_after && other.last_before < one.first_after;
}

/// Adds those of other antennas.
void add_shared_jumps(const std::vector<AntennaChanges>& all, const std::vector<Evidence>& evidence,
                      std::vector<PhaseJump>& jumps) {
  const std::vector<PhaseJump> own = jumps;
  for (const PhaseJump& jump : own) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool has_one = std::any_of(jumps.begin(), jumps.end(), [&](const PhaseJump& other) {
        return other.antenna == all[i].antenna && overlap(jump, other);
      });
      if (has_one) continue;
      if (auto shared = shared_jump(jump, all[i], evidence[i])) jumps.push_back(*shared);
    }
  }
}

/// Antennas that moved while they read some tag.
std::set<std::string> moved_antennas(const SamplesByTag& samples) {
  std::set<std::string> antennas;
  for (const auto& [tag, of_tag] : samples) {
    for (const auto& [antenna, series] : of_tag) {
      if (extent_of(series) >= kStillExtent) antennas.insert(antenna);
    }
  }
  return antennas;
}

std::string text_of(const PhaseJump& jump, double multiple, bool had_known_offset) {
  const std::string step = jump.step_rad
                               ? fmt::format(" by {:.2f} rad{}", *jump.step_rad / multiple,
                                             multiple > 1.0 ? " (or π more)" : "")
                               : "";
  return fmt::format(
      "the phase offset of antenna '{}' jumps{} at {:.2f} s, as when a reader restarts: reads "
      "before and after it have offsets of their own{}",
      jump.antenna, step, to_seconds(jump.first_after),
      had_known_offset ? ", and its known offset is not used" : "");
}

}  // namespace

std::vector<PhaseJump> find_phase_jumps(const SamplesByTag& samples) {
  std::vector<AntennaChanges> all;
  std::vector<Evidence> evidence;
  for (const std::string& antenna : moved_antennas(samples)) {
    all.push_back(changes_of(samples, antenna));
    evidence.push_back(Search(kByPoses)(all.back()));
  }
  const double least = std::log(static_cast<double>(count_intervals(evidence)) / kJumpFalseAlarms);
  std::vector<PhaseJump> jumps;
  const bool may_jump = std::any_of(evidence.begin(), evidence.end(), [&](const Evidence& one) {
    return strongest(one, least).has_value();
  });
  if (!may_jump) return jumps;
  for (std::size_t i = 0; i < all.size(); ++i) {
    confirm(all[i], evidence[i]);
    for (PhaseJump& jump : own_jumps(all[i], evidence[i], least)) jumps.push_back(std::move(jump));
  }
  add_shared_jumps(all, evidence, jumps);
  return jumps;
}

void split_at_phase_jumps(const std::vector<PhaseJump>& jumps, double multiple,
                          SamplesByTag& samples, std::set<std::string>& offset_known,
                          Diagnostics& diagnostics) {
  constexpr double kRaised_hz = 1e-3;
  for (const PhaseJump& jump : jumps) {
    diagnostics.warn(text_of(jump, multiple, offset_known.erase(jump.antenna) > 0));
    for (auto& [tag, of_tag] : samples) {
      const auto series = of_tag.find(jump.antenna);
      if (series == of_tag.end()) continue;
      for (PhaseSample& sample : series->second) {
        if (sample.stamp >= jump.first_after) sample.frequency_hz += kRaised_hz;
      }
    }
  }
}

}  // namespace tagfield
