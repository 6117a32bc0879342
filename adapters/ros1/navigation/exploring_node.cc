// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include <actionlib_msgs/GoalStatusArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "adapters/ros1/navigation/believed_pose.h"
#include "adapters/ros1/navigation/frame_listener.h"
#include "adapters/ros1/navigation/map_keeper.h"
#include "adapters/ros1/navigation/navigation_messages.h"
#include "adapters/ros1/navigation/node_parameters.h"
#include "adapters/ros1/navigation/nodes.h"
#include "tagfield/navigation/explorer.h"

namespace tagfield {
namespace {

using actionlib_msgs::GoalStatus;

constexpr double kFullTurn = 2.0 * 3.14159265358979323846;
constexpr double kRate = 20.0;
/// Interval of replanning with the current map [s].
constexpr double kPlanningInterval = 1.0;
class ExploringNode {
 public:
  ExploringNode();

 private:
  enum class Phase { kWaiting, kLookingAround, kExploring };

  static FrameNames frame_names(const NodeParameters& parameters);
  static ExplorerOptions explorer_options(const NodeParameters& parameters);
  void on_map(const nav_msgs::OccupancyGrid& message);
  void on_status(const actionlib_msgs::GoalStatusArray& message);
  void on_tick();
  void wait();
  void look_around();
  void think(const PlanarPose& pose_M);
  void send_goal(const PlanarPose& goal_M);
  void turn(double rad_s);
  void finish();
  void begin_anew();

