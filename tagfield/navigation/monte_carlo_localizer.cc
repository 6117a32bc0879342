// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/monte_carlo_localizer.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/base/lane_math.h"
#include "tagfield/base/trigonometry.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/likelihood_field.h"
#include "tagfield/navigation/pose_particles.h"
#include "tagfield/navigation/resampling.h"
#include "tagfield/navigation/scan_points.h"

namespace tagfield {
namespace {

/// Particles this near to each other form one hypothesis ("opinion").
constexpr double kCluster_m = 0.5;
constexpr double kCluster_rad = 0.35;
/// Number of opinions examined closely while searching.
constexpr std::size_t kOpinions = 40;
/// From time to time the whole map is searched on a lattice of these steps, and the best poses, up
/// to this number, are examined closely.
constexpr double kLattice_m = 0.4;
constexpr int kLatticeTurns = 24;
constexpr std::size_t kLatticeOpinions = 200;
constexpr int kLatticeEvery = 10;
/// Beyond this a point's distance from the walls no longer counts on the lattice.
constexpr double kLatticeReach_m = 0.6;
/// Found: the scan fits at least this well, by this much better than at any other pose, this many
/// times in a row,
constexpr double kGoodFit = 0.9;
constexpr double kBetterBy = 0.04;
constexpr int kGoodScans = 8;
/// and over this driving distance: turning on the spot shows nothing new.
constexpr double kGoodLength_m = 0.7;
/// Opinions that fit at least this well get more particles (sensor resetting: Lenser and Veloso,
/// 2000).
constexpr double kPromisingFit = 0.75;
constexpr int kMoreParticles = 100;
/// Lost: the fit is below this, this many times in a row.
constexpr double kBadFit = 0.5;
constexpr int kBadScans = 12;
/// A search that has found nothing after this many scans restarts.
constexpr int kPatience = 40;
/// Spread of the particles around a pose just found.
constexpr double kFoundSigma_m = 0.05;
constexpr double kFoundSigma_rad = 0.02;
/// Opinions are first brought within reach of the map's walls by matching a few points with a large
/// search radius.
constexpr double kCoarseSpacing_m = 0.25;
constexpr int kCoarseReach = 8;  ///< [cells]
/// Opinions that have come this near to each other are merged.
constexpr double kSame_m = 0.05;
constexpr double kSame_rad = 0.03;
/// An opinion that fits worse than this after that is not examined more closely.
constexpr double kHopelessFit = 0.4;
constexpr double kMinSpread_m = 0.002;
constexpr double kMinSpread_rad = 0.001;
/// A point this near to a wall lies on it.
constexpr double kOnWall_m = 0.1;
/// A beam crosses a wall if the wall is at least this far before its end.
constexpr double kCrossing_m = 0.4;

/// The map's walls as surfaces to match scans to: the centre of each occupied cell.
HitGrid walls_of(const OccupancyGrid& map) {
  HitGrid walls(map.resolution_m);
  ScanPoints ends;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (is_occupied(map.at(x, y))) ends.ends_R.push_back(map.centre_of(x, y));
    }
  }
  // Twice, since a single endpoint makes no wall.
  walls.add_ends(ends.ends_R);
  walls.add_ends(ends.ends_R);
  return walls;
}

std::vector<float> wall_distances(const OccupancyGrid& map) {
  std::vector<bool> occupied;
  occupied.reserve(map.cells.size());
  for (const std::int8_t cell : map.cells) occupied.push_back(is_occupied(cell));
  return distance_field(map, occupied, 1.0);
}

double squared(double x) { return x * x; }

Eigen::Matrix3d diagonal_covariance(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(squared(sigma_m), squared(sigma_m), squared(sigma_rad)).asDiagonal();
}
Eigen::Matrix3d least_covariance() { return diagonal_covariance(kMinSpread_m, kMinSpread_rad); }
Eigen::Matrix3d found_covariance() { return diagonal_covariance(kFoundSigma_m, kFoundSigma_rad); }

