// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/navigation_yaml.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/scenario/internal/radio_yaml.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

PoseSource mode_of(const YamlValue& value) {
  constexpr PoseSource kModes[] = {PoseSource::kTrue, PoseSource::kNoisy, PoseSource::kOdometry,
                                   PoseSource::kSlam};
  return kModes[choice(value, {"truth", "noisy", "odometry", "slam"})];
}

int count_of(YamlMap& map, const std::string& key, int otherwise, int least, int most) {
  if (!map.has(key)) return otherwise;
  const YamlValue value = map.at(key);
  const std::uint64_t count = value.whole_number();
  if (count < static_cast<std::uint64_t>(least) || count > static_cast<std::uint64_t>(most)) {
    value.fail(fmt::format("must be from {} to {}, is {}", least, most, count));
  }
  return static_cast<int>(count);
}

/// Runs the check of the parameters' own module and reports errors at the location in the file.
template <class Parameters>
void check_at(const YamlMap& map, const Parameters& parameters) {
  try {
    check(parameters);
  } catch (const Error& error) {
    map.self().fail(error.what());
  }
}

StartBelief start_of(const YamlValue& value) {
  constexpr StartBelief kStarts[] = {StartBelief::kKnown, StartBelief::kUnknown,
                                     StartBelief::kRandom};
  return kStarts[choice(value, {"known", "unknown", "random"})];
}

/// [t, x, y, yaw], or [t] for a random pose.
Kidnapping kidnapping_of(const YamlValue& row) {
  const std::vector<double> n = row.numbers(1, 4);
  if (n.size() != 1 && n.size() != 4) {
    row.fail("must be [t, x, y, yaw], or [t] for a random place");
  }
  Kidnapping kidnapping;
  kidnapping.location = row.location();
  kidnapping.when = time_from_seconds(seconds_of(row.list().front(), kNotNegative));
  for (std::size_t i = 1; i < n.size(); ++i) row.require_length(n[i]);
  if (n.size() == 4) kidnapping.to_W = PlanarPose{n[1], n[2], n[3]};
  return kidnapping;
}

LaserParameters laser_of(YamlMap map) {
  LaserParameters laser;
  laser.beams = count_of(map, "beams", laser.beams, 2, 100'000);
  constexpr double kDegree = radians(1.0);
  const double first_deg = map.number("first_angle_deg", laser.first_angle_rad / kDegree);
  const double last_deg = map.number("last_angle_deg", laser.last_angle_rad / kDegree);
  if (std::abs(first_deg) > 360.0) {
    map.at("first_angle_deg").fail(fmt::format("is {}, expected -360 to 360", first_deg));
  }
  if (!(last_deg > first_deg && last_deg - first_deg <= 360.0 + 1e-9)) {
    map.at(map.has("last_angle_deg") ? "last_angle_deg" : "first_angle_deg")
        .fail(
            fmt::format("makes the laser see from {} to {} degrees, expected last_angle_deg to be "
                        "greater than first_angle_deg, by 360 at most",
                        first_deg, last_deg));
  }
  laser.first_angle_rad = radians(first_deg);
  laser.last_angle_rad = radians(last_deg);
  laser.min_range_m = map.number("min_range_m", laser.min_range_m, kNotNegative);
  laser.max_range_m = map.number("max_range_m", laser.max_range_m, kPositive);
  laser.rate_hz = map.number("rate_hz", laser.rate_hz, kPositive);
  laser.sigma_m = map.number("sigma_m", laser.sigma_m, kNotNegative);
  laser.sweep_s = map.number("sweep_s", laser.sweep_s, kNotNegative);
  if (map.has("pose")) laser.X_RL = pose_of(map.at("pose"));
  map.finish();
  check_at(map, laser);
  return laser;
}

OdometryNoise odometry_of(YamlMap map) {
  OdometryNoise noise;
  noise.alpha1 = map.number("alpha1", noise.alpha1, kNotNegative);
  noise.alpha2 = map.number("alpha2", noise.alpha2, kNotNegative);
  noise.alpha3 = map.number("alpha3", noise.alpha3, kNotNegative);
  noise.alpha4 = map.number("alpha4", noise.alpha4, kNotNegative);
  map.finish();
  return noise;
}

void read_mapping(YamlMap map, NavigationSpec& navigation) {
  MapperSettings& mapper = navigation.mapper;
  mapper.resolution_m = map.number("resolution_m", mapper.resolution_m, kPositive);
  mapper.particles = count_of(map, "particles", mapper.particles, 1, 1000);
  navigation.mapping_speed_m_s = map.number("speed_m_s", navigation.mapping_speed_m_s, kPositive);
  navigation.mapping_limit_s = map.number("limit_s", navigation.mapping_limit_s, kPositive);
  map.finish();
}

GoalDriverSettings driver_of(YamlMap map) {
  GoalDriverSettings driver;
  SpeedLimits& limits = driver.limits;
  limits.speed_m_s = map.number("max_speed_m_s", limits.speed_m_s, kPositive);
  limits.turn_rad_s = map.number("max_turn_rad_s", limits.turn_rad_s, kPositive);
  limits.acceleration_m_s2 = map.number("acceleration_m_s2", limits.acceleration_m_s2, kPositive);
  limits.turn_acceleration_rad_s2 =
      map.number("turn_acceleration_rad_s2", limits.turn_acceleration_rad_s2, kPositive);
  driver.radius_m = map.number("radius_m", driver.radius_m, kPositive);
  driver.margin_m = map.number("margin_m", driver.margin_m, kNotNegative);
  driver.clearance_m = map.number("clearance_m", driver.clearance_m, kNotNegative);
  driver.goal_tolerance_m = map.number("goal_tolerance_m", driver.goal_tolerance_m, kPositive);
  driver.goal_tolerance_rad =
      map.number("goal_tolerance_rad", driver.goal_tolerance_rad, kPositive);
  driver.patience_s = map.number("patience_s", driver.patience_s, kPositive);
  map.finish();
  return driver;
}

}  // namespace

