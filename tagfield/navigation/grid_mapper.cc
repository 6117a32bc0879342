// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/grid_mapper.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/parallel.h"
#include "tagfield/base/random.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/resampling.h"

namespace tagfield {
namespace {

/// Least standard deviations of a step's prior: wheels may be wrong even when they report no
/// motion.
constexpr double kMinSigma_m = 0.002;
constexpr double kMinSigma_rad = 0.001;

/// Inverse covariance of the odometry's step in the map's axes.
Eigen::Matrix3d prior_information(const PlanarPose& from_M, const PlanarPose& increment,
                                  const OdometryNoise& noise) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = rotation_in_plane(from_M.yaw);
  Eigen::Matrix3d covariance = R * increment_covariance(increment, noise) * R.transpose();
  covariance.diagonal() += Eigen::Vector3d(kMinSigma_m * kMinSigma_m, kMinSigma_m * kMinSigma_m,
                                           kMinSigma_rad * kMinSigma_rad);
  return covariance.inverse();
}

/// When polishing, the map alone should determine the pose of a scan.
Eigen::Matrix3d loose_information() {
  return Eigen::Vector3d(1.0 / (0.1 * 0.1), 1.0 / (0.1 * 0.1), 1.0 / (0.05 * 0.05)).asDiagonal();
}

/// The map is good by then: points far from its surfaces belong to something else.
MatchOptions polishing(MatchOptions options) {
  options.search_cells = 2;
  options.outlier_m = 0.03;
  options.trust = 1.0;
  options.max_ends = MatchOptions{}.max_ends;
  return options;
}

/// A draw from N(match.pose, match.information⁻¹).
PlanarPose drawn_near(const ScanMatch& match, RandomStream& stream) {
  const auto [a, b] = standard_normal_pair(stream);
  const Eigen::Vector3d z(a, b, standard_normal(stream));
  // With information = L Lᵀ, L⁻ᵀ z has the covariance (L Lᵀ)⁻¹.
  const Eigen::LLT<Eigen::Matrix3d> factor(match.information);
  const Eigen::Vector3d d = factor.matrixU().solve(z);
  return {match.pose_M.x + d.x(), match.pose_M.y + d.y(), match.pose_M.yaw + d.z()};
}

/// The mean of poses that are near each other.
PlanarPose mean_of(const PlanarPose* poses, std::size_t count) {
  const PlanarPose& first = poses[0];
  PlanarPose sum;
  for (std::size_t i = 0; i < count; ++i) {
    const PlanarPose off = between(first, poses[i]);
    sum = {sum.x + off.x, sum.y + off.y, sum.yaw + off.yaw};
  }
  const auto n = static_cast<double>(count);
  return compose(first, {sum.x / n, sum.y / n, sum.yaw / n});
}

/// Whether the increment is within the jitter of wheels at rest.
bool stands(const PlanarPose& increment) {
  constexpr double kStill = 1e-3;  // [m, rad]
  return std::hypot(increment.x, increment.y) < kStill && std::abs(increment.yaw) < kStill;
}

}  // namespace

GridMapper::GridMapper(const MapperSettings& settings, const RigidTransform& X_RL,
                       const PlanarPose& start_M, std::uint64_t seed)
    : settings_(settings), X_RL_(X_RL), seed_(seed) {
  const Particle first{start_M, HitGrid(settings.resolution_m), {}, 0.0, 0.0};
  particles_.assign(static_cast<std::size_t>(std::max(settings.particles, 1)), first);
}

bool GridMapper::has_moved(const PlanarPose& increment) const {
  return std::hypot(increment.x, increment.y) >= settings_.update_distance_m ||
         std::abs(increment.yaw) >= settings_.update_turn_rad;
}

bool GridMapper::update(const LaserScan& scan, const PlanarPose& odometry) {
  if (!is_finite(odometry)) return false;
  const PlanarPose increment = updates_ == 0 ? PlanarPose{} : between(odometry_, odometry);
  const bool moved = has_moved(increment);
  const bool enough = updates_ >= static_cast<std::uint64_t>(settings_.first_scans);
  // Motion between the first scans would be lost, since they are entered at the starting pose.
  if (!moved && (enough || !stands(increment))) return false;
  const ScanPoints points = scan_points(scan, X_RL_, settings_.max_clear_m);
  if (points.ends_R.empty()) return false;
  const std::vector<Eigen::Vector2d> to_match = thinned(points.ends_R, settings_.point_spacing_m);
  parallel_for(particles_.size(), settings_.threads,
               [&](std::size_t i) { advance(particles_[i], i, increment, to_match, points); });
  if (still_at_start_ && !moved) ++start_scans_;
  still_at_start_ = still_at_start_ && !moved;
  scans_.push_back(points);
  odometry_ = odometry;
  ++updates_;
  normalize_weights();
  if (effective_particles() < 0.5 * static_cast<double>(particles_.size())) resample();
  return true;
}

