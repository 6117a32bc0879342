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

/// How often an option reads an element, where it does.
struct ReadsOf {
  std::uint32_t element = 0;
  float reads = 0.0F;
};

/// What an option tells of where an element is: its part of the Fisher information of x and y
/// [1/m²].
struct Told {
  std::uint32_t element = 0;
  float xx = 0.0F;
  float xy = 0.0F;
  float yy = 0.0F;
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
  std::vector<ReadsOf> reads{};  ///< By rising element, each once, where Worth::kReads counts;
  std::vector<Told> told{};      ///< likewise where Worth::kPlace does.
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

/// What is worth something of an element, from 0 to 1.
enum class Worth {
  kProbability,  ///< min(1 − Π p, cap)/cap, of the options' misses.
  kReads,        ///< min(Σ n, cap)/cap, of their reads.
  /// ln(det J/det J₀)/ln(det J₁/det J₀), at most 1: J = J₀ + Σ of what they tell, J₀ = 1/spread²,
  /// and J₁ = 8/error² (times the unit matrix), of an error half as large.
  kPlace,
};

struct SelectionProblem {
  std::vector<SelectionOption> options;
  std::vector<SelectionElement> elements;  ///< Weights sum to 1.
  std::size_t zones = 0;
  SelectionLimits limits;
  Worth worth = Worth::kProbability;
  double cap = 1.0;       ///< Probability in (0, 1], or reads, beyond which more is worth nothing.
  double error_m = 1.0;   ///< Of a place, root mean square, that is aimed at; over 0,
  double spread_m = 1.0;  ///< and what is known of it before; √2·spread is over the error.
};

using OptionSet = std::vector<std::size_t>;  ///< Numbers of options, rising.

/// Σ w·worth over the elements: monotone and submodular in the choice.
double score_of(const SelectionProblem& problem, const OptionSet& choice);

/// By element, what the choice gives it of what is aimed at: the probability to be read; else 1 or
/// 0, whether it has its reads, or the bound on its place's error, error_bound_m(), is error_m at
/// most.
std::vector<double> met_by(const SelectionProblem& problem, const OptionSet& choice);

/// Two distances leave two places: so many antennas must tell something.
inline constexpr std::size_t kFewestForPlace = 3;

/// √tr (Σ told)⁻¹ [m]; infinity where nothing is told in some direction, or by too few.
double error_bound_m(const std::vector<Told>& told);

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

/// Throws Error without a solver, and where places count, which are no integer program.
void require_exact_solver(Worth worth);

/// By an integer program: elements' probabilities are bounded by tangents of 1 − e^−L, of which
/// more are added where the solution is not on the curve, reads by their sum, and by cuts where it
/// crosses zones too much. `begin` is a choice that fits. Throws Error as require_exact_solver().
ExactChoice best_exactly(const SelectionProblem& problem, const OptionSet& begin, double seconds);

}  // namespace tagfield