bool are_within(const PlanarPose& a, const PlanarPose& b, double max_m, double max_rad) {
  return (position_of(a) - position_of(b)).norm() < max_m &&
         std::abs(wrap_to_pi(a.yaw - b.yaw)) < max_rad;
}

bool are_near(const PlanarPose& a, const PlanarPose& b) {
  return are_within(a, b, kCluster_m, kCluster_rad);
}

void require_usable(const OccupancyGrid& map) {
  if (std::none_of(map.cells.begin(), map.cells.end(), is_occupied)) {
    throw Error("the map has no occupied cell, so nothing on it can be recognized");
  }
  if (std::none_of(map.cells.begin(), map.cells.end(), is_free)) {
    throw Error("the map has no free cell, so a robot can't be on it");
  }
}

}  // namespace

struct MonteCarloLocalizer::Impl {
  LocalizerSettings settings;
  RigidTransform X_RL;
  std::uint64_t seed;
  OccupancyGrid map;
  HitGrid walls;
  std::vector<float> wall_distance;
  LikelihoodField tracking_field;   ///< Weights particles when tracking,
  LikelihoodField searching_field;  ///< and when searching, where they are sparse.
  std::vector<PoseParticle> particles = {};
  std::uint64_t draws = 0;
  bool has_odometry = false;
  PlanarPose odometry = {};  ///< At the last scan that was used.
  PoseEstimate estimate = {};
  Localization state = Localization::kSearching;
  double fit = 0.0;
  int good_scans = 0;
  int bad_scans = 0;
  double good_length_m = 0.0;
  double way_m = 0.0;  ///< Driven since the previous scan.
  int searching_scans = 0;
  int times_lost = 0;

  std::mt19937 random() {
    return generator_of(RandomStream(seed, Purpose::kLocalization, draws++));
  }

  void use(Localization next);
  void search();
  bool update(const LaserScan& scan, const PlanarPose& now);
  void filter_scan(const LaserScan& scan, const PlanarPose& increment);
  [[nodiscard]] PoseEstimate mean_near(PlanarPose centre) const;
  [[nodiscard]] std::vector<PlanarPose> opinions() const;
  [[nodiscard]] std::vector<PlanarPose> lattice_opinions(
      const std::vector<Eigen::Vector2d>& points) const;
  [[nodiscard]] PoseEstimate refined(const PoseEstimate& rough,
                                     const std::vector<Eigen::Vector2d>& points) const;
  [[nodiscard]] std::vector<PlanarPose> approached(const std::vector<PlanarPose>& opinions,
                                                   const std::vector<Eigen::Vector2d>& few) const;
  [[nodiscard]] std::vector<std::pair<double, PoseEstimate>> settled(
      const std::vector<PlanarPose>& opinions, const std::vector<Eigen::Vector2d>& points) const;
  [[nodiscard]] bool crosses_wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  [[nodiscard]] double fit_at(const PlanarPose& pose,
                              const std::vector<Eigen::Vector2d>& points) const;
  void track(const std::vector<Eigen::Vector2d>& points);
  void look_around(const std::vector<Eigen::Vector2d>& points);
  void scatter(const PoseEstimate& around, int count, double log_weight);
};

void MonteCarloLocalizer::Impl::use(Localization next) {
  state = next;
  good_scans = bad_scans = searching_scans = 0;
}

void MonteCarloLocalizer::Impl::search() {
  std::mt19937 generator = random();
  particles = spread_over_free(map, settings.first_particles, generator);
  use(Localization::kSearching);
}

void MonteCarloLocalizer::Impl::filter_scan(const LaserScan& scan, const PlanarPose& increment) {
  const bool tracking = state == Localization::kTracking;
  const KldOptions kld{tracking ? settings.min_particles : settings.min_searching,
                       settings.max_particles, settings.bin_m, settings.bin_rad};
  std::mt19937 generator = random();
  particles = drawn_and_moved(
      particles, {increment, increment_covariance(increment, settings.odometry)}, kld, generator);
  weigh(particles, tracking ? tracking_field : searching_field,
        sparse_ends(scan, X_RL, settings.beams, 0.5 * map.resolution_m),
        tracking ? settings.trust : settings.search_trust);
}

