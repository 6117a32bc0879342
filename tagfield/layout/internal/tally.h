// SPDX-License-Identifier: Apache-2.0
/// @file
/// What each element of a selection has of some options, and what that is worth.
#pragma once

#include <cstddef>
#include <vector>

#include "tagfield/layout/selection.h"

namespace tagfield {

/// What several antennas tell of a place; in doubles, as some tell far more than others.
struct ToldSum {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  std::size_t antennas = 0;  ///< That tell anything.

  [[nodiscard]] ToldSum with(const Told& one) const;
  /// As error_bound_m().
  [[nodiscard]] double error_m() const;
};

/// The options of a choice, one after the other. Keeps a reference to the problem.
class Tally {
 public:
  explicit Tally(const SelectionProblem& problem, const OptionSet& choice = {});

  void take(std::size_t option);
  /// What the score gains by one option more.
  [[nodiscard]] double gain(std::size_t option) const;
  [[nodiscard]] double score() const;
  /// As met_by().
  [[nodiscard]] double met(std::size_t element) const;

 private:
  [[nodiscard]] double worth_of_miss(std::size_t element, double miss) const;
  [[nodiscard]] double worth_of_reads(std::size_t element, double reads) const;
  [[nodiscard]] double worth_of_place(std::size_t element, const ToldSum& told) const;

  const SelectionProblem& problem_;
  // Of the three, by element, the one that the problem asks for.
  std::vector<double> miss_;
  std::vector<double> reads_;
  std::vector<ToldSum> told_;
};

}  // namespace tagfield