PoseSource read_navigation(const YamlValue& value, NavigationSpec& navigation) {
  if (value.node().IsScalar()) return mode_of(value);
  YamlMap map(value);
  const PoseSource mode = map.has("mode") ? mode_of(map.at("mode")) : PoseSource::kSlam;
  if (map.has("start")) navigation.start = start_of(map.at("start"));
  if (map.has("map")) navigation.map = resolve_path(map.at("map"));
  if (map.has("map_sigma_m")) navigation.map_sigma_m = map.at("map_sigma_m").number(kNotNegative);
  navigation.keep_out = map.boolean("keep_out", navigation.keep_out);
  if (map.has("laser")) navigation.laser = laser_of(YamlMap(map.at("laser")));
  if (map.has("odometry")) {
    navigation.odometry = odometry_of(YamlMap(map.at("odometry")));
    // The robot knows the accuracy of its odometry.
    navigation.mapper.odometry = navigation.odometry;
    navigation.localizer.odometry = navigation.odometry;
  }
  if (map.has("mapping")) read_mapping(YamlMap(map.at("mapping")), navigation);
  if (map.has("driving")) navigation.driver = driver_of(YamlMap(map.at("driving")));
  map.finish();
  return mode;
}

void read_self_driving(YamlMap& map, RobotSpec& robot) {
  for (const YamlValue& goal : map.list("goals")) {
    const std::vector<double> n = goal.lengths(3, 3);
    robot.goals_W.push_back({n[0], n[1], n[2]});
  }
  robot.random_goals = count_of(map, "random_goals", 0, 1, 100'000);
  for (const YamlValue& row : map.list("kidnapped")) {
    const Kidnapping kidnapping = kidnapping_of(row);
    if (!robot.kidnapped.empty() && kidnapping.when <= robot.kidnapped.back().when) {
      row.fail("must be later than the one before it");
    }
    robot.kidnapped.push_back(kidnapping);
  }
  const int kinds = static_cast<int>(!robot.waypoints.empty()) +
                    static_cast<int>(!robot.goals_W.empty()) +
                    static_cast<int>(robot.random_goals > 0);
  if (kinds > 1) map.self().fail("must have only one of 'waypoints', 'goals' and 'random_goals'");
}

void forbid_self_driving(YamlMap map) {
  for (const char* key : {"goals", "random_goals", "kidnapped"}) {
    if (map.has(key)) map.at(key).fail("is only for robots with 'navigation: slam'");
  }
}

ObstacleSpec obstacle_of(YamlMap map, const RadioWorldOptions& world) {
  ObstacleSpec obstacle;
  obstacle.location = map.self().location();
  obstacle.name = map.text("name", "obstacle");
  if (map.has("radius_m") == map.has("size")) {
    map.self().fail("must have either 'radius_m' (round) or 'size' ([length, width])");
  }
  if (map.has("radius_m")) {
    obstacle.radius_m = map.at("radius_m").number(kPositive);
  } else {
    const YamlValue value = map.at("size", "[length, width] in m, or radius_m");
    const std::vector<double> size = value.lengths(2, 2);
    if (!(size[0] > 0.0 && size[1] > 0.0)) value.fail("must be two numbers greater than 0");
    obstacle.size_m = {size[0], size[1]};
  }
  obstacle.yaw_rad = map.number("yaw", 0.0);
  if (map.has("trajectory") == map.has("position")) {
    map.self().fail("must have either 'position' ([x, y]) or 'trajectory' (rows [t, x, y])");
  }
  if (map.has("trajectory")) {
    obstacle.motion = trajectory_of(map.at("trajectory"), 3);
  } else {
    const std::vector<double> n = map.at("position").lengths(2, 2);
    obstacle.motion = {{Time{}, from_translation({n[0], n[1], 0.0})}};
  }
  const Lifetime lifetime = lifetime_of(map);
  obstacle.appears = lifetime.appears;
  obstacle.disappears = lifetime.disappears;
  if (map.has("material")) {
    BodySpec body;
    body.material = material_in(world, map.at("material"));
    body.height_m = map.number("height_m", body.height_m, kPositive);
    obstacle.body = body;
  } else if (map.has("height_m")) {
    map.at("height_m").fail("is for propagation, and needs a 'material' beside it");
  }
  map.finish();
  return obstacle;
}

}  // namespace tagfield