/// Mean and covariance of the particles near to `centre`.
PoseEstimate MonteCarloLocalizer::Impl::mean_near(PlanarPose centre) const {
  Eigen::Vector3d mean;
  Eigen::Matrix3d squares;
  for (int i = 0; i < 3; ++i) {
    double weight = 0.0;
    mean.setZero();
    squares.setZero();
    for (const PoseParticle& particle : particles) {
      const PlanarPose& q = particle.pose_M;
      const Eigen::Vector3d d(q.x - centre.x, q.y - centre.y, wrap_to_pi(q.yaw - centre.yaw));
      if (d.head<2>().norm() > kCluster_m || std::abs(d.z()) > kCluster_rad) continue;
      const double w = lane_exp(particle.log_weight);
      weight += w;
      mean += w * d;
      squares += w * d * d.transpose();
    }
    if (!(weight > 0.0)) return {centre, found_covariance()};
    mean /= weight;
    squares = squares / weight - mean * mean.transpose();
    centre = {centre.x + mean.x(), centre.y + mean.y(), wrap_to_pi(centre.yaw + mean.z())};
  }
  return {centre, squares};
}

/// The poses where most of the particles' weight is, heaviest first.
std::vector<PlanarPose> MonteCarloLocalizer::Impl::opinions() const {
  struct Bin {
    double weight = 0.0;
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();  ///< x, y, cos, sin of the yaw.
  };
  std::map<std::array<int, 3>, Bin> bins;
  const auto cell = [](double value, double size) {
    return static_cast<int>(std::floor(value / size));
  };
  for (const PoseParticle& particle : particles) {
    const PlanarPose& q = particle.pose_M;
    Bin& bin = bins[{cell(q.x, kCluster_m), cell(q.y, kCluster_m),
                     cell(wrap_to_two_pi(q.yaw), kCluster_rad)}];
    const double w = lane_exp(particle.log_weight);
    bin.weight += w;
    bin.sum += w * Eigen::Vector4d(q.x, q.y, cosine(q.yaw), sine(q.yaw));
  }
  std::vector<Bin> sorted;
  sorted.reserve(bins.size());
  for (const auto& [place, bin] : bins) sorted.push_back(bin);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Bin& a, const Bin& b) { return a.weight > b.weight; });
  if (sorted.size() > kOpinions) sorted.resize(kOpinions);
  std::vector<PlanarPose> poses;
  poses.reserve(sorted.size());
  for (const Bin& bin : sorted) {
    const Eigen::Vector4d mean = bin.sum / bin.weight;
    poses.push_back({mean.x(), mean.y(), arc_tangent(mean.w(), mean.z())});
  }
  return poses;
}

/// The poses of a lattice over all free space that a scan fits best, by the mean distance of its
/// endpoints from the walls.
std::vector<PlanarPose> MonteCarloLocalizer::Impl::lattice_opinions(
    const std::vector<Eigen::Vector2d>& points) const {
  const std::vector<Eigen::Vector2d> few = thinned(points, kCoarseSpacing_m);
  const int step = std::max(1, static_cast<int>(std::lround(kLattice_m / map.resolution_m)));
  std::vector<std::pair<double, PlanarPose>> places;
  for (int turn = 0; turn < kLatticeTurns; ++turn) {
    const PlanarPose turned{0.0, 0.0, turn * kTwoPi / kLatticeTurns};
    std::vector<Eigen::Vector2d> ends;
    ends.reserve(few.size());
    for (const Eigen::Vector2d& p_R : few) ends.push_back(transformed(turned, p_R));
    for (int y = 0; y < map.height; y += step) {
      for (int x = 0; x < map.width; x += step) {
        if (!is_free(map.at(x, y))) continue;
        const Eigen::Vector2d at = map.centre_of(x, y);
        double sum = 0.0;
        for (const Eigen::Vector2d& end : ends) {
          const Eigen::Vector2i cell = map.cell_of(at + end);
          const bool inside = map.contains(cell.x(), cell.y());
          const double away =
              inside ? wall_distance[map.index(cell.x(), cell.y())] : kLatticeReach_m;
          sum += std::min(away, kLatticeReach_m);
        }
        places.push_back({sum, {at.x(), at.y(), turned.yaw}});
      }
    }
  }
  const std::size_t count = std::min(places.size(), kLatticeOpinions);
  std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count),
                    places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PlanarPose> best;
  best.reserve(count);
  for (std::size_t i = 0; i < count; ++i) best.push_back(places[i].second);
  return best;
}

