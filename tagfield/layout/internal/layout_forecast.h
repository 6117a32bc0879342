// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a layout's inventory will read, over samples of tags.
#pragma once

#include <vector>

#include "tagfield/layout/internal/link_reads.h"
#include "tagfield/layout/plan.h"
#include "tagfield/planning/forecast.h"

namespace tagfield {

/// Keeps references to all that it is made of.
class LayoutForecast {
 public:
  LayoutForecast(const PlanSpec& plan, const LinkMatrix& matrix, const PlanProblem& problem,
                 const PlanRequest& request);

  /// Tags that have what is aimed at, and zone for zone.
  void fill(const OptionSet& choice, PlannedLayout& layout) const;
  /// The same of all zones where all links have `less_db` less than planned with.
  [[nodiscard]] ExpectedCount read(const OptionSet& choice, double less_db) const;

 private:
  struct Sample {
    std::vector<char> read;  ///< And what else is aimed at.
    std::vector<char> crossed;
  };
  /// With all links as much weaker than they are.
  [[nodiscard]] std::vector<Sample> samples(const OptionSet& choice, double less_db) const;
  [[nodiscard]] std::vector<ForecastPort> ports_of(const OptionSet& choice) const;
  [[nodiscard]] std::size_t first_row_of(const PlanTag& tag) const;
  [[nodiscard]] const PlanMount& mount_of(std::size_t option) const;
  /// Of an option's antenna [m].
  [[nodiscard]] Eigen::Vector3d place_of(std::size_t option) const;
  /// By port and row, where positions are aimed at; `states` likewise.
  [[nodiscard]] std::vector<std::vector<RangeTold>> ranges_of(
      const OptionSet& choice, const std::vector<std::vector<LinkStates>>& states,
      double less_db) const;
  /// Whether a tag with so many reads by port has what is aimed at.
  [[nodiscard]] bool has_enough(const std::vector<CountedReads>& reads, const OptionSet& choice,
                                const std::vector<std::vector<RangeTold>>& ranges,
                                std::size_t row) const;

  const PlanSpec& plan_;
  const LinkMatrix& matrix_;
  const PlanProblem& problem_;
  const PlanRequest& request_;
  std::vector<std::vector<PlanTag>> tags_;  ///< By sample.
  std::vector<std::vector<std::size_t>>
      first_rows_;                            ///< By group: place · orientations + orientation.
  std::vector<std::vector<PlanStop>> stops_;  ///< By group.
  double duration_s_ = 0.0;
};

}  // namespace tagfield
