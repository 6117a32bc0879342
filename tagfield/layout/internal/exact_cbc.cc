// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "tagfield/base/error.h"
#include "tagfield/layout/internal/libcbc.h"
#include "tagfield/layout/selection.h"

namespace tagfield {
namespace {

/// The logarithm of an option that never misses would be unbounded.
constexpr double kMaxLog = 30.0;
constexpr double kTouching = 1e-7;
constexpr int kMaxRounds = 200;

struct DeleteModel {
  void operator()(Cbc_Model* model) const { libcbc().deleteModel(model); }
};
using Model = std::unique_ptr<Cbc_Model, DeleteModel>;

struct Term {
  int column;
  double value;
};

/// Σ terms ≤ most.
struct Row {
  std::vector<Term> terms;
  double most = 0.0;
};

double log_of(const Miss& miss) {
  return std::min(kMaxLog, -std::log(std::max(static_cast<double>(miss.probability), 1e-300)));
}

/// Columns: one per option (0 or 1), then one per element (its worth, up to cap), then one per zone
/// (integer number of readers).
class Program {
 public:
  Program(const SelectionProblem& problem, const OptionSet& begin);
  ExactChoice solve(double seconds);

 private:
  [[nodiscard]] int option_column(std::size_t option) const { return static_cast<int>(option); }
  [[nodiscard]] int element_column(std::size_t element) const {
    return static_cast<int>(problem_.options.size() + element);
  }
  [[nodiscard]] int zone_column(std::size_t group) const {
    return static_cast<int>(problem_.options.size() + problem_.elements.size() + group);
  }
  [[nodiscard]] std::size_t columns() const {
    return problem_.options.size() + problem_.elements.size() + zones_.size();
  }
  void add_terms(std::size_t option);
  void add_limits();
  void add_first_bounds();
  void add_tangent(std::size_t element, double at);
  bool add_cross_cut(const OptionSet& choice);
  std::size_t add_tangents(const OptionSet& choice, const std::vector<double>& worth);
  struct Solved {
    OptionSet choice;
    std::vector<double> worth;  ///< Of the elements.
    double bound = 1.0;
    bool is_optimal = false;
    bool is_feasible = false;
  };
  [[nodiscard]] Solved solve_once(double seconds) const;

