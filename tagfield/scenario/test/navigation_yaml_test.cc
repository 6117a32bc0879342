// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/navigation_yaml.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/base/units.h"
#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

/// Line 4 has the robot, 6 the navigation, 7 the obstacles.
std::string scenario_text(const std::string& robot, const std::string& navigation,
                          const std::string& obstacles) {
  return "seed: 1\nduration_s: 1\nrobots:\n  - {name: r, start: [0, 0, 0]" + robot +
         "}\nantennas: [{name: a, pose: [0, 0, 1]}]\nnavigation: " + navigation +
         "\nobstacles: " + obstacles + "\ntags: [{id: t, position: [1, 2, 3]}]\n";
}

Scenario load(const std::string& robot, const std::string& navigation,
              const std::string& obstacles = "[]") {
  return load_scenario(folder_of_test().with("s.yaml", scenario_text(robot, navigation, obstacles)),
                       {});
}

/// "LINE: MESSAGE"
std::string navigation_complaint(const std::string& robot, const std::string& navigation,
                                 const std::string& obstacles = "[]") {
  try {
    load(robot, navigation, obstacles);
  } catch (const Error& error) {
    const std::string what = error.what();
    const std::size_t name = what.find("s.yaml:");
    return name == std::string::npos ? what : what.substr(name + 7);
  }
  return "no navigation_complaint";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(NavigationYaml, TakesAModeAlone) {
  EXPECT_EQ(load("", "truth").pose.source, PoseSource::kTrue);
  EXPECT_EQ(load("", "slam").pose.source, PoseSource::kSlam);
  EXPECT_EQ(load("", "{mode: odometry}").pose.source, PoseSource::kOdometry);
  EXPECT_EQ(load("", "{}").pose.source, PoseSource::kSlam);
}

TEST(NavigationYaml, TakesEveryKey) {
  const Scenario scenario =
      load("",
           "{mode: slam, start: random, map: m.yaml, map_sigma_m: 0.03, keep_out: false,"
           " laser: {beams: 361, first_angle_deg: -45, last_angle_deg: 90, min_range_m: 0.1,"
           " max_range_m: 12, rate_hz: 20, sigma_m: 0.02, sweep_s: 0.01, pose: [0.2, 0, 0.4]},"
           " odometry: {alpha1: 0.1, alpha2: 0.2, alpha3: 0.3, alpha4: 0.4},"
           " mapping: {resolution_m: 0.1, particles: 5, speed_m_s: 0.6, limit_s: 99},"
           " driving: {max_speed_m_s: 1.1, max_turn_rad_s: 1.2, acceleration_m_s2: 1.3,"
           " turn_acceleration_rad_s2: 1.4, radius_m: 0.5, margin_m: 0.06, clearance_m: 0.2,"
           " goal_tolerance_m: 0.07, goal_tolerance_rad: 0.08, patience_s: 9}}");
  const NavigationSpec& spec = navigation_of(scenario);
  EXPECT_EQ(spec.start, StartBelief::kRandom);
  EXPECT_TRUE(holds(spec.map, "/m.yaml"));
  EXPECT_EQ(spec.map_sigma_m, 0.03);
  EXPECT_FALSE(spec.keep_out);
  EXPECT_EQ(spec.laser.beams, 361);
  EXPECT_NEAR(spec.laser.first_angle_rad, -kPi / 4.0, 1e-12);
  EXPECT_NEAR(spec.laser.last_angle_rad, kPi / 2.0, 1e-12);
  EXPECT_EQ(spec.laser.min_range_m, 0.1);
  EXPECT_EQ(spec.laser.max_range_m, 12.0);
  EXPECT_EQ(spec.laser.rate_hz, 20.0);
  EXPECT_EQ(spec.laser.sigma_m, 0.02);
  EXPECT_EQ(spec.laser.sweep_s, 0.01);
  EXPECT_EQ(spec.laser.X_RL.translation.z(), 0.4);
  EXPECT_EQ(spec.odometry.alpha1, 0.1);
  EXPECT_EQ(spec.odometry.alpha4, 0.4);
  EXPECT_EQ(spec.mapper.odometry.alpha2, 0.2);
  EXPECT_EQ(spec.localizer.odometry.alpha3, 0.3);
  EXPECT_EQ(spec.mapper.resolution_m, 0.1);
  EXPECT_EQ(spec.mapper.particles, 5);
  EXPECT_EQ(spec.mapping_speed_m_s, 0.6);
  EXPECT_EQ(spec.mapping_limit_s, 99.0);
  EXPECT_EQ(spec.driver.limits.speed_m_s, 1.1);
  EXPECT_EQ(spec.driver.limits.turn_rad_s, 1.2);
  EXPECT_EQ(spec.driver.limits.acceleration_m_s2, 1.3);
  EXPECT_EQ(spec.driver.limits.turn_acceleration_rad_s2, 1.4);
  EXPECT_EQ(spec.driver.radius_m, 0.5);
  EXPECT_EQ(spec.driver.margin_m, 0.06);
  EXPECT_EQ(spec.driver.clearance_m, 0.2);
  EXPECT_EQ(spec.driver.goal_tolerance_m, 0.07);
  EXPECT_EQ(spec.driver.goal_tolerance_rad, 0.08);
  EXPECT_EQ(spec.driver.patience_s, 9.0);
}

struct BadNumber {
  std::string room;  ///< Of `navigation`.
  std::vector<std::string> keys;
  std::vector<std::string> values;
};

TEST(NavigationYaml, RefusesWhatIsNoUsableNumber) {
  const std::vector<BadNumber> table{
      {"laser", {"beams"}, {"1", "0", "-3", "2.5", "many", "1000000", "[1]", ".nan"}},
      {"laser", {"max_range_m", "rate_hz"}, {"0", "-1", ".nan", ".inf", "far"}},
      {"laser", {"min_range_m", "sigma_m", "sweep_s"}, {"-0.1", ".nan", "near"}},
      {"laser", {"first_angle_deg", "last_angle_deg"}, {".nan", "left"}},
      {"laser", {"pose"}, {"[1, 2]", "[1, 2, .nan]", "3", "[1, 2, 3, 4]"}},
      {"odometry", {"alpha1", "alpha2", "alpha3", "alpha4"}, {"-1", ".nan", "bad"}},
      {"mapping", {"resolution_m", "speed_m_s", "limit_s"}, {"0", "-1", ".inf", "x"}},
      {"mapping", {"particles"}, {"0", "1001", "1.5"}},
      {"driving",
       {"max_speed_m_s", "max_turn_rad_s", "acceleration_m_s2", "turn_acceleration_rad_s2",
        "radius_m", "goal_tolerance_m", "goal_tolerance_rad", "patience_s"},
       {"0", "-1", ".nan", "fast"}},
      {"driving", {"margin_m", "clearance_m"}, {"-0.01", ".nan", "wide"}}};
  for (const BadNumber& bad : table) {
    for (const std::string& key : bad.keys) {
      for (const std::string& value : bad.values) {
        const std::string said =
            navigation_complaint("", "{" + bad.room + ": {" + key + ": " + value + "}}");
        EXPECT_EQ(said.rfind("6: navigation." + bad.room + "." + key, 0), 0U) << value << said;
      }
    }
  }
}

TEST(NavigationYaml, RefusesALaserThatCannotBe) {
  EXPECT_TRUE(holds(navigation_complaint("", "{laser: {sweep_s: 0.1}}"), "navigation.laser"));
  EXPECT_TRUE(holds(navigation_complaint("", "{laser: {min_range_m: 40}}"), "navigation.laser"));
  EXPECT_TRUE(
      holds(navigation_complaint("", "{laser: {first_angle_deg: 95}}"), "navigation.laser"));
}

TEST(NavigationYaml, NamesTheNearestOfItsWords) {
  EXPECT_TRUE(holds(navigation_complaint("", "slamm"), "slam"));
  EXPECT_TRUE(holds(navigation_complaint("", "{start: unknwon}"), "unknown"));
  EXPECT_TRUE(holds(navigation_complaint("", "{driving: {radius: 1}}"), "radius_m"));
  EXPECT_TRUE(holds(navigation_complaint("", "{strat: known}"), "start"));
  EXPECT_TRUE(holds(navigation_complaint("", "{keep_out: maybe}"), "keep_out"));
  EXPECT_TRUE(holds(navigation_complaint("", "{laser: 3}"), "navigation.laser"));
}

TEST(SelfDrivingYaml, TakesGoalsAndKidnappings) {
  const RobotSpec goals = load(", goals: [[1, 2, 0.5], [3, 4, 0]]", "slam").robots[0];
  ASSERT_EQ(goals.goals_W.size(), 2U);
  EXPECT_EQ(goals.goals_W[0].yaw, 0.5);
  EXPECT_TRUE(drives(goals));
  const RobotSpec drawn =
      load(", random_goals: 7, kidnapped: [[10, 1, 2, 3], [20]]", "slam").robots[0];
  EXPECT_EQ(drawn.random_goals, 7);
  ASSERT_EQ(drawn.kidnapped.size(), 2U);
  EXPECT_EQ(drawn.kidnapped[0].when, time_from_seconds(10.0));
  EXPECT_EQ(drawn.kidnapped[0].to_W.value().y, 2.0);
  EXPECT_FALSE(drawn.kidnapped[1].to_W.has_value());
}

TEST(SelfDrivingYaml, RefusesWhatMakesNoSense) {
  const std::vector<std::pair<std::string, std::string>> table{
      {", goals: [[1, 2]]", "4: robots[0].goals[0]"},
      {", goals: [[1, 2, .nan]]", "4: robots[0].goals[0]"},
      {", goals: 3", "4: robots[0].goals"},
      {", random_goals: 0", "4: robots[0].random_goals"},
      {", random_goals: some", "4: robots[0].random_goals"},
      {", random_goals: 2, goals: [[1, 2, 3]]", "4: robots[0] must have only one of"},
      {", waypoints: [[1, 2]], goals: [[1, 2, 3]]", "4: robots[0] must have only one of"},
      {", kidnapped: [[1, 2]]", "4: robots[0].kidnapped[0] must be [t, x, y, yaw]"},
      {", kidnapped: [[-1]]", "4: robots[0].kidnapped[0]"},
      {", kidnapped: [[1e300]]", "4: robots[0].kidnapped[0]"},
      {", kidnapped: [[5], [5]]", "4: robots[0].kidnapped[1] must be later"}};
  for (const auto& [robot, says] : table) {
    EXPECT_EQ(navigation_complaint(robot, "slam").rfind(says, 0), 0U)
        << navigation_complaint(robot, "slam");
  }
  for (const char* key : {"goals: [[1, 2, 3]]", "random_goals: 1", "kidnapped: [[1]]"}) {
    EXPECT_TRUE(holds(navigation_complaint(std::string(", ") + key, "truth"), "navigation: slam"))
        << key;
  }
}

TEST(ObstacleYaml, TakesBoxesAndWalkers) {
  const Scenario scenario = load("", "slam",
                                 "[{radius_m: 0.3, trajectory: [[0, 1, 2], [4, 5, 6]]},"
                                 " {name: box, size: [1, 2], yaw: 0.5, position: [3, 4],"
                                 " appears_s: 1, disappears_s: 2}]");
  ASSERT_EQ(scenario.obstacles.size(), 2U);
  EXPECT_EQ(scenario.obstacles[0].radius_m, 0.3);
  EXPECT_EQ(scenario.obstacles[0].motion.back().X_WB.translation.y(), 6.0);
  EXPECT_EQ(scenario.obstacles[1].name, "box");
  EXPECT_EQ(scenario.obstacles[1].size_m, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(scenario.obstacles[1].yaw_rad, 0.5);
  EXPECT_EQ(scenario.obstacles[1].disappears.value(), time_from_seconds(2.0));
}

TEST(ObstacleYaml, RefusesWhatMakesNoSense) {
  const std::vector<std::pair<std::string, std::string>> table{
      {"{position: [1, 2]}", "either 'radius_m'"},
      {"{radius_m: 1, size: [1, 2], position: [1, 2]}", "either 'radius_m'"},
      {"{radius_m: 1}", "either 'position'"},
      {"{radius_m: 1, position: [1, 2], trajectory: [[0, 1, 2]]}", "either 'position'"},
      {"{radius_m: 0, position: [1, 2]}", ".radius_m"},
      {"{radius_m: .nan, position: [1, 2]}", ".radius_m"},
      {"{size: [1, 0], position: [1, 2]}", ".size"},
      {"{size: [1], position: [1, 2]}", ".size"},
      {"{radius_m: 1, position: [1]}", ".position"},
      {"{radius_m: 1, position: [1, .inf]}", ".position"},
      {"{radius_m: 1, trajectory: []}", ".trajectory"},
      {"{radius_m: 1, trajectory: [[0, 1]]}", ".trajectory[0]"},
      {"{radius_m: 1, trajectory: [[1, 0, 0], [0, 1, 1]]}", ".trajectory"},
      {"{radius_m: 1, position: [1, 2], yaw: left}", ".yaw"},
      {"{radius_m: 1, position: [1, 2], appears_s: -1}", ".appears_s"},
      {"{radius_m: 1, position: [1, 2], disappears_s: 0}", ".disappears_s"},
      {"{radius_m: 1, position: [1, 2], appears_s: 3, disappears_s: 2}", ".disappears_s"},
      {"{radius_m: 1, position: [1, 2], colour: red}", "colour"},
      {"3", "obstacles[0]"}};
  for (const auto& [obstacle, says] : table) {
    const std::string said = navigation_complaint("", "slam", "[" + obstacle + "]");
    EXPECT_EQ(said.rfind("7: ", 0), 0U) << obstacle << ": " << said;
    EXPECT_TRUE(holds(said, "obstacles[0]")) << obstacle << ": " << said;
    EXPECT_TRUE(holds(said, says)) << obstacle << ": " << said;
  }
}

}  // namespace
}  // namespace tagfield
