// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/navigation_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/simulator/internal/self_driving.h"
#include "tagfield/simulator/navigation_listener.h"
#include "tagfield/simulator/pace.h"

namespace tagfield {
namespace {

/// Share of the progress bar for mapping.
constexpr double kMappingShare = 0.7;
/// A guess for the bar: mapping a hall takes a few minutes.
constexpr double kUsualMapping_s = 240.0;

/// The map to navigate with, and the robot's pose on it.
SelfDriving find_map(const Scenario& scenario, std::uint64_t seed, const RunControl& control,
                     const NavigationWorld& world, NavigationRun& navigation) {
  const RobotSpec& robot = mapping_robot(scenario);
  if (world.given_map) {
    navigation.map = *world.given_map;
    return {&world, &navigation.map, nullptr, robot.start, placed_at(robot.start)};
  }
  const auto on_progress = [&](double simulated_s) {
    if (!control.on_progress) return;
    control.on_progress(kMappingShare * std::min(simulated_s / kUsualMapping_s, 1.0));
  };
  navigation.survey = survey(navigation_of(scenario), world, robot, scenario.time_step_s, seed,
                             control.threads, control.stop, on_progress);
  navigation.map = navigation.survey->map;
  const Survey& made = *navigation.survey;
  return {&world, &navigation.map, &*made.walls, made.true_end_W, made.end};
}

/// Counts contacts of the robots with anything, and measures how close they come.
class TouchWatch {
 public:
  TouchWatch(const NavigationWorld& world, NavigationRun& navigation)
      : world_(world), navigation_(navigation) {
    navigation_.closest_m = RobotClearance::kMost;
  }

  void look(const std::string& robot, const PlanarPose& pose_W, Time now) {
    (void)begins_to_touch(
        robot, world_.clearance.distance(pose_W, obstacles_at(world_.laser.obstacles, now)));
  }

  void look_at_each_other(const std::vector<Robot>& robots, Time now) {
    std::vector<std::pair<std::string, PlanarPose>> driving;
    for (const Robot& robot : robots) {
      if (robot.self_driver() == nullptr) continue;
      const PlanarPose pose_W = planar(robot.true_pose(0.0));
      for (const auto& [other, other_W] : driving) {
        const double distance = world_.clearance.distance_between(other_W, pose_W);
        if (!begins_to_touch(other + '\n' + robot.name(), distance)) continue;
        navigation_.robot_contacts.push_back(
            {other, robot.name(), to_seconds(now), position_of(other_W)});
      }
      driving.emplace_back(robot.name(), pose_W);
    }
  }

 private:
  /// Counts a distance; true if it is a new contact of `who`.
  bool begins_to_touch(const std::string& who, double distance) {
    navigation_.closest_m = std::min(navigation_.closest_m, distance);
    bool& touched = touches_[who];
    const bool begins = distance <= 0.0 && !touched;
    touched = distance <= 0.0;
    if (begins) ++navigation_.collisions;
    return begins;
  }

  const NavigationWorld& world_;
  NavigationRun& navigation_;
  std::map<std::string, bool> touches_;  ///< By robot, or by pair of robots.
};

/// Measures at 10 Hz how well the robots know their poses.
class BeliefWatch {
 public:
  BeliefWatch(const Scenario& scenario, NavigationRun& navigation)
      : is_given_(navigation_of(scenario).start == StartBelief::kKnown), navigation_(navigation) {}

  void look(const Robot& robot, Time now) {
    const auto [entry, is_new] = places_.try_emplace(robot.name());
    Place& place = entry->second;
    if (is_new && !is_given_) place.watch.put(PositionLoss::kStart);
    if (robot.times_kidnapped() > place.times_kidnapped) place.watch.put(PositionLoss::kKidnapped);
    place.times_kidnapped = robot.times_kidnapped();
    const PlanarPose truth = planar(robot.true_pose(0.0));
    const PlanarPose belief = planar(robot.believed_pose(0.0));
    const double off_m = (position_of(truth) - position_of(belief)).norm();
    const double off_rad = std::abs(wrap_to_pi(belief.yaw - truth.yaw));
    const bool knows_position = robot.self_driver()->knows_position();
    place.watch.look({now, robot.travelled_m(), knows_position, off_m, off_rad});
    if (!knows_position) return;
    navigation_.position_errors_m.push_back(off_m);
    navigation_.yaw_errors_rad.push_back(off_rad);
  }

