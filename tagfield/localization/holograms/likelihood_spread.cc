// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/likelihood_spread.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tagfield {
namespace {

using Eigen::Vector3d;

constexpr double kFirstHalf = 0.45;  ///< Half of the first box's sides [m].
constexpr double kHalfSide = 4.5;    ///< Half of the later boxes' sides [standard deviations].
constexpr double kMinHalf = 1e-4;    ///< [m]
constexpr int kMaxBoxes = 6;

/// Cells of a box, an odd number along each axis.
struct Box {
  Vector3d middle;
  Vector3d half;
  Eigen::Array3i cells;
  [[nodiscard]] Vector3d step() const {
    return (2.0 * half.array() / (cells.cast<double>() - 1.0).max(1.0)).matrix();
  }
};

std::vector<Vector3d> places_of(const Box& box) {
  std::vector<Vector3d> places;
  places.reserve(static_cast<std::size_t>(box.cells.prod()));
  const Vector3d step = box.step();
  const Eigen::Array3i about = (box.cells - 1) / 2;
  for (int i = -about.x(); i <= about.x(); ++i) {
    for (int j = -about.y(); j <= about.y(); ++j) {
      for (int k = -about.z(); k <= about.z(); ++k) {
        places.emplace_back(box.middle + Vector3d(i * step.x(), j * step.y(), k * step.z()));
      }
    }
  }
  return places;
}

/// Fine enough for lobes of a twentieth of a wavelength, of which the first box contains many.
Box first_about(const Vector3d& start, bool level) {
  const Eigen::Array3i cells = level ? Eigen::Array3i(91, 91, 1) : Eigen::Array3i(31, 31, 15);
  return {start, {kFirstHalf, kFirstHalf, level ? 0.0 : kFirstHalf}, cells};
}

std::vector<double> tempered(std::vector<double> logs, double doubt) {
  for (double& log : logs) log /= doubt;
  return logs;
}

/// Spread from the logarithms at each cell of a box.
LikelihoodSpread over(const Box& box, const std::vector<double>& logs) {
  const std::vector<Vector3d> places = places_of(box);
  LikelihoodSpread spread;
  spread.log_peak = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double weight = std::exp(logs[i] - spread.log_peak);
    const Vector3d apart = places[i] - box.middle;
    sum += weight;
    spread.mean += weight * apart;
    squares += weight * apart * apart.transpose();
  }
  spread.mean /= sum;
  spread.covariance = squares / sum - spread.mean * spread.mean.transpose();
  const Vector3d step = box.step();
  for (int axis = 0; axis < 3; ++axis) {
    if (box.cells[axis] > 1) spread.covariance(axis, axis) += step[axis] * step[axis] / 12.0;
  }
  spread.mean += box.middle;
  double cell = 1.0;
  for (int axis = 0; axis < 3; ++axis) cell *= box.cells[axis] > 1 ? step[axis] : 1.0;
  spread.log_mass = spread.log_peak + std::log(sum * cell);
  return spread;
}

}  // namespace

Climbed climbed(const LogLikelihood& likelihood, const Eigen::Vector3d& start) {
  constexpr double kFirstStep = 0.08, kLastStep = 0.001;  // [m]
  constexpr int kMaxMoves = 200;
  Climbed best{start, 0.0};
  int moves = 0;
  for (double step = kFirstStep; step > kLastStep && moves < kMaxMoves; ++moves) {
    const std::vector<Vector3d> around =
        places_of({best.place, Vector3d::Constant(step), {3, 3, 3}});
    const std::vector<double> logs = by_tiles(around, likelihood);
    const auto top =
        static_cast<std::size_t>(std::max_element(logs.begin(), logs.end()) - logs.begin());
    const std::size_t middle = around.size() / 2;
    if (logs[top] > logs[middle]) {
      best = {around[top], logs[top]};
    } else {
      best.log = logs[middle];
      step /= 2.0;
    }
  }
  return best;
}

FirstBox first_box(const LogLikelihood& likelihood, const Vector3d& start, bool level) {
  return {start, level, by_tiles(places_of(first_about(start, level)), likelihood)};
}

LikelihoodSpread likelihood_spread(const LogLikelihood& likelihood, const FirstBox& first,
                                   double doubt) {
  const Eigen::Array3i next = first.level ? Eigen::Array3i(31, 31, 1) : Eigen::Array3i(15, 15, 15);
  Box box = first_about(first.start, first.level);
  LikelihoodSpread spread = over(box, tempered(first.logs, doubt));
  for (int i = 1; i < kMaxBoxes; ++i) {
    const Vector3d deviation = spread.covariance.diagonal().cwiseSqrt();
    const Vector3d half = (kHalfSide * deviation).cwiseMax(kMinHalf).cwiseMin(box.half);
    if ((half.head<2>().array() > 0.4 * box.half.head<2>().array()).all()) break;
    box = {spread.mean, half, next};
    if (first.level) box.half.z() = 0.0;
    spread = over(box, tempered(by_tiles(places_of(box), likelihood), doubt));
  }
  return spread;
}

std::vector<double> greatest_about(const LikelihoodSpread& spread, double deviations,
                                   const std::vector<LogLikelihood>& all) {
  constexpr double kLeast = 0.01;  // [m]
  Vector3d half = deviations * spread.covariance.diagonal().cwiseSqrt();
  Eigen::Array3i cells(31, 31, 1);
  const bool level = half.z() <= 0.0;
  if (!level) cells = {15, 15, 15};
  for (int axis = 0; axis < (level ? 2 : 3); ++axis) half[axis] = std::max(half[axis], kLeast);
  const std::vector<Vector3d> places = places_of({spread.mean, half, cells});
  std::vector<double> greatest;
  greatest.reserve(all.size());
  for (const LogLikelihood& one : all) {
    const std::vector<double> logs = by_tiles(places, one);
    greatest.push_back(*std::max_element(logs.begin(), logs.end()));
  }
  return greatest;
}

}  // namespace tagfield
