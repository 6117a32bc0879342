// SPDX-License-Identifier: Apache-2.0
/// @file
/// Forecast of what a layout's inventory will read, over samples of tags.
#pragma once

#include <vector>

#include "tagfield/layout/internal/link_reads.h"
#include "tagfield/layout/plan.h"
#include "tagfield/planning/forecast.h"

namespace tagfield {

/// Keeps references to all constructor arguments.
class LayoutForecast {
 public:
  LayoutForecast(const PlanSpec& plan, const LinkMatrix& matrix, const PlanProblem& problem,
                 const PlanRequest& request);

  /// Fills in the number of tags that meet the aim, in all and per zone.
  void fill(const OptionSet& choice, PlannedLayout& layout) const;
  /// The same for all zones together, with all links weaker by `less_db` than planned.
  [[nodiscard]] ExpectedCount read(const OptionSet& choice, double less_db) const;

 private:
  struct Sample {
    std::vector<char> read;  ///< Whether each tag meets the aim.
    std::vector<char> crossed;
  };
  /// With all links weaker by `less_db`.
  [[nodiscard]] std::vector<Sample> samples(const OptionSet& choice, double less_db) const;
  [[nodiscard]] std::vector<ForecastPort> ports_of(const OptionSet& choice) const;
  [[nodiscard]] std::size_t first_row_of(const PlanTag& tag) const;
  [[nodiscard]] const PlanMount& mount_of(std::size_t option) const;
  /// Position of an option's antenna [m].
  [[nodiscard]] Eigen::Vector3d place_of(std::size_t option) const;
  /// By port and row, if the aim is a position error; `states` is indexed alike.
  [[nodiscard]] std::vector<std::vector<RangeInformation>> ranges_of(
      const OptionSet& choice, const std::vector<std::vector<LinkStates>>& states,
      double less_db) const;
  /// Whether a tag with these reads by port meets the aim.
  [[nodiscard]] bool has_enough(const std::vector<CountedReads>& reads, const OptionSet& choice,
                                const std::vector<std::vector<RangeInformation>>& ranges,
                                std::size_t row) const;

  const PlanSpec& plan_;
  const LinkMatrix& matrix_;
  const PlanProblem& problem_;
  const PlanRequest& request_;
  std::vector<std::vector<PlanTag>> tags_;  ///< By sample.
  std::vector<std::vector<std::size_t>>
      first_rows_;                            ///< By group: position · orientations + orientation.
  std::vector<std::vector<PlanStop>> stops_;  ///< By group.
  double duration_s_ = 0.0;
};

}  // namespace tagfield