  [[nodiscard]] std::vector<Finding> findings() const {
    std::vector<Finding> all;
    for (const auto& [name, place] : places_) {
      const std::vector<Finding>& of_one = place.watch.findings();
      all.insert(all.end(), of_one.begin(), of_one.end());
    }
    return all;
  }

 private:
  struct Place {
    PlaceWatch watch;
    std::size_t times_kidnapped = 0;
  };
  bool is_given_;
  NavigationRun& navigation_;
  std::map<std::string, Place> places_;
};

void tell_scans(const Robot& robot, NavigationListener* listener) {
  if (listener == nullptr) return;
  for (const SensedScan& sensed : robot.self_driver()->scans()) {
    listener->on_scan(robot.name(), robot.self_driver()->believed_at(sensed), sensed.scan);
  }
}

/// Sampling interval of beliefs [s].
constexpr double kBeliefInterval = 0.1;

/// The drive after mapping.
void drive(const Scenario& scenario, const RunControl& control, const NavigationWorld& world,
           Simulation& simulation, NavigationRun& navigation) {
  TouchWatch touches(world, navigation);
  if (navigation.survey) {
    for (const StampedPose& pose : navigation.survey->true_path) {
      touches.look(mapping_robot(scenario).name, planar(pose.X_WB), pose.stamp);
    }
  }
  BeliefWatch beliefs(scenario, navigation);
  const Pace pace(scenario.real_time);
  std::optional<Time> believed;
  while (!simulation.finished() && !stopped(control)) {
    const Time begin = simulation.now();
    simulation.step();
    const bool is_due = !believed || to_seconds(begin - *believed) >= kBeliefInterval;
    if (is_due) believed = begin;
    for (const Robot& robot : simulation.robots()) {
      if (robot.self_driver() == nullptr) continue;
      touches.look(robot.name(), planar(robot.true_pose(0.0)), begin);
      tell_scans(robot, control.navigation.get());
      if (is_due) beliefs.look(robot, begin);
    }
    touches.look_at_each_other(simulation.robots(), begin);
    if (control.on_progress) {
      control.on_progress(kMappingShare + (1.0 - kMappingShare) * simulation.progress());
    }
    pace.wait_for(simulation.now());
  }
  navigation.findings = beliefs.findings();
}

void gather_outcomes(const Simulation& simulation, NavigationRun& navigation) {
  for (const Robot& robot : simulation.robots()) {
    if (robot.self_driver() == nullptr) continue;
    const std::vector<GoalOutcome>& goals = robot.self_driver()->outcomes();
    navigation.goals.insert(navigation.goals.end(), goals.begin(), goals.end());
    navigation.times_lost += robot.self_driver()->localizer().times_lost();
  }
}

}  // namespace

NavigatedRun run_navigation(const Scenario& scenario, std::uint64_t seed, const RunControl& control,
                            const NavigationWorld& world, Outlets outlets) {
  NavigatedRun run;
  const SelfDriving driving = find_map(scenario, seed, control, world, run.navigation);
  if (control.navigation) control.navigation->on_map(run.navigation.map);
  Simulation simulation(scenario, seed, std::move(outlets), &driving, nullptr, control.threads);
  drive(scenario, control, world, simulation, run.navigation);
  simulation.finish();
  gather_outcomes(simulation, run.navigation);
  run.complete = simulation.finished();
  run.simulated_s = to_seconds(simulation.now());
  run.path_length_m = simulation.travelled_m();
  return run;
}

}  // namespace tagfield
