// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include <actionlib_msgs/GoalStatusArray.h>
#include <fmt/format.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>

#include <limits>
#include <memory>
#include <optional>

#include "adapters/ros1/navigation/believed_pose.h"
#include "adapters/ros1/navigation/frame_listener.h"
#include "adapters/ros1/navigation/map_keeper.h"
#include "adapters/ros1/navigation/navigation_messages.h"
#include "adapters/ros1/navigation/node_parameters.h"
#include "adapters/ros1/navigation/nodes.h"
#include "adapters/ros1/navigation/scan_source.h"
#include "tagfield/navigation/goal_driver.h"

namespace tagfield {
namespace {

using actionlib_msgs::GoalStatus;

constexpr double kStatusInterval = 0.2;
constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

class DrivingNode {
 public:
  DrivingNode();

 private:
  static FrameNames frame_names(const NodeParameters& parameters);
  static GoalDriverSettings driver_settings(const NodeParameters& parameters);
  void on_map(const nav_msgs::OccupancyGrid& message);
  void on_frames();
  void on_scan(const LocatedScan& located);
  void on_odometry(const nav_msgs::Odometry& message);
  void on_goal(const geometry_msgs::PoseStamped& message);
  void on_cancel(const actionlib_msgs::GoalID& message);
  void on_tick();
  PlanarPose goal_on_map(const geometry_msgs::PoseStamped& message) const;
  void begin_goal(const geometry_msgs::PoseStamped& message);
  void follow_state();
  void end_goal(std::uint8_t status, const std::string& text);
  void publish_status();
  void tell_plan();
  void stand();
  void begin_anew();

