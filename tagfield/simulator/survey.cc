// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/explorer.h"
#include "tagfield/navigation/goal_driver.h"
#include "tagfield/navigation/grid_mapper.h"

namespace tagfield {
namespace {

/// Interval of replanning on the current map [s].
constexpr double kPlanningInterval = 1.0;
constexpr double kPathInterval = 0.1;
/// Believed spread of the pose at the end of mapping, on the robot's own map.
constexpr double kEndSigma_m = 0.02;
constexpr double kEndSigma_rad = 0.01;
/// The robot first stands still for this time [s], so that its first scan is sharp, and then looks
/// around: a full turn at this speed [rad/s].
constexpr double kStandStill = 0.7;
constexpr double kLookAround = 0.7;
constexpr int kPolishing = 3;

MapperSettings mapper_settings(const NavigationSpec& navigation, int threads) {
  MapperSettings settings = navigation.mapper;
  settings.threads = threads;
  return settings;
}

GoalDriverSettings driver_settings(const NavigationSpec& navigation) {
  GoalDriverSettings settings = navigation.driver;
  settings.speed_m_s = navigation.mapping_speed_m_s;
  return settings;
}

ExplorerOptions explorer_options(const NavigationSpec& navigation) {
  ExplorerOptions options;
  options.frontiers.radius_m = navigation.driver.radius_m;
  options.frontiers.margin_m = navigation.driver.margin_m;
  return options;
}

class Surveyor {
 public:
  Surveyor(const NavigationSpec& navigation, const NavigationWorld& world, const RobotSpec& robot,
           std::uint64_t seed, int threads)
      : navigation_(navigation),
        world_(world),
        truth_(robot.start),
        senses_(world.laser, navigation.laser, navigation.odometry, seed, stream_key(robot.name)),
        mapper_(mapper_settings(navigation, threads), navigation.laser.X_RL, robot.start, seed),
        driver_(driver_settings(navigation), navigation.laser.X_RL),
        explorer_(explorer_options(navigation), robot.start) {}

  void step(double seconds) {
    const PlanarPose believed = mapper_.pose_at(senses_.odometry(senses_.present_seconds()));
    if (to_seconds(now_ - last_path_) >= kPathInterval || survey_.true_path.empty()) {
      survey_.true_path.push_back({now_, to_transform(truth_)});
      survey_.believed_path.push_back({now_, to_transform(believed)});
      last_path_ = now_;
    }
    if (turned_ >= kTwoPi) think(believed);
    velocity_ = limited(wanted(believed), velocity_, navigation_.driver.limits, seconds);
    for (const SensedScan& sensed : senses_.step(truth_, velocity_, now_, seconds)) {
      mapper_.update(sensed.scan, sensed.odometry);
      driver_.see(sensed.scan, mapper_.pose_at(sensed.odometry));
    }
    turned_ += std::abs(velocity_.turn) * seconds;
    truth_ = advance(truth_, velocity_, seconds);
    survey_.path_length_m += std::abs(velocity_.forward) * seconds;
    now_ += duration_from_seconds(seconds);
  }

  [[nodiscard]] bool finished() const { return explorer_.finished(); }
  [[nodiscard]] double seconds() const { return to_seconds(now_); }

  Survey result() {
    mapper_.polish(kPolishing);
    survey_.map = mapper_.map();
    survey_.walls = mapper_.hits();
    survey_.start_covariance = mapper_.start_covariance();
    survey_.end.pose_M = mapper_.pose_at(senses_.odometry(senses_.present_seconds()));
    survey_.end.covariance = Eigen::Vector3d(kEndSigma_m * kEndSigma_m, kEndSigma_m * kEndSigma_m,
                                             kEndSigma_rad * kEndSigma_rad)
                                 .asDiagonal();
    survey_.true_end_W = truth_;
    survey_.simulated_s = seconds();
    survey_.complete = finished();
    return std::move(survey_);
  }

 private:
  /// Adopts the current map, and sets a new goal if there is none or it is no longer useful.
  void think(const PlanarPose& believed) {
    const bool at_end = goal_ && driver_.state() != DriveState::kDriving;
    const bool due = !planned_ || to_seconds(now_ - *planned_) >= kPlanningInterval;
    if (!due && !at_end) return;
    planned_ = now_;
    const OccupancyGrid map = explorer_.with_start(mapper_.map());
    const OccupancyGrid drivable = driving_map(map, world_);
    driver_.set_map(drivable);
    if (at_end) note_end();
    const std::optional<PlanarPose> goal = explorer_.next(map, drivable, believed, at_end);
    if (at_end) goal_.reset();
    if (!goal) return;
    goal_ = goal;
    driver_.set_goal(*goal, believed, now_);
  }

  void note_end() {
    if (driver_.state() == DriveState::kReached) return;
    survey_.given_up.push_back(
        fmt::format("({:.2f}, {:.2f}): {}", goal_->x, goal_->y, driver_.reason()));
  }

  BodyVelocity wanted(const PlanarPose& believed) {
    if (seconds() < kStandStill) return {};
    if (turned_ < kTwoPi) return {0.0, kLookAround};
    return goal_ ? driver_.next(believed, velocity_, now_) : BodyVelocity{};
  }

  const NavigationSpec& navigation_;
  const NavigationWorld& world_;
  PlanarPose truth_;
  RobotSenses senses_;
  GridMapper mapper_;
  GoalDriver driver_;
  Explorer explorer_;
  BodyVelocity velocity_;
  double turned_ = 0.0;  ///< [rad], in either direction.
  Time now_;
  Time last_path_;
  std::optional<Time> planned_;
  std::optional<PlanarPose> goal_;
  Survey survey_;
};

}  // namespace

Survey survey(const NavigationSpec& navigation, const NavigationWorld& world,
              const RobotSpec& robot, double time_step_s, std::uint64_t seed, int threads,
              const std::atomic<bool>* stop,
              const std::function<void(double simulated_s)>& on_progress) {
  Surveyor surveyor(navigation, world, robot, seed, threads);
  while (!surveyor.finished() && surveyor.seconds() < navigation.mapping_limit_s) {
    if (stop != nullptr && *stop) break;
    surveyor.step(time_step_s);
    if (on_progress) on_progress(surveyor.seconds());
  }
  return surveyor.result();
}

}  // namespace tagfield