  const SelectionProblem& problem_;
  OptionSet best_;
  std::vector<std::vector<Term>> sums_;  ///< By element, over options: of −ln p, or of reads.
  std::vector<std::size_t> zones_;       ///< Zones of the options; kNoZone counts as one.
  std::vector<Row> rows_;
};

Program::Program(const SelectionProblem& problem, const OptionSet& begin)
    : problem_(problem), best_(begin), sums_(problem.elements.size()) {
  for (std::size_t i = 0; i < problem.options.size(); ++i) {
    add_terms(i);
    const std::size_t zone = problem.options[i].zone;
    if (std::find(zones_.begin(), zones_.end(), zone) == zones_.end()) zones_.push_back(zone);
  }
  add_limits();
  add_first_bounds();
}

void Program::add_terms(std::size_t option) {
  const SelectionOption& of = problem_.options[option];
  if (problem_.worth == Worth::kReads) {
    for (const ReadsOf& one : of.reads) {
      sums_[one.element].push_back({option_column(option), static_cast<double>(one.reads)});
    }
    return;
  }
  for (const Miss& miss : of.misses) {
    sums_[miss.element].push_back({option_column(option), log_of(miss)});
  }
}

/// Reads are bounded by their sum, up to the cap; probabilities by tangents of a curve of the sum.
void Program::add_first_bounds() {
  for (std::size_t element = 0; element < sums_.size(); ++element) {
    if (problem_.worth == Worth::kReads) {
      Row row{{{element_column(element), 1.0}}, 0.0};
      for (const Term& term : sums_[element]) row.terms.push_back({term.column, -term.value});
      rows_.push_back(std::move(row));
      continue;
    }
    for (const double at : {0.0, 0.7, 2.0, 4.5}) add_tangent(element, at);
  }
}

void Program::add_limits() {
  const SelectionLimits& limits = problem_.limits;
  Row antennas{{}, static_cast<double>(limits.antennas)};
  Row cost{{}, limits.cost};
  std::map<std::size_t, Row> sites;
  std::vector<Row> ports(zones_.size());
  for (std::size_t i = 0; i < problem_.options.size(); ++i) {
    const SelectionOption& option = problem_.options[i];
    antennas.terms.push_back({option_column(i), 1.0});
    cost.terms.push_back({option_column(i), option.cost});
    sites[option.site].terms.push_back({option_column(i), 1.0});
    const auto zone = std::find(zones_.begin(), zones_.end(), option.zone);
    ports[static_cast<std::size_t>(zone - zones_.begin())].terms.push_back({option_column(i), 1.0});
  }
  Row readers{{}, static_cast<double>(std::min<std::size_t>(limits.readers, 1'000'000))};
  for (std::size_t zone = 0; zone < zones_.size(); ++zone) {
    const auto of_reader = static_cast<double>(std::min<std::size_t>(limits.ports, 1'000'000));
    ports[zone].terms.push_back({zone_column(zone), -of_reader});
    readers.terms.push_back({zone_column(zone), 1.0});
    cost.terms.push_back({zone_column(zone), limits.reader_cost});
    rows_.push_back(ports[zone]);
  }
  rows_.push_back(antennas);
  rows_.push_back(readers);
  if (std::isfinite(limits.cost)) rows_.push_back(cost);
  for (auto& [site, row] : sites) {
    row.most = 1.0;
    if (row.terms.size() > 1) rows_.push_back(row);
  }
}

/// y ≤ 1 − e^−a + e^−a (L − a), for the element's y and L.
void Program::add_tangent(std::size_t element, double at) {
  const double slope = std::exp(-at);
  Row row{{{element_column(element), 1.0}}, 1.0 - slope - slope * at};
  for (const Term& term : sums_[element]) row.terms.push_back({term.column, -slope * term.value});
  rows_.push_back(std::move(row));
}

/// Where a zone has too many cross reads, forbids taking all the responsible options of other zones
/// together. Uses as few of these as still exceed the limit, for a strong cut.
bool Program::add_cross_cut(const OptionSet& choice) {
  const std::vector<double> cross = cross_of(problem_, choice);
  bool any = false;
  for (std::size_t zone = 0; zone < cross.size(); ++zone) {
    if (cross[zone] <= problem_.limits.cross + 1e-12) continue;
    OptionSet guilty = choice;
    for (std::size_t i = guilty.size(); i-- > 0;) {
      OptionSet fewer = guilty;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      if (cross_of(problem_, fewer)[zone] > problem_.limits.cross + 1e-12) guilty = fewer;
    }
    Row row{{}, static_cast<double>(guilty.size()) - 1.0};
    for (const std::size_t option : guilty) row.terms.push_back({option_column(option), 1.0});
    rows_.push_back(std::move(row));
    any = true;
  }
  return any;
}

/// Adds tangents for elements to which the program assigns more than the choice gives them. Returns
/// how many.
std::size_t Program::add_tangents(const OptionSet& choice, const std::vector<double>& worth) {
  if (problem_.worth == Worth::kReads) return 0;
  std::vector<double> log(problem_.elements.size(), 0.0);
  for (const std::size_t option : choice) {
    for (const Miss& miss : problem_.options[option].misses) log[miss.element] += log_of(miss);
  }
  std::size_t added = 0;
  for (std::size_t element = 0; element < log.size(); ++element) {
    const double truly = std::min(1.0 - std::exp(-log[element]), problem_.cap);
    if (worth[element] <= truly + kTouching) continue;
    add_tangent(element, log[element]);
    ++added;
  }
  return added;
}

// NOLINTNEXTLINE(readability-function-size): one conversation with CBC, step by step.
Program::Solved Program::solve_once(double seconds) const {
  std::vector<std::vector<std::pair<int, double>>> by_column(columns());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    for (const Term& term : rows_[row].terms) {
      by_column[static_cast<std::size_t>(term.column)].emplace_back(static_cast<int>(row),
                                                                    term.value);
    }
  }
  std::vector<CoinBigIndex> start = {0};
  std::vector<int> index;
  std::vector<double> value;
  for (const auto& column : by_column) {
    for (const auto& [row, factor] : column) {
      index.push_back(row);
      value.push_back(factor);
    }
    start.push_back(static_cast<CoinBigIndex>(index.size()));
  }
  std::vector<double> low(columns(), 0.0);
  std::vector<double> high(columns(), 1.0);
  std::vector<double> objective(columns(), 0.0);
  for (std::size_t i = 0; i < problem_.elements.size(); ++i) {
    const auto column = static_cast<std::size_t>(element_column(i));
    high[column] = problem_.cap;
    objective[column] = -problem_.elements[i].weight / problem_.cap;
  }
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    high[static_cast<std::size_t>(zone_column(i))] = static_cast<double>(problem_.options.size());
  }
  std::vector<double> row_low(rows_.size(), -1e30);
  std::vector<double> row_high;
  for (const Row& row : rows_) row_high.push_back(row.most);
  const Model model(libcbc().newModel());
  libcbc().setParameter(model.get(), "logLevel", "0");
  libcbc().setParameter(model.get(), "sec", std::to_string(seconds).c_str());
  libcbc().setParameter(model.get(), "ratioGap", "0");
  libcbc().setParameter(model.get(), "allowableGap", "1e-9");
  libcbc().loadProblem(model.get(), static_cast<int>(columns()), static_cast<int>(rows_.size()),
                       start.data(), index.data(), value.data(), low.data(), high.data(),
                       objective.data(), row_low.data(), row_high.data());
  for (std::size_t i = 0; i < problem_.options.size(); ++i) {
    libcbc().setInteger(model.get(), option_column(i));
  }
  for (std::size_t i = 0; i < zones_.size(); ++i) libcbc().setInteger(model.get(), zone_column(i));
  libcbc().solve(model.get());
  Solved solved;
  solved.is_optimal = libcbc().isProvenOptimal(model.get()) != 0;
  solved.bound = std::min(1.0, -libcbc().getBestPossibleObjValue(model.get()));
  const double* const found = libcbc().getColSolution(model.get());
  solved.is_feasible = found != nullptr && libcbc().isProvenInfeasible(model.get()) == 0;
  if (!solved.is_feasible) return solved;
  for (std::size_t i = 0; i < problem_.options.size(); ++i) {
    if (found[option_column(i)] > 0.5) solved.choice.push_back(i);
  }
  for (std::size_t i = 0; i < problem_.elements.size(); ++i) {
    solved.worth.push_back(found[element_column(i)]);
  }
  return solved;
}

ExactChoice Program::solve(double seconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  double most = score_of(problem_, best_);
  double bound = 1.0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
    if (spent >= seconds) break;
    const Solved solved = solve_once(seconds - spent);
    if (!solved.is_feasible) break;
    bound = std::min(bound, solved.bound);
    const bool crosses = add_cross_cut(solved.choice);
    if (!crosses && broken_limit(problem_, solved.choice) == Limit::kNone) {
      const double score = score_of(problem_, solved.choice);
      if (score > most) {
        most = score;
        best_ = solved.choice;
      }
    }
    if (bound - most <= 1e-7) break;
    if (add_tangents(solved.choice, solved.worth) == 0 && !crosses) break;
  }
  return {best_, std::max(bound, most)};
}

}  // namespace

bool has_exact_solver() { return true; }

void require_exact_solver(Worth worth) {
  if (worth != Worth::kPlace) return;
  throw Error(
      "plan.aim.position_error_m has no exact solution, as it is not an integer program: leave out "
      "--exact");
}

ExactChoice best_exactly(const SelectionProblem& problem, const OptionSet& begin, double seconds) {
  require_exact_solver(problem.worth);
  return Program(problem, begin).solve(seconds);
}

}  // namespace tagfield
