// SPDX-License-Identifier: Apache-2.0
/// @file
/// What each element of a selection gets from the chosen options, and what that is worth.
#pragma once

#include <cstddef>
#include <vector>

#include "tagfield/layout/selection.h"

namespace tagfield {

/// Sum of several antennas' information about a position; in doubles, since some contribute far
/// more than others.
struct InformationSum {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  std::size_t antennas = 0;  ///< With nonzero information.

  [[nodiscard]] InformationSum with(const PositionInformation& one) const;
  /// As error_bound_m().
  [[nodiscard]] double error_m() const;
};

/// Accumulates the options of a choice one by one. Keeps a reference to the problem.
class Tally {
 public:
  explicit Tally(const SelectionProblem& problem, const OptionSet& choice = {});

  void take(std::size_t option);
  /// Gain in score by one more option.
  [[nodiscard]] double gain(std::size_t option) const;
  [[nodiscard]] double score() const;
  /// As met_by().
  [[nodiscard]] double met(std::size_t element) const;

 private:
  [[nodiscard]] double worth_of_miss(std::size_t element, double miss) const;
  [[nodiscard]] double worth_of_reads(std::size_t element, double reads) const;
  [[nodiscard]] double worth_of_place(std::size_t element, const InformationSum& sum) const;

  const SelectionProblem& problem_;
  // By element; only the one used by the problem's worth is filled.
  std::vector<double> miss_;
  std::vector<double> reads_;
  std::vector<InformationSum> information_;
};

}  // namespace tagfield
