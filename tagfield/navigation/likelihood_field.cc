// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/likelihood_field.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr float kHit = 0.9F;
constexpr float kNotOnMap = 0.1F / 3.0F;  // [1/m]
constexpr double kReach = 4.0;            // [σ]

/// Squared distances from the nearest occupied cell, capped at that of `max_m` [cells²].
std::vector<long> squared_distances(const OccupancyGrid& map, double max_m) {
  std::vector<bool> occupied;
  occupied.reserve(map.cells.size());
  for (const std::int8_t cell : map.cells) occupied.push_back(is_occupied(cell));
  std::vector<long> squares;
  squares.reserve(occupied.size());
  for (const float distance : distance_field(map, occupied, max_m)) {
    const double cells = static_cast<double>(distance) / map.resolution_m;
    squares.push_back(std::lrint(cells * cells));
  }
  return squares;
}

}  // namespace

CellFrame::CellFrame(const OccupancyGrid& map)
    : resolution_m(static_cast<float>(map.resolution_m)),
      origin(resolution_m * (map.origin.cast<float>() / resolution_m).array().round().matrix()) {}

Eigen::Vector2f CellFrame::centre_of(int x, int y) const {
  return {origin.x() + (static_cast<float>(x) + 0.5F) * resolution_m,
          origin.y() + (static_cast<float>(y) + 0.5F) * resolution_m};
}

LikelihoodField::LikelihoodField(const OccupancyGrid& map, double sigma_m)
    : frame_(map), width_(map.width), height_(map.height) {
  const auto sigma = static_cast<float>(sigma_m);
  const float falloff = -0.5F / (sigma * sigma);
  const double cell_m = frame_.resolution_m;
  logs_.reserve(map.cells.size());
  for (const long square : squared_distances(map, kReach * sigma_m)) {
    const auto square_m2 = static_cast<float>(static_cast<double>(square) * cell_m * cell_m);
    const float likelihood =
        kNotOnMap + kHit * static_cast<float>(lane_exp(static_cast<double>(falloff * square_m2)));
    logs_.push_back(lane_log(static_cast<double>(likelihood)));
  }
  const auto reach = static_cast<float>(kReach * sigma_m);
  off_map_ = std::log(kNotOnMap + kHit * std::exp(static_cast<double>(falloff) * (reach * reach)));
}

double LikelihoodField::log_at(double x, double y) const {
  // The order of min and max turns NaN into 1e9, so no conversion overflows.
  const auto whole = [&](double cells) {
    return static_cast<int>(std::max(-1.0, std::min(1e9, cells)));
  };
  const int column = whole((x - frame_.origin.x()) / frame_.resolution_m);
  const int row = whole((y - frame_.origin.y()) / frame_.resolution_m);
  if (column < 0 || row < 0 || column >= width_ - 1 || row >= height_ - 1) return off_map_;
  return logs_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(column)];
}

double LikelihoodField::log_likelihood(const PlanarPose& pose_M,
                                       const std::vector<Eigen::Vector2f>& ends_R) const {
  const auto [s, c] = sine_cosine(wrap_to_pi(pose_M.yaw));
  double sum = 0.0;
  for (const Eigen::Vector2f& end_R : ends_R) {
    const Eigen::Vector2d p = end_R.cast<double>();
    sum += log_at(pose_M.x + p.x() * c - p.y() * s, pose_M.y + p.x() * s + p.y() * c);
  }
  return sum;
}

}  // namespace tagfield