/// Refines an estimate to better than the particles' spread.
PoseEstimate MonteCarloLocalizer::Impl::refined(const PoseEstimate& rough,
                                                const std::vector<Eigen::Vector2d>& points) const {
  const ScanMatch match =
      match_scan(walls, points, rough.pose_M, rough.pose_M,
                 (rough.covariance + least_covariance()).inverse(), settings.match);
  return {match.pose_M, match.information.inverse()};
}

/// Opinions, each brought within reach of the walls, without those that thereby coincide.
std::vector<PlanarPose> MonteCarloLocalizer::Impl::approached(
    const std::vector<PlanarPose>& opinions, const std::vector<Eigen::Vector2d>& few) const {
  const Eigen::Matrix3d loose = diagonal_covariance(kCluster_m, kCluster_rad).inverse();
  MatchOptions coarse = settings.match;
  coarse.iterations = 6;
  coarse.search_cells = kCoarseReach;
  coarse.outlier_m = 0.3;
  coarse.sigma_m = 0.1;
  std::vector<PlanarPose> places;
  for (const PlanarPose& opinion : opinions) {
    const PlanarPose place = match_scan(walls, few, opinion, opinion, loose, coarse).pose_M;
    const bool is_new = std::none_of(places.begin(), places.end(), [&](const PlanarPose& other) {
      return are_within(place, other, kSame_m, kSame_rad);
    });
    if (is_new) places.push_back(place);
  }
  return places;
}