  ros::NodeHandle node_;
  ros::NodeHandle private_{"~"};
  NodeParameters parameters_{private_};
  FrameNames names_ = frame_names(parameters_);
  GoalDriverSettings settings_ = driver_settings(parameters_);
  double max_age_s_ = parameters_.positive("pose_timeout", 1.0);
  OccupancyGrid keep_out_ = map_from_file(parameters_.text("keep_out_file", ""));
  std::optional<OccupancyGrid> map_;
  std::optional<GoalDriver> driver_;
  BodyVelocity velocity_;
  GoalStatus status_;
  bool is_under_way_ = false;
  std::uint64_t goals_ = 0;
  std::vector<Eigen::Vector2d> reported_plan_;
  ros::Time reported_status_;
  TimeWatch time_;
  ros::Publisher command_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  ros::Publisher plan_ = private_.advertise<nav_msgs::Path>("plan", 1, true);
  ros::Publisher statuses_ =
      private_.advertise<actionlib_msgs::GoalStatusArray>("status", 10, true);
  FrameListener frames_{node_, [this] { on_frames(); }};
  BelievedPose believed_{frames_, names_, max_age_s_};
  ScanSource scans_{node_, frames_, names_, false,
                    [this](const LocatedScan& located) { on_scan(located); }};
  ros::Subscriber map_subscriber_;
  ros::Subscriber odometry_;
  ros::Subscriber goal_;
  ros::Subscriber cancel_;
  ros::Timer timer_;
};

DrivingNode::DrivingNode() {
  const auto map = [this](const nav_msgs::OccupancyGrid::ConstPtr& m) { on_map(*m); };
  const auto odometry = [this](const nav_msgs::Odometry::ConstPtr& m) { on_odometry(*m); };
  const auto goal = [this](const geometry_msgs::PoseStamped::ConstPtr& m) { on_goal(*m); };
  const auto cancel = [this](const actionlib_msgs::GoalID::ConstPtr& m) { on_cancel(*m); };
  map_subscriber_ = node_.subscribe<nav_msgs::OccupancyGrid>("map", 1, map);
  odometry_ = node_.subscribe<nav_msgs::Odometry>("odom", 1, odometry);
  goal_ = node_.subscribe<geometry_msgs::PoseStamped>("move_base_simple/goal", 10, goal);
  cancel_ = private_.subscribe<actionlib_msgs::GoalID>("cancel", 10, cancel);
  timer_ = node_.createTimer(ros::Duration(1.0 / settings_.rate_hz),
                             [this](const ros::TimerEvent&) { on_tick(); });
}

FrameNames DrivingNode::frame_names(const NodeParameters& parameters) {
  return {parameters.text("global_frame", "map"), parameters.text("odom_frame", "odom"),
          parameters.text("robot_base_frame", "base_link")};
}

GoalDriverSettings DrivingNode::driver_settings(const NodeParameters& parameters) {
  GoalDriverSettings settings;
  SpeedLimits& limits = settings.limits;
  limits.speed_m_s = parameters.positive("max_vel_x", limits.speed_m_s);
  limits.turn_rad_s = parameters.positive("max_vel_theta", limits.turn_rad_s);
  limits.acceleration_m_s2 = parameters.positive("acc_lim_x", limits.acceleration_m_s2);
  limits.turn_acceleration_rad_s2 =
      parameters.positive("acc_lim_theta", limits.turn_acceleration_rad_s2);
  settings.speed_m_s = parameters.positive("speed", settings.speed_m_s);
  settings.radius_m = parameters.positive("radius", settings.radius_m);
  settings.margin_m = parameters.positive("margin", settings.margin_m);
  settings.clearance_m = parameters.positive("clearance", settings.clearance_m);
  settings.goal_tolerance_m = parameters.positive("xy_goal_tolerance", settings.goal_tolerance_m);
  settings.goal_tolerance_rad =
      parameters.positive("yaw_goal_tolerance", settings.goal_tolerance_rad);
  settings.rate_hz = parameters.positive("controller_frequency", settings.rate_hz);
  settings.patience_s = parameters.positive("patience", settings.patience_s);
  return settings;
}

void DrivingNode::on_map(const nav_msgs::OccupancyGrid& message) {
  try {
    const std::string frame = frame_of_message(message.header.frame_id);
    if (frame != names_.map) {
      throw Error(fmt::format("map: is in frame '{}', expected '{}'", frame, names_.map));
    }
    map_ = with_occupied(grid_of(message), keep_out_);
    if (driver_) driver_->set_map(*map_);
  } catch (const Error& error) {
    ROS_ERROR("%s; ignored", error.what());
  }
}

void DrivingNode::on_frames() {
  if (time_.went_back()) begin_anew();
  scans_.try_again();
}

void DrivingNode::begin_anew() {
  ROS_WARN("time went back: driving starts again");
  frames_.forget();
  scans_.forget();
  if (is_under_way_) end_goal(GoalStatus::ABORTED, "time went back");
  driver_.reset();
  reported_status_ = {};
}

void DrivingNode::on_scan(const LocatedScan& located) {
  if (!driver_) {
    driver_.emplace(settings_, located.X_RL);
    if (map_) driver_->set_map(*map_);
  }
  const std::optional<PlanarPose> pose_M = believed_.at(located.odometry);
  if (pose_M) driver_->see(located.scan, *pose_M);
}

void DrivingNode::on_odometry(const nav_msgs::Odometry& message) {
  velocity_ = {message.twist.twist.linear.x, message.twist.twist.angular.z};
}

PlanarPose DrivingNode::goal_on_map(const geometry_msgs::PoseStamped& message) const {
  const std::string frame = frame_of_message(message.header.frame_id);
  RigidTransform X_FG;
  try {
    X_FG = transform_of(message.pose);
  } catch (const Error& error) {
    throw Error(fmt::format("the goal's {}", error.what()));
  }
  if (frame == names_.map) return to_planar(X_FG);
  const std::optional<RigidTransform> X_MF = frames_.newest(names_.map, frame);
  if (X_MF) return to_planar(*X_MF * X_FG);
  throw Error(fmt::format("the goal is in frame '{}', which is not known in '{}': {}", frame,
                          names_.map, frames_.trouble(names_.map, frame)));
}

void DrivingNode::begin_goal(const geometry_msgs::PoseStamped& message) {
  const PlanarPose goal_M = goal_on_map(message);
  if (!map_) throw Error("there is no map yet");
  if (!driver_) throw Error("there is no scan yet");
  const std::optional<PlanarPose> pose_M = believed_.now();
  if (!pose_M) throw Error("the robot's pose is not known: " + believed_.trouble());
  driver_->set_goal(goal_M, *pose_M, time_of(ros::Time::now()));
  if (driver_->state() == DriveState::kRefused) throw Error(driver_->reason());
  ROS_INFO("drives to (%.2f, %.2f, %.2f rad)", goal_M.x, goal_M.y, goal_M.yaw);
}

void DrivingNode::on_goal(const geometry_msgs::PoseStamped& message) {
  if (is_under_way_) end_goal(GoalStatus::PREEMPTED, "another goal came");
  const ros::Time now = ros::Time::now();
  status_.goal_id.stamp = message.header.stamp.isZero() ? now : message.header.stamp;
  status_.goal_id.id = fmt::format("{}-{}-{}.{:09}", ros::this_node::getName(), ++goals_,
                                   status_.goal_id.stamp.sec, status_.goal_id.stamp.nsec);
  status_.status = GoalStatus::ACTIVE;
  status_.text = "";
  is_under_way_ = true;
  try {
    begin_goal(message);
    publish_status();
  } catch (const Error& error) {
    if (driver_) driver_->cancel();
    end_goal(GoalStatus::REJECTED, error.what());
  }
}

void DrivingNode::on_cancel(const actionlib_msgs::GoalID& message) {
  const bool is_meant = message.id.empty() || message.id == status_.goal_id.id;
  if (!is_under_way_ || !is_meant) return;
  driver_->cancel();
  end_goal(GoalStatus::PREEMPTED, "cancelled");
}

void DrivingNode::on_tick() {
  if (time_.went_back()) begin_anew();
  const ros::Time now = ros::Time::now();
  if (is_under_way_ && driver_) {
    const PlanarPose pose_M = believed_.now().value_or(PlanarPose{kNever, kNever, kNever});
    const BodyVelocity next = driver_->next(pose_M, velocity_, time_of(now));
    follow_state();
    if (is_under_way_) {
      geometry_msgs::Twist command;
      command.linear.x = next.forward;
      command.angular.z = next.turn;
      command_.publish(command);
    }
    tell_plan();
  }
  const bool is_due = (now - reported_status_).toSec() >= kStatusInterval;
  if (is_due && !status_.goal_id.id.empty()) publish_status();
}

void DrivingNode::follow_state() {
  if (driver_->state() == DriveState::kReached) {
    end_goal(GoalStatus::SUCCEEDED, "reached");
  } else if (driver_->state() != DriveState::kDriving) {
    end_goal(GoalStatus::ABORTED, driver_->reason());
  }
}

void DrivingNode::end_goal(std::uint8_t status, const std::string& text) {
  is_under_way_ = false;
  status_.status = status;
  status_.text = text;
  const bool is_fine = status == GoalStatus::SUCCEEDED || status == GoalStatus::PREEMPTED;
  if (is_fine) {
    ROS_INFO("goal: %s", text.c_str());
  } else {
    ROS_ERROR("goal %s: %s", status == GoalStatus::REJECTED ? "refused" : "given up", text.c_str());
  }
  stand();
  publish_status();
}

void DrivingNode::stand() { command_.publish(geometry_msgs::Twist{}); }

void DrivingNode::publish_status() {
  reported_status_ = ros::Time::now();
  actionlib_msgs::GoalStatusArray message;
  message.header.stamp = reported_status_;
  message.status_list.push_back(status_);
  statuses_.publish(message);
}

void DrivingNode::tell_plan() {
  if (driver_->path() == reported_plan_) return;
  reported_plan_ = driver_->path();
  plan_.publish(path_message(reported_plan_, names_.map, ros::Time::now()));
}

}  // namespace

int run_driving(int argc, char** argv) {
  ros::init(argc, argv, "move_base");
  return run_node([] { return std::make_unique<DrivingNode>(); });
}

}  // namespace tagfield
