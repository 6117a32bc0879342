#include "navigation/monte_carlo_localizer.h"

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "navigation/internal/mrpt_conversions.h"
#include "navigation/internal/mrpt_random.h"
#include "navigation/scan_points.h"
#include "tagfield/base/error.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// Particles this near to the best one are of one opinion.
constexpr double kCluster_m = 0.5;
constexpr double kCluster_rad = 0.35;
/// Found: so much of the weight is of one opinion,
constexpr double kFoundShare = 0.95;
/// its spread is less than this,
constexpr double kFoundSigma_m = 0.3;
/// and so much of the scan lies on walls, so many times in a row.
constexpr double kGoodFit = 0.75;
constexpr int kGoodScans = 5;
/// Lost: less than this fits, so many times in a row.
constexpr double kBadFit = 0.5;
constexpr int kBadScans = 12;
/// An opinion that does not fit when it is formed is given up after so many scans.
constexpr int kPatience = 40;
constexpr double kLeastSigma_m = 0.002;
constexpr double kLeastSigma_rad = 0.001;
/// A point this near to a wall lies on it.
constexpr double kOnWall_m = 0.1;

/// The map's walls as something to match scans to: the middle of each occupied cell.
HitGrid walls_of(const OccupancyGrid& map) {
  HitGrid walls(map.resolution_m);
  ScanPoints ends;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (is_occupied(map.at(x, y))) ends.ends_R.push_back(map.centre_of(x, y));
    }
  }
  walls.add_ends(ends.ends_R);
  return walls;
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
  std::uint64_t seed = 0;
  mrpt::maps::COccupancyGridMap2D::Ptr grid;
  HitGrid walls{0.05};
  std::vector<float> wall_distance;
  OccupancyGrid map;
  mrpt::slam::CMonteCarloLocalization2D filter;
  std::uint64_t draws = 0;
  bool has_odometry = false;
  PlanarPose odometry;  ///< At the last scan that was used.
  PoseEstimate estimate;
  Localization state = Localization::kSearching;
  double fit = 0.0;
  int good_scans = 0;
  int bad_scans = 0;
  int searching_scans = 0;
  int times_lost = 0;

  MrptRandom random() { return MrptRandom(RandomStream(seed, Purpose::kLocalization, draws++)); }

  void configure();
  void search();
  bool update(const LaserScan& scan, const PlanarPose& now);
  void filter_scan(const LaserScan& scan, const PlanarPose& increment);
  double gather_cluster();
  void refine(const std::vector<Eigen::Vector2d>& points);
  double share_on_walls(const std::vector<Eigen::Vector2d>& points) const;
  void judge(double share);
};

void MonteCarloLocalizer::Impl::configure() {
  mrpt::maps::COccupancyGridMap2D::TLikelihoodOptions& likelihood = grid->likelihoodOptions;
  likelihood.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
  likelihood.LF_stdHit = static_cast<float>(settings.sigma_hit_m);
  likelihood.LF_zHit = 0.9F;
  likelihood.LF_zRandom = 0.1F;
  likelihood.LF_maxRange = 30.0F;
  likelihood.LF_maxCorrsDistance = static_cast<float>(4.0 * settings.sigma_hit_m);
  likelihood.LF_decimation = 1;
  likelihood.enableLikelihoodCache = true;
  filter.options.metricMap = grid;
  mrpt::slam::TKLDParams& kld = filter.options.KLD_params;
  kld.KLD_binSize_XY = settings.bin_m;
  kld.KLD_binSize_PHI = settings.bin_rad;
  kld.KLD_minSampleSize = static_cast<unsigned>(settings.least_particles);
  kld.KLD_maxSampleSize = static_cast<unsigned>(settings.most_particles);
  kld.KLD_epsilon = 0.05;
  kld.KLD_delta = 0.01;
}

void MonteCarloLocalizer::Impl::search() {
  const MrptRandom lent = random();
  filter.resetUniformFreeSpace(grid.get(), 0.8, settings.most_particles);
  state = Localization::kSearching;
  good_scans = bad_scans = searching_scans = 0;
}

