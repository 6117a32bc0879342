// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/robot_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "tagfield/base/number.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kMinRate = 1e-6;  // [Hz]
constexpr double kMaxRate = 1e6;   // [Hz]

/// Looks up parameters and records the known names.
class Reader {
 public:
  explicit Reader(const std::vector<RawParameter>& parameters) : parameters_(parameters) {}

  void text(const char* key, std::string& value) {
    if (const RawParameter* const given = find(key)) value = given->value;
  }

  void number(const char* key, double& value) {
    if (const RawParameter* const given = find(key)) value = number_in(*given);
  }

  /// A rate [Hz] > 0 whose interval can be represented in nanoseconds.
  void rate(const char* key, double& value) {
    const RawParameter* const given = find(key);
    if (given == nullptr) return;
    const double number = number_in(*given);
    if (!(number >= kMinRate && number <= kMaxRate)) wrong(*given, "a rate [Hz], 1e-6 to 1e6");
    value = number;
  }

  /// A number > 0.
  void positive(const char* key, double& value) {
    const RawParameter* const given = find(key);
    if (given == nullptr) return;
    const double number = number_in(*given);
    if (!(number > 0.0)) wrong(*given, "a number > 0");
    value = number;
  }

  void not_negative(const char* key, double& value) {
    const RawParameter* const given = find(key);
    if (given == nullptr) return;
    const double number = number_in(*given);
    if (!(number >= 0.0)) wrong(*given, "a number, 0 or more");
    value = number;
  }

  void flag(const char* key, bool& value) {
    const RawParameter* const given = find(key);
    if (given == nullptr) return;
    const std::string& text = given->value;
    const bool yes = text == "true" || text == "1";
    if (!yes && text != "false" && text != "0") wrong(*given, "true or false");
    value = yes;
  }

  void texts(const char* key, std::vector<std::string>& values) {
    const std::vector<const RawParameter*> given = find_all(key);
    if (given.empty()) return;
    values.clear();
    for (const RawParameter* parameter : given) values.push_back(parameter->value);
  }

  void points(const char* key, std::vector<Eigen::Vector2d>& values) {
    for (const RawParameter* given : find_all(key)) values.push_back(point_in(*given));
  }

  void warn_of_unknown(Diagnostics& diagnostics) const {
    for (const RawParameter& parameter : parameters_) {
      if (std::find(known_.begin(), known_.end(), parameter.key) != known_.end()) continue;
      diagnostics.warn(parameter.location, fmt::format("unknown parameter <{}>{}", parameter.key,
                                                       suggestion(parameter.key, known_)));
    }
  }

 private:
  std::vector<const RawParameter*> find_all(const char* key) {
    known_.emplace_back(key);
    std::vector<const RawParameter*> found;
    for (const RawParameter& parameter : parameters_) {
      if (parameter.key == key) found.push_back(&parameter);
    }
    return found;
  }

  const RawParameter* find(const char* key) {
    const std::vector<const RawParameter*> found = find_all(key);
    return found.empty() ? nullptr : found.back();
  }

  [[noreturn]] static void wrong(const RawParameter& given, const char* expected) {
    fail(given.location,
         fmt::format("<{}> is '{}', expected {}", given.key, given.value, expected));
  }

  static double number_in(const RawParameter& given) {
    const std::optional<double> value = parse_number(given.value);
    if (!value) wrong(given, "a number");
    return *value;
  }

  static Eigen::Vector2d point_in(const RawParameter& given) {
    std::istringstream words(given.value);
    std::string x;
    std::string y;
    std::string rest;
    words >> x >> y;
    const std::optional<double> x_value = parse_number(x);
    const std::optional<double> y_value = parse_number(y);
    if (!x_value || !y_value || words >> rest) wrong(given, "two numbers 'x y' [m]");
    return {*x_value, *y_value};
  }

  const std::vector<RawParameter>& parameters_;
  std::vector<std::string> known_ = {"path"};
};