/// The poses that opinions converge to and how well each fits, best first.
std::vector<std::pair<double, PoseEstimate>> MonteCarloLocalizer::Impl::settled(
    const std::vector<PlanarPose>& opinions, const std::vector<Eigen::Vector2d>& points) const {
  const std::vector<Eigen::Vector2d> few = thinned(points, kCoarseSpacing_m);
  std::vector<std::pair<double, PoseEstimate>> settled;
  for (const PlanarPose& place : approached(opinions, few)) {
    const double rough_fit = fit_at(place, few);
    settled.emplace_back(rough_fit, PoseEstimate{place, found_covariance()});
    if (rough_fit < kHopelessFit) continue;
    auto& [fits, near] = settled.back();
    near = refined(near, points);
    fits = fit_at(near.pose_M, points);
  }
  std::stable_sort(settled.begin(), settled.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  return settled;
}

/// Whether the line from `from` to `to` crosses an occupied cell before it is near its end.
bool MonteCarloLocalizer::Impl::crosses_wall(const Eigen::Vector2d& from,
                                             const Eigen::Vector2d& to) const {
  const Eigen::Vector2d all = to - from;
  const double whole = all.norm();
  const double length = whole - kCrossing_m;
  if (!(length > 0.0)) return false;
  const Eigen::Vector2d direction = all / whole;
  for (double way = 0.0; way < length;) {
    const Eigen::Vector2i cell = map.cell_of(from + way * direction);
    if (!map.contains(cell.x(), cell.y())) return false;
    const double clear = wall_distance[map.index(cell.x(), cell.y())];
    if (clear < 0.5 * map.resolution_m) return true;
    // Nothing is nearer than this, up to half a cell at either end.
    way += std::max(clear - map.resolution_m, 0.5 * map.resolution_m);
  }
  return false;
}

/// How well a scan fits the map from `pose`: the fraction of its endpoints that lie on walls minus
/// the fraction of beams that crossed one. Objects that are not on the map reduce the first, but
/// only a wrong pose raises the second.
double MonteCarloLocalizer::Impl::fit_at(const PlanarPose& pose,
                                         const std::vector<Eigen::Vector2d>& points) const {
  const Eigen::Vector2d from = transformed(pose, X_RL.translation.head<2>());
  int score = 0;
  for (const Eigen::Vector2d& p_R : points) {
    const Eigen::Vector2d p = transformed(pose, p_R);
    const Eigen::Vector2i cell = map.cell_of(p);
    const bool on_wall = map.contains(cell.x(), cell.y()) &&
                         wall_distance[map.index(cell.x(), cell.y())] <= kOnWall_m;
    score += static_cast<int>(on_wall) - static_cast<int>(crosses_wall(from, p));
  }
  return score / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

void MonteCarloLocalizer::Impl::track(const std::vector<Eigen::Vector2d>& points) {
  estimate = refined(mean_near(estimate.pose_M), points);
  fit = fit_at(estimate.pose_M, points);
  bad_scans = fit < kBadFit ? bad_scans + 1 : 0;
  if (bad_scans < kBadScans) return;
  ++times_lost;
  search();
}

/// Examines the current opinions; the robot is found if exactly one of them fits.
void MonteCarloLocalizer::Impl::look_around(const std::vector<Eigen::Vector2d>& points) {
  const PlanarPose expected = estimate.pose_M;
  double heaviest = particles.front().log_weight;
  for (const PoseParticle& particle : particles) heaviest = std::max(heaviest, particle.log_weight);
  std::vector<PlanarPose> to_see = opinions();
  // Always before it is found: a place that looks like this one may have no particles left.
  if (searching_scans % kLatticeEvery == 0 || good_scans + 1 >= kGoodScans) {
    const std::vector<PlanarPose> more = lattice_opinions(points);
    to_see.insert(to_see.end(), more.begin(), more.end());
  }
  const std::vector<std::pair<double, PoseEstimate>> seen = settled(to_see, points);
  fit = seen.front().first;
  estimate = seen.front().second;
  const bool alone = std::none_of(seen.begin(), seen.end(), [&](const auto& other) {
    return other.first > fit - kBetterBy && !are_near(other.second.pose_M, estimate.pose_M);
  });
  const bool good = fit >= kGoodFit && alone;
  const bool same = are_near(expected, estimate.pose_M);
  good_scans = !good ? 0 : same ? good_scans + 1 : 1;
  good_length_m = good_scans > 1 ? good_length_m + way_m : 0.0;
  if (good_scans >= kGoodScans && good_length_m >= kGoodLength_m) {
    particles.clear();
    scatter({estimate.pose_M, found_covariance()}, 2 * settings.min_particles, 0.0);
    use(Localization::kTracking);
  } else if (++searching_scans >= kPatience) {
    search();
  } else {
    for (std::size_t i = 0; i < std::min(seen.size(), kOpinions); ++i) {
      const auto& [fits, place] = seen[i];
      if (fits < kPromisingFit) break;
      scatter({place.pose_M, found_covariance()}, kMoreParticles, heaviest);
    }
  }
}

/// Adds particles around a pose.
void MonteCarloLocalizer::Impl::scatter(const PoseEstimate& around, int count, double log_weight) {
  RandomStream stream(seed, Purpose::kLocalization, draws++, 1);
  const Eigen::Matrix3d L = (around.covariance + least_covariance()).llt().matrixL();
  for (int i = 0; i < count; ++i) {
    const auto [a, b] = standard_normal_pair(stream);
    const Eigen::Vector3d d = L * Eigen::Vector3d(a, b, standard_normal(stream));
    const PlanarPose& q = around.pose_M;
    particles.push_back({{q.x + d.x(), q.y + d.y(), q.yaw + d.z()}, log_weight});
  }
}

bool MonteCarloLocalizer::Impl::update(const LaserScan& scan, const PlanarPose& now) {
  if (!is_finite(now)) return false;
  const PlanarPose increment = has_odometry ? between(odometry, now) : PlanarPose{};
  const bool moved = std::hypot(increment.x, increment.y) >= settings.update_distance_m ||
                     std::abs(increment.yaw) >= settings.update_turn_rad;
  if (has_odometry && !moved) return false;
  const std::vector<Eigen::Vector2d> ends = scan_points(scan, X_RL, 0.0).ends_R;
  if (ends.empty()) return false;
  filter_scan(scan, increment);
  way_m = std::hypot(increment.x, increment.y);
  has_odometry = true;
  odometry = now;
  estimate.pose_M = compose(estimate.pose_M, increment);
  const std::vector<Eigen::Vector2d> points = thinned(ends, settings.point_spacing_m);
  if (state == Localization::kTracking) {
    track(points);
  } else {
    look_around(points);
  }
  return true;
}

MonteCarloLocalizer::MonteCarloLocalizer(const OccupancyGrid& map,
                                         const LocalizerSettings& settings,
                                         const RigidTransform& X_RL, std::uint64_t seed,
                                         const HitGrid* walls) {
  require_usable(map);
  impl_ = std::make_unique<Impl>(Impl{
      settings, X_RL, seed, map, walls != nullptr ? *walls : walls_of(map), wall_distances(map),
      LikelihoodField(map, settings.sigma_hit_m), LikelihoodField(map, settings.search_sigma_m)});
  impl_->search();
}

MonteCarloLocalizer::~MonteCarloLocalizer() = default;
MonteCarloLocalizer::MonteCarloLocalizer(MonteCarloLocalizer&&) noexcept = default;
MonteCarloLocalizer& MonteCarloLocalizer::operator=(MonteCarloLocalizer&&) noexcept = default;

void MonteCarloLocalizer::start_at(const PoseEstimate& start) {
  Impl& impl = *impl_;
  if (!Eigen::Vector3d(start.pose_M.x, start.pose_M.y, start.pose_M.yaw).allFinite() ||
      !start.covariance.allFinite()) {
    throw Error("the starting pose and its covariance must be finite");
  }
  impl.particles.clear();
  impl.scatter(start, 2 * impl.settings.min_particles, 0.0);
  impl.estimate = start;
  impl.has_odometry = false;
  impl.use(Localization::kTracking);
}

void MonteCarloLocalizer::start_anywhere() {
  impl_->has_odometry = false;
  impl_->search();
}

bool MonteCarloLocalizer::update(const LaserScan& scan, const PlanarPose& odometry) {
  return impl_->update(scan, odometry);
}

PoseEstimate MonteCarloLocalizer::estimate_at(const PlanarPose& odometry) const {
  const Impl& impl = *impl_;
  if (!impl.has_odometry) return impl.estimate;
  const PlanarPose increment = between(impl.odometry, odometry);
  PoseEstimate moved;
  moved.pose_M = compose(impl.estimate.pose_M, increment);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = rotation_in_plane(impl.estimate.pose_M.yaw);
  moved.covariance = impl.estimate.covariance +
                     R * increment_covariance(increment, impl.settings.odometry) * R.transpose();
  return moved;
}

Localization MonteCarloLocalizer::state() const { return impl_->state; }
double MonteCarloLocalizer::fit() const { return impl_->fit; }
int MonteCarloLocalizer::times_lost() const { return impl_->times_lost; }

std::vector<PlanarPose> MonteCarloLocalizer::particles() const {
  std::vector<PlanarPose> poses;
  poses.reserve(impl_->particles.size());
  for (const PoseParticle& particle : impl_->particles) poses.push_back(particle.pose_M);
  return poses;
}

}  // namespace tagfield
