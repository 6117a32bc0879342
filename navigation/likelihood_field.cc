#include "navigation/likelihood_field.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr float kHit = 0.9F;
constexpr float kNotOnMap = 0.1F / 3.0F;  // [1/m]
constexpr float kReach = 4.0F;            // [σ]

}  // namespace

LikelihoodField::LikelihoodField(const OccupancyGrid& map, double sigma_m)
    : width_(static_cast<unsigned>(map.width)),
      height_(static_cast<unsigned>(map.height)),
      resolution_m_(static_cast<float>(map.resolution_m)) {
  const auto whole = [&](double x) {
    return resolution_m_ * std::round(static_cast<float>(x) / resolution_m_);
  };
  origin_ = {whole(map.origin.x()), whole(map.origin.y())};
  std::vector<bool> occupied;
  for (const std::int8_t cell : map.cells) occupied.push_back(is_occupied(cell));
  const auto sigma = static_cast<float>(sigma_m);
  const float reach = static_cast<float>(4.0 * sigma_m);
  const double res = resolution_m_;
  const double Q = -0.5F / (sigma * sigma);
  const double per = 100 / (res * res);
  const double inv = 1.0 / per;
  const double reach2 = reach * reach;
  const long cap = std::lrint(reach2 * per);
  for (const float d : distance_field(map, occupied, reach + 2.0 * map.resolution_m)) {
    const double cells = static_cast<double>(d) / map.resolution_m;
    const long n = std::min(100 * std::lrint(cells * cells), cap);
    const float d2 = static_cast<float>(static_cast<double>(n) * inv);
    const float lik = kNotOnMap + kHit * std::exp(static_cast<float>(Q) * d2);
    logs_.push_back(std::log(static_cast<double>(lik)));
  }
  outside_ =
      std::log(static_cast<double>(kNotOnMap) + static_cast<double>(kHit) * std::exp(Q * reach2));
}

double LikelihoodField::log_likelihood(const PlanarPose& pose_M,
                                       const std::vector<Eigen::Vector2f>& ends_R) const {
  const double c = std::cos(wrap_to_pi(pose_M.yaw));
  const double s = std::sin(wrap_to_pi(pose_M.yaw));
  double sum = 0.0;
  for (const Eigen::Vector2f& end_R : ends_R) {
    const double px = end_R.x();
    const double py = end_R.y();
    const double gx = pose_M.x + px * c - py * s;
    const double gy = pose_M.y + px * s + py * c;
    const auto x = static_cast<unsigned>(static_cast<int>((gx - origin_.x()) / resolution_m_));
    const auto y = static_cast<unsigned>(static_cast<int>((gy - origin_.y()) / resolution_m_));
    const bool inside = x < width_ - 1 && y < height_ - 1;
    sum += inside ? logs_[x + static_cast<std::size_t>(y) * width_] : outside_;
  }
  return sum;
}

}  // namespace tagfield