void GridMapper::advance(Particle& particle, std::size_t index, const PlanarPose& increment,
                         const std::vector<Eigen::Vector2d>& points, const ScanPoints& scan) const {
  // While the robot stands at the start, all particles know their pose.
  if (has_moved(increment)) {
    const PlanarPose expected = compose(particle.pose_M, increment);
    const Eigen::Matrix3d prior = prior_information(particle.pose_M, increment, settings_.odometry);
    const ScanMatch match =
        match_scan(particle.map, points, expected, expected, prior, settings_.match);
    RandomStream stream(seed_, Purpose::kMapping, index, updates_);
    particle.pose_M = drawn_near(match, stream);
    // Laplace's approximation of ∫ p(scan | x, map) p(x | odometry) dx, without common factors.
    const double evidence =
        -match.cost + 0.5 * lane_log(prior.determinant() / match.information.determinant());
    particle.log_weight += evidence;
    particle.score += evidence;
  }
  particle.map.insert(scan, particle.pose_M);
  particle.path_M.push_back(particle.pose_M);
}

void GridMapper::polish(int sweeps) {
  if (updates_ == 0) return;
  Particle kept = best();
  const PlanarPose first = kept.path_M.front();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::vector<PlanarPose> path = kept.path_M;
    parallel_for(path.size(), settings_.threads, [&](std::size_t i) {
      const auto points = thinned(scans_[i].ends_R, settings_.point_spacing_m);
      path[i] = match_scan(kept.map, points, path[i], path[i], loose_information(),
                           polishing(settings_.match))
                    .pose_M;
    });
    // The map does not determine a motion common to all scans. The scans at the start, all made at
    // one pose, do, and more of them do so better.
    const PlanarPose back = compose(first, between(mean_of(path.data(), start_scans_), {}));
    HitGrid map(settings_.resolution_m);
    for (std::size_t i = 0; i < path.size(); ++i) {
      path[i] = compose(back, path[i]);
      map.insert(scans_[i], path[i]);
    }
    kept.map = std::move(map);
    kept.path_M = std::move(path);
  }
  kept.pose_M = kept.path_M.back();
  kept.log_weight = 0.0;
  particles_.assign(particles_.size(), kept);
  normalize_weights();
}

void GridMapper::normalize_weights() {
  double most = particles_.front().log_weight;
  for (const Particle& particle : particles_) most = std::max(most, particle.log_weight);
  double sum = 0.0;
  for (const Particle& particle : particles_) sum += lane_exp(particle.log_weight - most);
  const double norm = most + lane_log(sum);
  for (Particle& particle : particles_) particle.log_weight -= norm;
}

double GridMapper::effective_particles() const {
  double squares = 0.0;
  for (const Particle& particle : particles_) squares += lane_exp(2.0 * particle.log_weight);
  return 1.0 / squares;
}

void GridMapper::resample() {
  std::vector<double> log_weights;
  log_weights.reserve(particles_.size());
  for (const Particle& particle : particles_) log_weights.push_back(particle.log_weight);
  std::mt19937 generator =
      generator_of(RandomStream(seed_, Purpose::kMapping, particles_.size(), updates_));
  std::vector<Particle> next;
  next.reserve(particles_.size());
  for (const std::size_t i : systematic_resampling(log_weights, generator)) {
    next.push_back(particles_[i]);
  }
  particles_ = std::move(next);
  for (Particle& particle : particles_) particle.log_weight = 0.0;
  normalize_weights();
}

const GridMapper::Particle& GridMapper::best() const {
  return *std::max_element(particles_.begin(), particles_.end(),
                           [](const Particle& a, const Particle& b) { return a.score < b.score; });
}

Eigen::Matrix3d GridMapper::start_covariance() const {
  if (updates_ == 0) return Eigen::Matrix3d::Zero();
  const PlanarPose& start_M = best().path_M.front();
  const auto points = thinned(scans_.front().ends_R, settings_.point_spacing_m);
  return match_scan(best().map, points, start_M, start_M, loose_information(),
                    polishing(settings_.match))
      .information.inverse();
}

PlanarPose GridMapper::pose_at(const PlanarPose& odometry) const {
  if (updates_ == 0) return best().pose_M;
  return compose(best().pose_M, between(odometry_, odometry));
}

OccupancyGrid GridMapper::map() const { return best().map.to_occupancy(); }

const HitGrid& GridMapper::hits() const { return best().map; }

}  // namespace tagfield
