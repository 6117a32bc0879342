// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/internal/tally.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tagfield {

InformationSum InformationSum::with(const PositionInformation& one) const {
  const bool tells = one.xx + one.yy > 0.0F;
  return {xx + static_cast<double>(one.xx), xy + static_cast<double>(one.xy),
          yy + static_cast<double>(one.yy), antennas + (tells ? 1 : 0)};
}

double InformationSum::error_m() const {
  if (antennas < kFewestForPlace) return std::numeric_limits<double>::infinity();
  const double determinant = xx * yy - xy * xy;
  const double trace = xx + yy;
  // With information in only one direction, the determinant is nothing but rounding error.
  if (!(determinant > 1e-12 * trace * trace)) return std::numeric_limits<double>::infinity();
  return std::sqrt(trace / determinant);
}

Tally::Tally(const SelectionProblem& problem, const OptionSet& choice) : problem_(problem) {
  const std::size_t elements = problem.elements.size();
  switch (problem.worth) {
    case Worth::kProbability:
      miss_.assign(elements, 1.0);
      break;
    case Worth::kReads:
      reads_.assign(elements, 0.0);
      break;
    case Worth::kPlace:
      information_.resize(elements);
      break;
  }
  for (const std::size_t option : choice) take(option);
}

void Tally::take(std::size_t option) {
  const SelectionOption& taken = problem_.options[option];
  switch (problem_.worth) {
    case Worth::kProbability:
      for (const Miss& one : taken.misses) {
        miss_[one.element] *= static_cast<double>(one.probability);
      }
      break;
    case Worth::kReads:
      for (const ReadsOf& one : taken.reads) {
        reads_[one.element] += static_cast<double>(one.reads);
      }
      break;
    case Worth::kPlace:
      for (const PositionInformation& one : taken.information) {
        information_[one.element] = information_[one.element].with(one);
      }
      break;
  }
}

double Tally::gain(std::size_t option) const {
  const SelectionOption& other = problem_.options[option];
  double gain = 0.0;
  switch (problem_.worth) {
    case Worth::kProbability:
      for (const Miss& one : other.misses) {
        const double before = miss_[one.element];
        const double after = before * static_cast<double>(one.probability);
        gain += worth_of_miss(one.element, after) - worth_of_miss(one.element, before);
      }
      break;
    case Worth::kReads:
      for (const ReadsOf& one : other.reads) {
        const double before = reads_[one.element];
        const double after = before + static_cast<double>(one.reads);
        gain += worth_of_reads(one.element, after) - worth_of_reads(one.element, before);
      }
      break;
    case Worth::kPlace:
      for (const PositionInformation& one : other.information) {
        const InformationSum& before = information_[one.element];
        gain += worth_of_place(one.element, before.with(one)) - worth_of_place(one.element, before);
      }
      break;
  }
  return gain;
}

double Tally::score() const {
  double score = 0.0;
  for (std::size_t i = 0; i < problem_.elements.size(); ++i) {
    switch (problem_.worth) {
      case Worth::kProbability:
        score += worth_of_miss(i, miss_[i]);
        break;
      case Worth::kReads:
        score += worth_of_reads(i, reads_[i]);
        break;
      case Worth::kPlace:
        score += worth_of_place(i, information_[i]);
        break;
    }
  }
  return score;
}

double Tally::met(std::size_t element) const {
  constexpr double kRounding = 1e-9;
  switch (problem_.worth) {
    case Worth::kProbability:
      return 1.0 - miss_[element];
    case Worth::kReads:
      return reads_[element] >= problem_.cap - kRounding ? 1.0 : 0.0;
    case Worth::kPlace:
      return information_[element].error_m() <= problem_.error_m ? 1.0 : 0.0;
  }
  return 0.0;
}

double Tally::worth_of_miss(std::size_t element, double miss) const {
  return problem_.elements[element].weight * std::min(1.0 - miss, problem_.cap) / problem_.cap;
}

double Tally::worth_of_reads(std::size_t element, double reads) const {
  return problem_.elements[element].weight * (std::min(reads, problem_.cap) / problem_.cap);
}

double Tally::worth_of_place(std::size_t element, const InformationSum& sum) const {
  const double before = 1.0 / (problem_.spread_m * problem_.spread_m);
  const double aim = 8.0 / (problem_.error_m * problem_.error_m);
  const double xx = sum.xx + before;
  const double yy = sum.yy + before;
  const double gained = std::log((xx * yy - sum.xy * sum.xy) / (before * before));
  return problem_.elements[element].weight * std::min(1.0, gained / (2.0 * std::log(aim / before)));
}

}  // namespace tagfield
