// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/selection.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <set>

#include "tagfield/layout/internal/tally.h"

namespace tagfield {
namespace {

constexpr double kMinGain = 1e-12;

OptionSet with(OptionSet choice, std::size_t option) {
  choice.insert(std::upper_bound(choice.begin(), choice.end(), option), option);
  return choice;
}

OptionSet without(OptionSet choice, std::size_t place) {
  choice.erase(choice.begin() + static_cast<std::ptrdiff_t>(place));
  return choice;
}

/// The weight of each zone.
std::vector<double> weights_of(const SelectionProblem& problem) {
  std::vector<double> weights(problem.zones, 0.0);
  for (const SelectionElement& element : problem.elements) {
    if (element.zone < weights.size()) weights[element.zone] += element.weight;
  }
  return weights;
}

/// Makes the best exchange for one option of the choice, or the best addition. Returns whether
/// there was one.
bool improve(const SelectionProblem& problem, double& score, OptionSet& choice) {
  for (std::size_t place = 0; place <= choice.size(); ++place) {
    const bool adds = place == choice.size();
    const OptionSet rest = adds ? choice : without(choice, place);
    const Tally tally(problem, rest);
    const double of_rest = adds ? score : score_of(problem, rest);
    double most = score - of_rest + 1e-9;
    std::optional<OptionSet> best;
    for (std::size_t option = 0; option < problem.options.size(); ++option) {
      const double gain = tally.gain(option);
      if (gain <= most || std::binary_search(rest.begin(), rest.end(), option)) continue;
      OptionSet other = with(rest, option);
      if (broken_limit(problem, other) != Limit::kNone) continue;
      most = gain;
      best = std::move(other);
    }
    if (!best) continue;
    choice = std::move(*best);
    score = score_of(problem, choice);
    return true;
  }
  return false;
}

}  // namespace

double score_of(const SelectionProblem& problem, const OptionSet& choice) {
  return Tally(problem, choice).score();
}

std::vector<double> met_by(const SelectionProblem& problem, const OptionSet& choice) {
  const Tally tally(problem, choice);
  std::vector<double> met(problem.elements.size());
  for (std::size_t i = 0; i < met.size(); ++i) met[i] = tally.met(i);
  return met;
}

double error_bound_m(const std::vector<PositionInformation>& information) {
  InformationSum sum;
  for (const PositionInformation& one : information) sum = sum.with(one);
  return sum.error_m();
}

std::size_t readers_of(const SelectionProblem& problem, const OptionSet& choice) {
  std::map<std::size_t, std::size_t> antennas;
  for (const std::size_t option : choice) ++antennas[problem.options[option].zone];
  std::size_t readers = 0;
  for (const auto& [zone, count] : antennas) {
    readers += count / problem.limits.ports + (count % problem.limits.ports != 0 ? 1 : 0);
  }
  return readers;
}

double cost_of(const SelectionProblem& problem, const OptionSet& choice) {
  double cost = problem.limits.reader_cost * static_cast<double>(readers_of(problem, choice));
  for (const std::size_t option : choice) cost += problem.options[option].cost;
  return cost;
}

std::vector<double> cross_of(const SelectionProblem& problem, const OptionSet& choice) {
  std::vector<double> cross(problem.zones, 0.0);
  if (problem.zones == 0) return cross;
  std::vector<double> miss(problem.elements.size(), 1.0);
  for (const std::size_t number : choice) {
    for (const Miss& one : problem.options[number].crossings) {
      miss[one.element] *= static_cast<double>(one.probability);
    }
  }
  for (std::size_t i = 0; i < miss.size(); ++i) {
    const SelectionElement& element = problem.elements[i];
    if (element.zone < cross.size()) cross[element.zone] += element.weight * (1.0 - miss[i]);
  }
  const std::vector<double> weights = weights_of(problem);
  for (std::size_t zone = 0; zone < cross.size(); ++zone) {
    if (weights[zone] > 0.0) cross[zone] /= weights[zone];
  }
  return cross;
}

Limit broken_limit(const SelectionProblem& problem, const OptionSet& choice) {
  const SelectionLimits& limits = problem.limits;
  if (choice.size() > limits.antennas) return Limit::kAntennas;
  std::set<std::size_t> sites;
  for (const std::size_t option : choice) {
    if (!sites.insert(problem.options[option].site).second) return Limit::kSite;
  }
  if (readers_of(problem, choice) > limits.readers) return Limit::kReaders;
  if (cost_of(problem, choice) > limits.cost + 1e-9) return Limit::kCost;
  if (!std::isfinite(limits.cross)) return Limit::kNone;
  const std::vector<double> cross = cross_of(problem, choice);
  const bool crosses = std::any_of(cross.begin(), cross.end(),
                                   [&](double share) { return share > limits.cross + 1e-12; });
  return crosses ? Limit::kCross : Limit::kNone;
}

std::vector<std::size_t> greedy_order(const SelectionProblem& problem, bool by_cost) {
  struct Entry {
    double value;
    std::size_t option;
    std::size_t round;  ///< Round in which the value was computed.
    bool operator<(const Entry& other) const {
      return value != other.value ? value < other.value : option > other.option;
    }
  };
  const auto value_of = [&](std::size_t option, double gain) {
    const double cost = problem.options[option].cost;
    return by_cost && cost > 0.0 ? gain / cost : gain;
  };
  Tally tally(problem);
  std::priority_queue<Entry> queue;
  for (std::size_t i = 0; i < problem.options.size(); ++i) {
    queue.push({value_of(i, tally.gain(i)), i, 0});
  }
  std::vector<std::size_t> order;
  OptionSet choice;
  while (!queue.empty() && order.size() < problem.limits.antennas) {
    Entry top = queue.top();
    queue.pop();
    if (top.value < kMinGain) break;
    if (top.round < order.size()) {
      top.value = value_of(top.option, tally.gain(top.option));
      top.round = order.size();
      queue.push(top);
      continue;
    }
    // What exceeds the limits now always will, since the choice only grows.
    const OptionSet more = with(choice, top.option);
    if (broken_limit(problem, more) != Limit::kNone) continue;
    choice = more;
    order.push_back(top.option);
    tally.take(top.option);
  }
  return order;
}

OptionSet exchanged(const SelectionProblem& problem, OptionSet choice, int rounds) {
  double score = score_of(problem, choice);
  for (int round = 0; round < rounds && improve(problem, score, choice); ++round) {
  }
  return choice;
}

double upper_bound(const SelectionProblem& problem, const OptionSet& choice) {
  const Tally tally(problem, choice);
  std::vector<double> gains;
  for (std::size_t i = 0; i < problem.options.size(); ++i) gains.push_back(tally.gain(i));
  std::sort(gains.begin(), gains.end(), std::greater<>());
  double bound = tally.score();
  for (std::size_t i = 0; i < std::min(gains.size(), problem.limits.antennas); ++i) {
    bound += gains[i];
  }
  return std::min(bound, 1.0);
}

std::optional<double> guaranteed_share(const SelectionProblem& problem) {
  const SelectionLimits& limits = problem.limits;
  if (std::isfinite(limits.cost) || std::isfinite(limits.cross)) return std::nullopt;
  // Each antenna may need a separate reader for its zone.
  if (limits.readers < limits.antennas && problem.zones > 0) return std::nullopt;
  if (limits.readers < limits.antennas / std::max<std::size_t>(limits.ports, 1))
    return std::nullopt;
  std::set<std::size_t> sites;
  for (const SelectionOption& option : problem.options) {
    if (!sites.insert(option.site).second) return 0.5;
  }
  return 1.0 - std::exp(-1.0);
}

OptionSet best_by_trying(const SelectionProblem& problem) {
  OptionSet best;
  double most = -1.0;
  const std::function<void(std::size_t, OptionSet&)> go_on = [&](std::size_t from,
                                                                 OptionSet& choice) {
    const double score = score_of(problem, choice);
    if (score > most + 1e-15) {
      most = score;
      best = choice;
    }
    for (std::size_t option = from; option < problem.options.size(); ++option) {
      choice.push_back(option);
      // A choice beyond a limit stays so with more antennas.
      if (broken_limit(problem, choice) == Limit::kNone) go_on(option + 1, choice);
      choice.pop_back();
    }
  };
  OptionSet none;
  go_on(0, none);
  return best;
}

}  // namespace tagfield
