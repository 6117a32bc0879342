// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "tagfield/base/units.h"
#include "tagfield/localization/each_position.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

constexpr std::size_t kFewestOfChannel = 4;
constexpr std::size_t kMostOfChannel = 24;  ///< More add no information, and the cost is quadratic.
constexpr std::size_t kFewestOfAll = 40;
/// Phases of a single tag, noisy or random, hardly reach a third of this.
constexpr double kGroups = 16.0;

/// Sum of squares about the mean for any run of phases that are adjacent on the circle.
class Arcs {
 public:
  explicit Arcs(std::vector<double> phases) : count_(phases.size()) {
    std::sort(phases.begin(), phases.end());
    sums_.assign(1, 0.0);
    squares_.assign(1, 0.0);
    for (std::size_t i = 0; i < 2 * count_; ++i) {
      const double phase = phases[i % count_] + (i < count_ ? 0.0 : kTwoPi);
      sums_.push_back(sums_.back() + phase);
      squares_.push_back(squares_.back() + phase * phase);
    }
  }

  /// For `length` phases from index `first` < count on.
  [[nodiscard]] double squares(std::size_t first, std::size_t length) const {
    const double sum = sums_[first + length] - sums_[first];
    const double squares = squares_[first + length] - squares_[first];
    return std::max(0.0, squares - sum * sum / static_cast<double>(length));
  }

 private:
  std::size_t count_;
  std::vector<double> sums_, squares_;  ///< Cumulative, over two turns.
};

using PhasesByChannel = std::map<double, std::vector<double>>;

PhasesByChannel channels_of(const std::vector<PhaseSample>& series, double multiple) {
  PhasesByChannel channels;
  for (const PhaseSample& sample : series) {
    channels[sample.frequency_hz].push_back(wrap_to_two_pi(multiple * sample.phase_rad));
  }
  return channels;
}

/// Thins evenly, as tags may be read one after another.
std::vector<double> thinned(const std::vector<double>& phases) {
  if (phases.size() <= kMostOfChannel) return phases;
  std::vector<double> few;
  for (std::size_t i = 0; i < kMostOfChannel; ++i) {
    few.push_back(phases[i * phases.size() / kMostOfChannel]);
  }
  return few;
}

}  // namespace

PhaseScatter phase_scatter(const std::vector<double>& phases_rad) {
  const std::size_t n = phases_rad.size();
  const Arcs arcs(phases_rad);
  PhaseScatter scatter;
  scatter.reads = n;
  scatter.squares_of_one = scatter.squares_of_two = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < n; ++first) {
    scatter.squares_of_one = std::min(scatter.squares_of_one, arcs.squares(first, n));
    for (std::size_t length = 2; length + 2 <= n; ++length) {
      const double rest = arcs.squares((first + length) % n, n - length);
      scatter.squares_of_two = std::min(scatter.squares_of_two, arcs.squares(first, length) + rest);
    }
  }
  return scatter;
}

std::optional<double> group_ratio(const SamplesOfTag& samples, double multiple) {
  double of_one = 0.0;
  double of_two = 0.0;
  double cells = 0.0;
  std::size_t reads = 0;
  for (const auto& [antenna, series] : samples) {
    if (extent_of(series) >= kStillExtent) continue;
    for (const auto& [frequency_hz, phases] : channels_of(series, multiple)) {
      if (phases.size() < kFewestOfChannel) continue;
      const PhaseScatter scatter = phase_scatter(thinned(phases));
      of_one += scatter.squares_of_one;
      of_two += scatter.squares_of_two;
      reads += scatter.reads;
      cells += 1.0;
    }
  }
  if (reads < kFewestOfAll) return std::nullopt;
  const auto all = static_cast<double>(reads);
  // Identical phases have no noise to estimate: the quantization step of a 16-bit reader is used
  // instead.
  constexpr double kLeast = 1e-8;
  return (of_one / (all - cells) + kLeast) / (of_two / (all - 2.0 * cells) + kLeast);
}

void refuse_groups(const LocalizationProblem& problem, LocalizationResult& result) {
  for_each_position(problem, result, [&](const SamplesOfTag& samples, TagEstimate& estimate) {
    const double multiple = problem.pi_ambiguity ? 1.0 : 2.0;
    if (group_ratio(samples, multiple).value_or(0.0) < kGroups) return;
    estimate = not_located(std::move(estimate),
                           "phases of one antenna on one carrier come in two groups: there are two "
                           "tags under this EPC, or the tag or something beside it has moved");
  });
}

}  // namespace tagfield