void read_driving(Reader& reader, RobotParameters& robot) {
  reader.positive("max_speed", robot.driver.limits.speed_m_s);
  reader.positive("max_turn", robot.driver.limits.turn_rad_s);
  reader.positive("max_acceleration", robot.driver.limits.acceleration_m_s2);
  reader.positive("max_turn_acceleration", robot.driver.limits.turn_acceleration_rad_s2);
  double timeout = to_seconds(robot.driver.command_timeout);
  reader.positive("cmd_timeout", timeout);
  robot.driver.command_timeout = duration_from_seconds(timeout);
  double steering_rate = 1.0 / to_seconds(robot.driver.steering_interval);
  reader.rate("steering_rate", steering_rate);
  robot.driver.steering_interval = duration_from_seconds(1.0 / steering_rate);
  reader.points("waypoint", robot.waypoints);
  reader.positive("speed", robot.style.speed_m_s);
  reader.positive("look_ahead", robot.style.look_ahead_m);
  robot.style.max_turn_rad_s = robot.driver.limits.turn_rad_s;
}

void read_odometry(Reader& reader, RobotParameters& robot) {
  reader.rate("odometry_rate", robot.odometry_rate_hz);
  robot.odometry.drive = robot.drive;
  robot.odometry.wheel_noise = 0.002;
  reader.positive("odometry_track", robot.odometry.drive.track_m);
  reader.not_negative("odometry_wheel_noise", robot.odometry.wheel_noise);
  double ticks = 0.0;
  reader.not_negative("encoder_ticks", ticks);
  robot.odometry.encoder_step_rad = ticks > 0.0 ? kTwoPi / ticks : 0.0;
}

}  // namespace

RobotParameters robot_from(const std::vector<RawParameter>& parameters, Diagnostics& diagnostics) {
  RobotParameters robot;
  robot.left_joints = {"front_left_wheel_joint", "rear_left_wheel_joint"};
  robot.right_joints = {"front_right_wheel_joint", "rear_right_wheel_joint"};
  Reader reader(parameters);
  reader.texts("left_joint", robot.left_joints);
  reader.texts("right_joint", robot.right_joints);
  reader.positive("wheel_radius", robot.drive.wheel_radius_m);
  reader.positive("track", robot.drive.track_m);
  reader.positive("torque", robot.torque_nm);
  read_driving(reader, robot);
  read_odometry(reader, robot);
  reader.text("laser", robot.laser);
  reader.text("base_link", robot.base_link);
  reader.text("odom_frame", robot.odom_frame);
  reader.text("laser_frame", robot.laser_frame);
  reader.text("odom_parent_frame", robot.odom_parent_frame);
  reader.flag("publish_tf", robot.publish_tf);
  reader.text("robotNamespace", robot.name_space);
  reader.warn_of_unknown(diagnostics);
  return robot;
}

LiftParameters lift_from(const std::vector<RawParameter>& parameters, Diagnostics& diagnostics) {
  LiftParameters lift;
  double upper = 1.0;
  Reader reader(parameters);
  reader.text("joint", lift.joint);
  reader.positive("speed", lift.lift.speed_m_s);
  reader.number("lower", lift.lower_m);
  reader.number("upper", upper);
  reader.positive("force", lift.force_n);
  reader.rate("joint_states_rate", lift.joint_states_rate_hz);
  reader.text("topic", lift.topic);
  reader.text("robotNamespace", lift.name_space);
  reader.warn_of_unknown(diagnostics);
  if (lift.joint.empty()) throw Error("<joint> is missing, expected the name of a prismatic joint");
  if (!(upper > lift.lower_m)) {
    throw Error(fmt::format("<upper> is '{:g}', expected a number over <lower>, {:g}", upper,
                            lift.lower_m));
  }
  lift.lift.travel_m = upper - lift.lower_m;
  return lift;
}

}  // namespace tagfield