void MonteCarloLocalizer::Impl::filter_scan(const LaserScan& scan, const PlanarPose& increment) {
  mrpt::obs::CActionCollection actions;
  actions.insert(to_mrpt(increment, settings.odometry));
  mrpt::obs::CSensoryFrame frame;
  frame.insert(to_mrpt(scan, X_RL, settings.beams));
  mrpt::bayes::CParticleFilter run;
  run.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  // KLD sampling draws the next particles itself, which in MRPT needs multinomial resampling.
  run.m_options.resamplingMethod = mrpt::bayes::CParticleFilter::prMultinomial;
  run.m_options.adaptiveSampleSize = true;
  run.m_options.powFactor = settings.trust;
  const MrptRandom lent = random();
  run.executeOn(filter, &actions, &frame);
}

/// Mean and covariance of the particles around the one in the densest place; returns their share
/// of the weight.
double MonteCarloLocalizer::Impl::gather_cluster() {
  const auto& particles = filter.m_particles;
  double most = particles.front().log_w;
  for (const auto& particle : particles) most = std::max(most, particle.log_w);
  PlanarPose centre = estimate.pose_M;
  const auto weigh = [&](bool narrow, Eigen::Vector3d& mean, Eigen::Matrix3d& covariance) {
    double inside = 0.0;
    double all = 0.0;
    mean.setZero();
    covariance.setZero();
    for (const auto& particle : particles) {
      const double w = std::exp(particle.log_w - most);
      all += w;
      const Eigen::Vector3d d(particle.d.x - centre.x, particle.d.y - centre.y,
                              wrap_to_pi(particle.d.phi - centre.yaw));
      if (narrow && (d.head<2>().norm() > kCluster_m || std::abs(d.z()) > kCluster_rad)) continue;
      inside += w;
      mean += w * d;
      covariance += w * d * d.transpose();
    }
    if (inside > 0.0) {
      mean /= inside;
      covariance = covariance / inside - mean * mean.transpose();
    }
    return inside / all;
  };
  if (state == Localization::kSearching) {
    // The heaviest bin says where to look.
    struct Bin { double w = 0.0; std::size_t first = 0; };
    std::map<std::tuple<int, int, int>, Bin> bins;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const auto& d = particles[i].d;
      Bin& bin = bins[{static_cast<int>(std::floor(d.x / kCluster_m)),
                       static_cast<int>(std::floor(d.y / kCluster_m)),
                       static_cast<int>(std::floor(wrap_to_two_pi(d.phi) / kCluster_rad))}];
      if (bin.w == 0.0) bin.first = i;
      bin.w += std::exp(particles[i].log_w - most);
    }
    const auto heaviest = std::max_element(bins.begin(), bins.end(), [](const auto& a, const auto& b) { return a.second.w < b.second.w; });
    const auto& d = particles[heaviest->second.first].d;
    centre = {d.x, d.y, d.phi};
  }
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;
  double share = 0.0;
  for (int i = 0; i < 3; ++i) {
    share = weigh(true, mean, covariance);
    centre = {centre.x + mean.x(), centre.y + mean.y(), wrap_to_pi(centre.yaw + mean.z())};
  }
  estimate = {centre, covariance};
  return share;
}

/// Brings the estimate below the particles' spread.
void MonteCarloLocalizer::Impl::refine(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Matrix3d covariance = estimate.covariance;
  covariance.diagonal() +=
      Eigen::Vector3d(kLeastSigma_m * kLeastSigma_m, kLeastSigma_m * kLeastSigma_m,
                      kLeastSigma_rad * kLeastSigma_rad);
  const ScanMatch match = match_scan(walls, points, estimate.pose_M, estimate.pose_M,
                                     covariance.inverse(), settings.match);
  estimate = {match.pose_M, match.information.inverse()};
}

