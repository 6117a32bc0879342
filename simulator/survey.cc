#include "simulator/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "navigation/frontiers.h"
#include "navigation/goal_driver.h"
#include "navigation/grid_mapper.h"
#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// How often the way is thought over, by the map as it is then [s].
constexpr double kPlanningInterval = 1.0;
constexpr double kPathInterval = 0.1;
/// Believed spread of the pose that the mapping ends with: of the map's own making.
constexpr double kEndSigma_m = 0.02;
constexpr double kEndSigma_rad = 0.01;
/// The robot first stands still for so long [s], so that its first look is sharp, and then looks
/// around: a full turn at this speed [rad/s].
constexpr double kStandStill = 0.7;
constexpr double kLookAround = 0.7;
constexpr int kPolishing = 3;

/// Where the robot stands as it begins there is nothing in its way, whatever its laser can't see.
void clear_start(OccupancyGrid& map, const PlanarPose& start, double radius_m) {
  const Eigen::Vector2i middle = map.cell_of(position_of(start));
  const int reach = static_cast<int>(std::ceil(radius_m / map.resolution_m));
  for (int y = middle.y() - reach; y <= middle.y() + reach; ++y) {
    for (int x = middle.x() - reach; x <= middle.x() + reach; ++x) {
      const bool inside = (map.centre_of(x, y) - position_of(start)).norm() <= radius_m;
      if (inside && map.contains(x, y) && map.at(x, y) < 0) map.cells[map.index(x, y)] = 0;
    }
  }
}

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

class Surveyor {
 public:
  Surveyor(const NavigationSpec& navigation, const NavigationWorld& world, const RobotSpec& robot,
           std::uint64_t seed, int threads)
      : navigation_(navigation),
        world_(world),
        start_(robot.start),
        truth_(robot.start),
        senses_(world.laser, navigation.laser, navigation.odometry, seed, stream_key(robot.name)),
        mapper_(mapper_settings(navigation, threads), navigation.laser.X_RL, robot.start, seed),
        driver_(driver_settings(navigation), navigation.laser.X_RL) {}

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

  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] double seconds() const { return to_seconds(now_); }

  Survey result() {
    mapper_.polish(kPolishing);
    survey_.map = mapper_.map();
    survey_.end.pose_M = mapper_.pose_at(senses_.odometry(senses_.present_seconds()));
    survey_.end.covariance = Eigen::Vector3d(kEndSigma_m * kEndSigma_m, kEndSigma_m * kEndSigma_m,
                                             kEndSigma_rad * kEndSigma_rad)
                                 .asDiagonal();
    survey_.true_end_W = truth_;
    survey_.simulated_s = seconds();
    survey_.complete = finished_;
    return std::move(survey_);
  }

 private:
  /// Takes up the map as it is now, and a new goal where there is none or it is of no use any more.
  void think(const PlanarPose& believed) {
    const bool at_end = has_goal_ && driver_.state() != DriveState::kDriving;
    const bool due = !planned_ || to_seconds(now_ - *planned_) >= kPlanningInterval;
    if (!due && !at_end) return;
    planned_ = now_;
    OccupancyGrid seen = mapper_.map();
    clear_start(seen, start_, navigation_.driver.radius_m + 2.0 * navigation_.driver.margin_m);
    const OccupancyGrid map = driving_map(seen, world_);
    driver_.set_map(map);
    if (at_end) leave_goal();
    if (finished_ || going_home_) return;
    const std::vector<Frontier> open = frontiers(map, believed, given_up_, options());
    if (open.empty()) {
      going_home_ = true;
      set_goal(start_, believed);
      return;
    }
    const bool still_open =
        has_goal_ && std::any_of(open.begin(), open.end(), [this](const Frontier& frontier) {
          return (position_of(frontier.goal) - position_of(goal_)).norm() < 1.0;
        });
    if (!still_open) set_goal(open.front().goal, believed);
  }

  BodyVelocity wanted(const PlanarPose& believed) {
    if (seconds() < kStandStill) return {};
    if (turned_ < kTwoPi) return {0.0, kLookAround};
    return has_goal_ ? driver_.next(believed, velocity_, now_) : BodyVelocity{};
  }

  [[nodiscard]] FrontierOptions options() const {
    FrontierOptions options;
    options.radius_m = navigation_.driver.radius_m;
    options.margin_m = navigation_.driver.margin_m;
    return options;
  }

  void set_goal(const PlanarPose& goal, const PlanarPose& believed) {
    goal_ = goal;
    has_goal_ = true;
    driver_.set_goal(goal, believed, now_);
  }

  void leave_goal() {
    has_goal_ = false;
    if (going_home_) finished_ = true;
    // Also a place that was reached and still shows as a frontier has nothing more to show.
    given_up_.push_back(position_of(goal_));
    if (driver_.state() == DriveState::kReached) return;
    survey_.given_up.push_back(
        fmt::format("({:.2f}, {:.2f}): {}", goal_.x, goal_.y, driver_.reason()));
  }

  const NavigationSpec& navigation_;
  const NavigationWorld& world_;
  PlanarPose start_;
  PlanarPose truth_;
  RobotSenses senses_;
  GridMapper mapper_;
  GoalDriver driver_;
  BodyVelocity velocity_;
  double turned_ = 0.0;  ///< [rad], in either direction.
  Time now_;
  Time last_path_;
  std::optional<Time> planned_;
  std::vector<Eigen::Vector2d> given_up_;
  PlanarPose goal_;
  bool has_goal_ = false;
  bool going_home_ = false;
  bool finished_ = false;
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
