// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/internal/hard_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tagfield/base/units.h"
#include "tagfield/planning/local_link.h"

namespace tagfield {
namespace {

double median_margin_of(std::vector<double> values) {
  if (values.empty()) return kNothing_db;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

BestLink best_link(const PlanSpec& plan, const LinkMatrix& matrix, const PlanProblem& problem,
                   const OptionSet& choice, std::size_t group, std::size_t place) {
  BestLink best;
  for (const std::size_t number : choice) {
    const PlanOption& option = problem.options[number];
    const LinkColumn& column = matrix.columns[option.column];
    std::vector<double> all;
    std::map<std::size_t, std::vector<double>> by_turn;
    double nearest_m = 1e9;
    for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
      const LinkRow& of_row = matrix.rows[row];
      if (of_row.group != group || of_row.place != place) continue;
      const RigidTransform& X_WA = plan.mounts[column.mount].X_WA[column.look];
      nearest_m = std::min(nearest_m, (of_row.X_WT.translation - X_WA.translation).norm());
      const LinkStates states = matrix.states(option.column, row);
      for (std::size_t fade = 0; fade < kFadingPositions; ++fade) {
        for (std::size_t carrier = 0; carrier < std::max<std::size_t>(states.carriers(), 1);
             ++carrier) {
          const double margin =
              states.is_empty() ? -32.0
                                : states.margin_db(fade, carrier) - option.less_db - plan.margin_db;
          all.push_back(std::max(margin, -32.0));
          by_turn[of_row.orientation].push_back(all.back());
        }
      }
    }
    const double median = median_margin_of(all);
    if (median <= best.median_db) continue;
    best = {plan.mounts[column.mount].name, nearest_m, median, 100.0, -100.0, median > -32.0};
    for (auto& [turn, margins] : by_turn) {
      const double of_turn = median_margin_of(margins);
      best.worst_turn_db = std::min(best.worst_turn_db, of_turn);
      best.best_turn_db = std::max(best.best_turn_db, of_turn);
    }
  }
  return best;
}

std::string why_hard(const BestLink& link) {
  if (!link.arrives) {
    return "no antenna's signal arrives there: something opaque is in between";
  }
  if (link.worst_turn_db < 0.0 && link.best_turn_db >= 0.0) {
    return fmt::format("turned away: {:+.0f} dB in its best orientation, {:+.0f} dB in its worst",
                       link.best_turn_db, link.worst_turn_db);
  }
  if (link.median_db < 0.0) {
    return fmt::format("too weak by {:.1f} dB in the median", -link.median_db);
  }
  return fmt::format("fading: {:.1f} dB to spare in the median, which fades exceed",
                     link.median_db);
}

}  // namespace tagfield
