// SPDX-License-Identifier: Apache-2.0
/// @file
/// Selection of antennas: the choice that reads most within its limits, by greedy selection,
/// exchange, exhaustive search, or an exact solver. See docs/plan.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace tagfield {

/// An element that an option reaches, and the probability of missing it.
struct Miss {
  std::uint32_t element = 0;
  float probability = 1.0F;  ///< In [0, 1).
};

/// How often an option reads an element.
struct ReadsOf {
  std::uint32_t element = 0;
  float reads = 0.0F;
};

/// An option's contribution to the Fisher information about the position x, y of an element [1/m²].
struct PositionInformation {
  std::uint32_t element = 0;
  float xx = 0.0F;
  float xy = 0.0F;
  float yy = 0.0F;
};

/// One way to mount one antenna.
struct SelectionOption {
  std::size_t site = 0;  ///< At most one option per site may be chosen.
  std::size_t zone = 0;  ///< That its reader serves; kNoZone for none.
  double cost = 0.0;
  std::vector<Miss> misses;  ///< Sorted by element, each at most once.
  /// The same for elements of other zones, where reading them is a cross read: links that count
  /// against the option need not have the margin of those that count for it.
  std::vector<Miss> crossings;
  std::vector<ReadsOf> reads{};                    ///< Also sorted; used for Worth::kReads.
  std::vector<PositionInformation> information{};  ///< Also sorted; used for Worth::kPlace.
};

inline constexpr std::size_t kNoZone = std::numeric_limits<std::size_t>::max();

/// What is to be read: tags at one position, in one orientation and one fading state.
struct SelectionElement {
  double weight = 0.0;
  std::size_t zone = kNoZone;
};

struct SelectionLimits {
  std::size_t antennas = 1;
  std::size_t readers = std::numeric_limits<std::size_t>::max();
  std::size_t ports = std::numeric_limits<std::size_t>::max();  ///< Per reader.
  double reader_cost = 0.0;
  double cost = std::numeric_limits<double>::infinity();
  /// Maximum fraction of a zone's weight read by options of other zones.
  double cross = std::numeric_limits<double>::infinity();
};

/// How the worth of an element is measured, from 0 to 1.
enum class Worth {
  kProbability,  ///< min(1 − Π p, cap)/cap, with the miss probabilities p of the options.
  kReads,        ///< min(Σ n, cap)/cap, with their reads n.
  /// ln(det J/det J₀)/ln(det J₁/det J₀), at most 1: J = J₀ + Σ of their Fisher information, J₀ =
  /// 1/spread² and J₁ = 8/error² (times the identity matrix), which stands for half that error.
  kPlace,
};

struct SelectionProblem {
  std::vector<SelectionOption> options;
  std::vector<SelectionElement> elements;  ///< Weights sum to 1.
  std::size_t zones = 0;
  SelectionLimits limits;
  Worth worth = Worth::kProbability;
  double cap = 1.0;       ///< Probability in (0, 1], or reads, above which more is worth nothing.
  double error_m = 1.0;   ///< Target RMS error of a position; > 0,
  double spread_m = 1.0;  ///< and its prior standard deviation; √2·spread must exceed the error.
};

using OptionSet = std::vector<std::size_t>;  ///< Indices of options, in ascending order.

/// Σ w·worth over the elements: monotone and submodular in the choice.
double score_of(const SelectionProblem& problem, const OptionSet& choice);

/// By element, how well the choice meets the aim: the probability of being read; or else 1 or 0,
/// whether it gets enough reads, or whether the bound on its position error, error_bound_m(), is at
/// most error_m.
std::vector<double> met_by(const SelectionProblem& problem, const OptionSet& choice);

/// Least number of antennas to locate a tag: two distances leave two possible positions.
inline constexpr std::size_t kFewestForPlace = 3;

/// √tr (Σ information)⁻¹ [m]; infinity if there is no information in some direction, or from too
/// few antennas.
double error_bound_m(const std::vector<PositionInformation>& information);

/// Number of readers that the choice needs: enough ports for the antennas of each zone.
std::size_t readers_of(const SelectionProblem& problem, const OptionSet& choice);
/// Cost of antennas and readers.
double cost_of(const SelectionProblem& problem, const OptionSet& choice);
/// For each zone, the fraction of its weight read by options of other zones.
std::vector<double> cross_of(const SelectionProblem& problem, const OptionSet& choice);

/// The limit that a choice exceeds.
enum class Limit { kNone, kAntennas, kSite, kReaders, kCost, kCross };
Limit broken_limit(const SelectionProblem& problem, const OptionSet& choice);

/// The options in greedy order: each time the one with the greatest gain, or gain per cost if
/// `by_cost` is set, as long as one within the limits gains anything. Lazy: an option's gain is
/// recomputed only if it could be the greatest (Minoux 1978).
std::vector<std::size_t> greedy_order(const SelectionProblem& problem, bool by_cost = false);

/// Improves a choice by exchanging one option for another or adding one within the limits, as long
/// as that gains anything, in at most `rounds` rounds.
OptionSet exchanged(const SelectionProblem& problem, OptionSet choice, int rounds);

/// Upper bound on the score of any choice of at most `limits.antennas` options, by submodularity:
/// the score of `choice` plus that many greatest gains (Nemhauser, Wolsey, Fisher 1978, (1.9)); at
/// most 1.
double upper_bound(const SelectionProblem& problem, const OptionSet& choice);

/// The a priori guarantee of greedy selection, as a fraction of the optimum: 1 − 1/e if only the
/// number of antennas is limited, ½ if sites have several options as well (Fisher, Nemhauser,
/// Wolsey 1978), and none with other limits that restrict it.
std::optional<double> guaranteed_share(const SelectionProblem& problem);

/// Exhaustive search; feasible for up to some 25 options.
OptionSet best_by_trying(const SelectionProblem& problem);

/// The best choice, or the best found in time.
struct ExactChoice {
  OptionSet choice;
  double bound = 1.0;  ///< Upper bound on the score of any choice.
};

/// Whether an integer programming solver was compiled in.
bool has_exact_solver();

/// Throws Error without a solver, and for Worth::kPlace, which is no integer program.
void require_exact_solver(Worth worth);

/// Solves the selection as an integer program: probabilities of elements are bounded by tangents of
/// 1 − e^−L, of which more are added where the solution is off the curve, and reads by their sum.
/// Cuts are added where a solution has too many cross reads. `begin` must be within the limits.
/// Throws Error as require_exact_solver().
ExactChoice best_exactly(const SelectionProblem& problem, const OptionSet& begin, double seconds);

}  // namespace tagfield
