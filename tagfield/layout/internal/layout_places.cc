// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/internal/layout_places.h"

#include <algorithm>
#include <utility>

#include "tagfield/planning/local_link.h"

namespace tagfield {
namespace {

/// Index of each group's first position among all, and the total number.
std::pair<std::vector<std::size_t>, std::size_t> first_places(const PlanSpec& plan) {
  std::vector<std::size_t> first(plan.tags.size(), 0);
  std::size_t places = 0;
  for (std::size_t group = 0; group < plan.tags.size(); ++group) {
    first[group] = places;
    places += plan.tags[group].places.size();
  }
  return {first, places};
}

}  // namespace

std::vector<double> met_by_place(const PlanSpec& plan, const LinkMatrix& matrix,
                                 const PlanProblem& problem, const OptionSet& choice) {
  const std::vector<double> met = met_by(problem.selection, choice);
  const auto [first_place, places] = first_places(plan);
  std::vector<double> by_place(places, 0.0);
  const std::vector<LinkElement> elements = elements_of(matrix);
  for (std::size_t number = 0; number < elements.size(); ++number) {
    const LinkRow& row = matrix.rows[elements[number].first_row];
    const auto ways =
        static_cast<double>(plan.tags[row.group].orientations.size() * kFadingPositions);
    for (std::size_t fade = 0; fade < kFadingPositions; ++fade) {
      by_place[first_place[row.group] + row.place] += met[number * kFadingPositions + fade] / ways;
    }
  }
  return by_place;
}

std::vector<double> errors_by_place(const PlanSpec& plan, const LinkMatrix& matrix,
                                    const PlanProblem& problem, const OptionSet& choice) {
  const auto [first_place, places] = first_places(plan);
  const std::vector<LinkElement> elements = elements_of(matrix);
  std::vector<std::vector<PositionInformation>> information(places);
  for (const std::size_t option : choice) {
    std::vector<PositionInformation> of_option(places);
    for (const PositionInformation& one : problem.selection.options[option].information) {
      const LinkRow& row = matrix.rows[elements[one.element / kFadingPositions].first_row];
      const auto ways =
          static_cast<float>(plan.tags[row.group].orientations.size() * kFadingPositions);
      PositionInformation& sum = of_option[first_place[row.group] + row.place];
      sum.xx += one.xx / ways;
      sum.xy += one.xy / ways;
      sum.yy += one.yy / ways;
    }
    for (std::size_t place = 0; place < places; ++place) {
      information[place].push_back(of_option[place]);
    }
  }
  std::vector<double> errors(places);
  std::transform(information.begin(), information.end(), errors.begin(), error_bound_m);
  return errors;
}

}  // namespace tagfield