  ros::NodeHandle node_;
  ros::NodeHandle private_{"~"};
  NodeParameters parameters_{private_};
  FrameNames names_ = frame_names(parameters_);
  ExplorerOptions options_ = explorer_options(parameters_);
  double turn_rad_s_ = parameters_.positive("turn_speed", 0.7);
  bool exits_ = parameters_.flag("exit", false);
  Phase phase_ = Phase::kWaiting;
  OccupancyGrid keep_out_ = map_from_file(parameters_.text("keep_out_file", ""));
  std::optional<OccupancyGrid> map_;
  std::optional<Explorer> explorer_;
  double turned_rad_ = 0.0;
  double last_yaw_ = 0.0;
  std::optional<PlanarPose> goal_M_;
  ros::Time goal_sent_;
  bool is_left_ = false;  ///< Whether the current goal is done.
  ros::Time thought_;
  TimeWatch time_;
  ros::Publisher command_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  ros::Publisher goal_ = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 10);
  ros::Publisher finished_ = node_.advertise<std_msgs::Bool>("exploration_finished", 1, true);
  FrameListener frames_{node_, [] {}};
  BelievedPose believed_{frames_, names_, parameters_.positive("pose_timeout", 1.0)};
  ros::Subscriber map_subscriber_;
  ros::Subscriber status_;
  ros::Timer timer_;
};

ExploringNode::ExploringNode() {
  const auto map = [this](const nav_msgs::OccupancyGrid::ConstPtr& m) { on_map(*m); };
  using Statuses = actionlib_msgs::GoalStatusArray;
  const auto status = [this](const Statuses::ConstPtr& m) { on_status(*m); };
  map_subscriber_ = node_.subscribe<nav_msgs::OccupancyGrid>("map", 1, map);
  status_ = node_.subscribe<Statuses>("move_base/status", 10, status);
  timer_ =
      node_.createTimer(ros::Duration(1.0 / kRate), [this](const ros::TimerEvent&) { on_tick(); });
}

FrameNames ExploringNode::frame_names(const NodeParameters& parameters) {
  return {parameters.text("global_frame", "map"), parameters.text("odom_frame", "odom"),
          parameters.text("robot_base_frame", "base_link")};
}

ExplorerOptions ExploringNode::explorer_options(const NodeParameters& parameters) {
  ExplorerOptions options;
  FrontierOptions& frontiers = options.frontiers;
  frontiers.radius_m = parameters.positive("radius", frontiers.radius_m);
  frontiers.margin_m = parameters.positive("margin", frontiers.margin_m);
  frontiers.min_size_m = parameters.positive("min_frontier_size", frontiers.min_size_m);
  frontiers.sight_m = parameters.positive("sight", frontiers.sight_m);
  options.finest_m = parameters.positive("min_gap_size", options.finest_m);
  return options;
}

void ExploringNode::on_map(const nav_msgs::OccupancyGrid& message) {
  try {
    map_ = grid_of(message);
  } catch (const Error& error) {
    ROS_ERROR("%s; ignored", error.what());
  }
}

void ExploringNode::on_status(const actionlib_msgs::GoalStatusArray& message) {
  if (!goal_M_) return;
  for (const GoalStatus& status : message.status_list) {
    if (status.goal_id.stamp < goal_sent_) continue;
    is_left_ = status.status != GoalStatus::PENDING && status.status != GoalStatus::ACTIVE;
    if (!is_left_ || status.status == GoalStatus::SUCCEEDED) continue;
    ROS_INFO_THROTTLE(1.0, "(%.2f, %.2f) is not reached: %s", goal_M_->x, goal_M_->y,
                      status.text.c_str());
  }
}

void ExploringNode::begin_anew() {
  ROS_WARN("time went back: exploring starts again");
  frames_.forget();
  map_.reset();
  explorer_.reset();
  goal_M_.reset();
  is_left_ = false;
  thought_ = {};
  phase_ = Phase::kWaiting;
}

void ExploringNode::on_tick() {
  if (time_.went_back()) begin_anew();
  if (phase_ == Phase::kWaiting) return wait();
  if (phase_ == Phase::kLookingAround) return look_around();
  if (explorer_->finished() || !map_) return;
  const bool is_due = (ros::Time::now() - thought_).toSec() >= kPlanningInterval;
  const std::optional<PlanarPose> pose_M = believed_.now();
  if (pose_M && (is_due || is_left_)) think(*pose_M);
}

void ExploringNode::wait() {
  const std::optional<PlanarPose> pose_M = believed_.now();
  const std::optional<PlanarPose> odometry = believed_.odometry();
  if (!pose_M || !odometry || !map_) {
    ROS_INFO_THROTTLE(5.0, "exploring: waits for a map and the robot's pose on it");
    return;
  }
  explorer_.emplace(options_, *pose_M);
  last_yaw_ = odometry->yaw;
  turned_rad_ = 0.0;
  phase_ = Phase::kLookingAround;
}

void ExploringNode::turn(double rad_s) {
  geometry_msgs::Twist command;
  command.angular.z = rad_s;
  command_.publish(command);
}

void ExploringNode::look_around() {
  const std::optional<PlanarPose> odometry = believed_.odometry();
  if (!odometry) return;
  turned_rad_ += std::abs(std::remainder(odometry->yaw - last_yaw_, kFullTurn));
  last_yaw_ = odometry->yaw;
  const bool is_done = turned_rad_ >= kFullTurn;
  turn(is_done ? 0.0 : turn_rad_s_);
  if (is_done) phase_ = Phase::kExploring;
}

/// Updates the map, and sets a new goal if there is none or it has become useless.
void ExploringNode::think(const PlanarPose& pose_M) {
  thought_ = ros::Time::now();
  const bool was_going_home = explorer_->is_going_home();
  const OccupancyGrid map = explorer_->with_start(*map_);
  const std::optional<PlanarPose> goal_M =
      explorer_->next(map, with_occupied(map, keep_out_), pose_M, is_left_);
  if (is_left_) goal_M_.reset();
  is_left_ = false;
  if (explorer_->is_going_home() && !was_going_home) {
    ROS_INFO("exploring: nothing is left to explore, returns to its start");
  }
  if (goal_M) send_goal(*goal_M);
  if (explorer_->finished()) finish();
}

void ExploringNode::send_goal(const PlanarPose& goal_M) {
  goal_M_ = goal_M;
  goal_sent_ = ros::Time::now();
  is_left_ = false;
  geometry_msgs::PoseStamped message;
  message.header.frame_id = names_.map;
  message.header.stamp = goal_sent_;
  message.pose = planar_message(goal_M);
  goal_.publish(message);
}

void ExploringNode::finish() {
  ROS_INFO("exploring: finished");
  std_msgs::Bool message;
  message.data = 1;
  finished_.publish(message);
  if (!exits_) return;
  ros::WallDuration(1.0).sleep();  // So that subscribers receive it.
  ros::shutdown();
}

}  // namespace

int run_exploring(int argc, char** argv) {
  ros::init(argc, argv, "exploring");
  return run_node([] { return std::make_unique<ExploringNode>(); });
}

}  // namespace tagfield
