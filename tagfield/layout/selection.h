// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which antennas to take: the choice that reads most within its limits, by greed, exchange, trying
/// all, or exactly. See docs/plan.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace tagfield {

/// Where an option reaches an element, and how likely it misses it there.
struct Miss {
  std::uint32_t element = 0;
  float probability = 1.0F;  ///< In [0, 1).
};

/// One way to mount one antenna.
struct SelectionOption {
  std::size_t site = 0;  ///< Of options of one site at most one is taken.
  std::size_t zone = 0;  ///< That its reader is for; kNoZone for none.
  double cost = 0.0;
  std::vector<Miss> misses;  ///< By rising element, each once.
  /// The same for elements of other zones, as far as it is a cross read: what counts against the
  /// option need not be as weak as what counts for it.
  std::vector<Miss> crossings;
};

inline constexpr std::size_t kNoZone = std::numeric_limits<std::size_t>::max();

/// What is to be read: tags in one place, of one orientation, in one state of fading.
struct SelectionElement {
  double weight = 0.0;
  std::size_t zone = kNoZone;
};

struct SelectionLimits {
  std::size_t antennas = 1;
  std::size_t readers = std::numeric_limits<std::size_t>::max();
  std::size_t ports = std::numeric_limits<std::size_t>::max();  ///< Of a reader.
  double reader_cost = 0.0;
  double cost = std::numeric_limits<double>::infinity();
  /// Most share of a zone's weight that options of other zones read.
  double cross = std::numeric_limits<double>::infinity();
};

struct SelectionProblem {
  std::vector<SelectionOption> options;
  std::vector<SelectionElement> elements;  ///< Weights sum to 1.
  std::size_t zones = 0;
  SelectionLimits limits;
  double cap = 1.0;  ///< Probability beyond which more is worth nothing; in (0, 1].
};

using OptionSet = std::vector<std::size_t>;  ///< Numbers of options, rising.

/// Σ w·min(1 − Π p, cap)/cap over the elements: monotone and submodular in the choice.
double score_of(const SelectionProblem& problem, const OptionSet& choice);

/// Readers that the choice needs: of each zone as many as its antennas need ports.
std::size_t readers_of(const SelectionProblem& problem, const OptionSet& choice);
/// Of antennas and readers.
double cost_of(const SelectionProblem& problem, const OptionSet& choice);
/// For each zone, the share of its weight that options of other zones read.
std::vector<double> cross_of(const SelectionProblem& problem, const OptionSet& choice);

/// Which limit the choice is beyond.
enum class Limit { kNone, kAntennas, kSite, kReaders, kCost, kCross };
Limit broken_limit(const SelectionProblem& problem, const OptionSet& choice);

/// The options in the order in which greed takes them: each time the one that adds most, or adds
/// most for its cost where `by_cost` is set, as long as one that fits adds anything. Lazy: an
/// option's gain is computed anew only where it could be the greatest (Minoux 1978).
std::vector<std::size_t> greedy_order(const SelectionProblem& problem, bool by_cost = false);

/// Improves a choice by exchanging one option for another, and adding what fits, as long as that
/// adds anything, at most `rounds` times over all.
OptionSet exchanged(const SelectionProblem& problem, OptionSet choice, int rounds);

/// No choice of at most `limits.antennas` has more: the score and the greatest gains of so many
/// options, which submodularity bounds it by (Nemhauser, Wolsey, Fisher 1978, (1.9)); 1 at most.
double upper_bound(const SelectionProblem& problem, const OptionSet& choice);

/// What greed has for sure of the best, before anything is known of the case: 1 − 1/e where only
/// the number of antennas is limited, ½ where sites have several options as well (Fisher,
/// Nemhauser, Wolsey 1978), and none with other limits that hold greed back.
std::optional<double> guaranteed_share(const SelectionProblem& problem);

/// Tries all; for up to some 25 options.
OptionSet best_by_trying(const SelectionProblem& problem);

/// The best choice, or what was found in time.
struct ExactChoice {
  OptionSet choice;
  double bound = 1.0;  ///< No choice has more.
};

/// Whether this was built with a solver of integer programs.
bool has_exact_solver();

/// By an integer program: elements' probabilities are bounded by tangents of 1 − e^−L, of which
/// more are added where the solution is not on the curve, and by cuts where it crosses zones too
/// much. `begin` is a choice that fits. Throws Error without a solver.
ExactChoice best_exactly(const SelectionProblem& problem, const OptionSet& begin, double seconds);

}  // namespace tagfield