double MonteCarloLocalizer::Impl::share_on_walls(const std::vector<Eigen::Vector2d>& points) const {
  std::size_t on_walls = 0;
  for (const Eigen::Vector2d& p_R : points) {
    const Eigen::Vector2i cell = map.cell_of(transformed(estimate.pose_M, p_R));
    if (map.contains(cell.x(), cell.y()) &&
        wall_distance[map.index(cell.x(), cell.y())] <= kOnWall_m) {
      ++on_walls;
    }
  }
  return static_cast<double>(on_walls) / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

/// Whether the robot has been found, or got lost. `share` is that of the opinion's weight.
void MonteCarloLocalizer::Impl::judge(double share) {
  good_scans = fit >= kGoodFit ? good_scans + 1 : 0;
  bad_scans = fit < kBadFit ? bad_scans + 1 : 0;
  if (state == Localization::kTracking) {
    if (bad_scans < kBadScans) return;
    ++times_lost;
    search();
    return;
  }
  ++searching_scans;
  const double sigma = std::sqrt(estimate.covariance.topLeftCorner<2, 2>().trace());
  const bool of_one_opinion = share >= kFoundShare && sigma <= kFoundSigma_m;
  if (of_one_opinion && good_scans >= kGoodScans) {
    state = Localization::kTracking;
    bad_scans = 0;
  } else if (of_one_opinion && searching_scans >= kPatience) {
    search();
  }
}

bool MonteCarloLocalizer::Impl::update(const LaserScan& scan, const PlanarPose& now) {
  const PlanarPose increment = has_odometry ? between(odometry, now) : PlanarPose{};
  const bool moved = std::hypot(increment.x, increment.y) >= settings.update_distance_m ||
                     std::abs(increment.yaw) >= settings.update_turn_rad;
  if (has_odometry && !moved) return false;
  const std::vector<Eigen::Vector2d> ends = scan_points(scan, X_RL, 0.0).ends_R;
  if (ends.empty()) return false;
  filter_scan(scan, increment);
  has_odometry = true;
  odometry = now;
  estimate.pose_M = compose(estimate.pose_M, increment);
  const double share = gather_cluster();
  const std::vector<Eigen::Vector2d> points = thinned(ends, settings.point_spacing_m);
  refine(points);
  fit = share_on_walls(points);
  judge(share);
  return true;
}

MonteCarloLocalizer::MonteCarloLocalizer(const OccupancyGrid& map, const LocalizerSettings& settings,
                                         const RigidTransform& X_RL, std::uint64_t seed)
    : impl_(std::make_unique<Impl>()) {
  require_usable(map);
  impl_->settings = settings;
  impl_->X_RL = X_RL;
  impl_->seed = seed;
  impl_->map = map;
  impl_->grid = to_mrpt(map);
  impl_->walls = walls_of(map);
  std::vector<bool> occupied;
  for (const std::int8_t cell : map.cells) occupied.push_back(is_occupied(cell));
  impl_->wall_distance = distance_field(map, occupied, 1.0);
  impl_->configure();
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
  const auto count = static_cast<std::size_t>(impl.settings.least_particles) * 2;
  RandomStream stream(impl.seed, Purpose::kLocalization, impl.draws++, 1);
  const Eigen::Matrix3d floor = Eigen::Vector3d(kLeastSigma_m * kLeastSigma_m, kLeastSigma_m * kLeastSigma_m, kLeastSigma_rad * kLeastSigma_rad).asDiagonal();
  const Eigen::Matrix3d L = (start.covariance + floor).llt().matrixL();
  impl.filter.m_particles.resize(count);
  for (auto& particle : impl.filter.m_particles) {
    const auto [a, b] = standard_normal_pair(stream);
    const Eigen::Vector3d d = L * Eigen::Vector3d(a, b, standard_normal(stream));
    particle.log_w = 0.0;
    particle.d = {start.pose_M.x + d.x(), start.pose_M.y + d.y(), start.pose_M.yaw + d.z()};
  }
  impl.estimate = start;
  impl.state = Localization::kTracking;
  impl.has_odometry = false;
  impl.good_scans = impl.bad_scans = 0;
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
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(impl.estimate.pose_M.yaw).toRotationMatrix();
  moved.covariance = impl.estimate.covariance +
                     R * increment_covariance(increment, impl.settings.odometry) * R.transpose();
  return moved;
}

Localization MonteCarloLocalizer::state() const { return impl_->state; }
double MonteCarloLocalizer::fit() const { return impl_->fit; }
int MonteCarloLocalizer::times_lost() const { return impl_->times_lost; }

std::vector<PlanarPose> MonteCarloLocalizer::particles() const {
  std::vector<PlanarPose> poses;
  for (const auto& particle : impl_->filter.m_particles) {
    poses.push_back({particle.d.x, particle.d.y, particle.d.phi});
  }
  return poses;
}

}  // namespace tagfield
