// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <std_srvs/Empty.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "adapters/ros1/navigation/frame_listener.h"
#include "adapters/ros1/navigation/map_keeper.h"
#include "adapters/ros1/navigation/navigation_messages.h"
#include "adapters/ros1/navigation/node_parameters.h"
#include "adapters/ros1/navigation/nodes.h"
#include "adapters/ros1/navigation/scan_source.h"
#include "tagfield/navigation/monte_carlo_localizer.h"

namespace tagfield {
namespace {

class LocalizationNode {
 public:
  LocalizationNode();

 private:
  static FrameNames frame_names(const NodeParameters& parameters);
  static LocalizerSettings localizer_settings(const NodeParameters& parameters);
  PoseEstimate first_estimate() const;
  void read_map_file(const std::string& path);
  void on_map(const nav_msgs::OccupancyGrid& message);
  void on_frames();
  void on_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& message);
  bool on_global_localization(std_srvs::Empty::Request&, std_srvs::Empty::Response&);
  void on_scan(const LocatedScan& located);
  bool prepare(const RigidTransform& X_RL);
  void begin_anew();
  void tell_frame(const LocatedScan& located, const PlanarPose& pose_M);
  void tell_pose(const LocatedScan& located, const PoseEstimate& estimate);

  ros::NodeHandle node_;
  NodeParameters parameters_{ros::NodeHandle("~")};
  FrameNames names_ = frame_names(parameters_);
  LocalizerSettings settings_ = localizer_settings(parameters_);
  double ahead_s_ = parameters_.number("transform_tolerance", 0.1);
  int seed_ = parameters_.count("seed", 1);
  /// Initial estimate, used once there are a map and a scan; none for global localization.
  std::optional<PoseEstimate> start_ = first_estimate();
  std::optional<OccupancyGrid> map_;
  std::optional<MonteCarloLocalizer> localizer_;
  bool was_searching_ = false;
  TimeWatch time_;
  ros::Publisher pose_ =
      node_.advertise<geometry_msgs::PoseWithCovarianceStamped>("amcl_pose", 2, true);
  ros::Publisher cloud_ = node_.advertise<geometry_msgs::PoseArray>("particlecloud", 2, true);
  MapFrameTeller frame_teller_{node_, names_};
  std::unique_ptr<MapTeller> map_teller_;
  ros::Subscriber map_subscriber_;
  FrameListener frames_{node_, [this] { on_frames(); }};
  ScanSource scans_{node_, frames_, names_, true,
                    [this](const LocatedScan& located) { on_scan(located); }};
  ros::Subscriber initial_pose_;
  ros::ServiceServer global_;
};

LocalizationNode::LocalizationNode() {
  const std::string path = parameters_.text("map_file", "");
  if (!path.empty()) {
    read_map_file(path);
  } else {
    const auto hear = [this](const nav_msgs::OccupancyGrid::ConstPtr& m) { on_map(*m); };
    map_subscriber_ = node_.subscribe<nav_msgs::OccupancyGrid>("map", 1, hear);
  }
  using Pose = geometry_msgs::PoseWithCovarianceStamped;
  const auto hear = [this](const Pose::ConstPtr& message) { on_initial_pose(*message); };
  initial_pose_ = node_.subscribe<Pose>("initialpose", 2, hear);
  global_ = node_.advertiseService("global_localization", &LocalizationNode::on_global_localization,
                                   this);
}

FrameNames LocalizationNode::frame_names(const NodeParameters& parameters) {
  return {parameters.text("global_frame_id", "map"), parameters.text("odom_frame_id", "odom"),
          parameters.text("base_frame_id", "base_link")};
}

LocalizerSettings LocalizationNode::localizer_settings(const NodeParameters& parameters) {
  LocalizerSettings settings;
  settings.update_distance_m = parameters.positive("update_min_d", settings.update_distance_m);
  settings.update_turn_rad = parameters.positive("update_min_a", settings.update_turn_rad);
  settings.min_particles = parameters.count("min_particles", settings.min_particles);
  settings.max_particles = parameters.count("max_particles", settings.max_particles);
  settings.beams = parameters.count("laser_max_beams", settings.beams);
  settings.max_particles = std::max(settings.max_particles, settings.min_particles);
  settings.first_particles = std::min(settings.first_particles, settings.max_particles);
  settings.min_searching = std::min(settings.min_searching, settings.max_particles);
  return settings;
}

PoseEstimate LocalizationNode::first_estimate() const {
  PoseEstimate estimate;
  estimate.pose_M = parameters_.initial_pose();
  // amcl's defaults: half a metre, 15°.
  estimate.covariance.diagonal() << parameters_.positive("initial_cov_xx", 0.25),
      parameters_.positive("initial_cov_yy", 0.25), parameters_.positive("initial_cov_aa", 0.0685);
  return estimate;
}

void LocalizationNode::read_map_file(const std::string& path) {
  map_ = map_from_file(path);
  map_teller_ = std::make_unique<MapTeller>(node_, "static_map", names_.map);
  map_teller_->tell(*map_);
}

void LocalizationNode::on_map(const nav_msgs::OccupancyGrid& message) {
  try {
    const OccupancyGrid fresh = grid_of(message);
    if (frame_of_message(message.header.frame_id) != names_.map) {
      throw Error("map: is in frame '" + message.header.frame_id + "', expected '" + names_.map +
                  "'");
    }
    map_ = fresh;
    localizer_.reset();
  } catch (const Error& error) {
    ROS_ERROR("%s; not taken", error.what());
  }
}

void LocalizationNode::on_frames() {
  if (time_.went_back()) begin_anew();
  scans_.try_again();
}

void LocalizationNode::begin_anew() {
  ROS_WARN("time went back: localization starts again");
  frames_.forget();
  scans_.forget();
  localizer_.reset();
  start_ = first_estimate();
}

void LocalizationNode::on_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  const std::string frame = frame_of_message(message.header.frame_id);
  if (!frame.empty() && frame != names_.map) {
    ROS_ERROR("initialpose is in frame '%s', expected '%s'; ignored", frame.c_str(),
              names_.map.c_str());
    return;
  }
  try {
    start_ = PoseEstimate{to_planar(transform_of(message.pose.pose)), covariance_of(message.pose)};
    if (localizer_) localizer_->start_at(*start_);
  } catch (const Error& error) {
    ROS_ERROR("initialpose: %s; ignored", error.what());
  }
}

bool LocalizationNode::on_global_localization(std_srvs::Empty::Request&,
                                              std_srvs::Empty::Response&) {
  start_.reset();
  if (localizer_) localizer_->start_anywhere();
  return true;
}

/// Creates the localizer once there is a map; returns whether it exists.
bool LocalizationNode::prepare(const RigidTransform& X_RL) {
  if (localizer_) return true;
  if (!map_) {
    ROS_INFO_THROTTLE(5.0, "localization: waits for a map");
    return false;
  }
  try {
    localizer_.emplace(*map_, settings_, X_RL, static_cast<std::uint64_t>(seed_));
    if (start_) localizer_->start_at(*start_);
    return true;
  } catch (const Error& error) {
    ROS_ERROR("%s; not taken", error.what());
    localizer_.reset();
    map_.reset();
    return false;
  }
}

void LocalizationNode::on_scan(const LocatedScan& located) {
  if (!prepare(located.X_RL)) return;
  const bool is_used = localizer_->update(located.scan, located.odometry);
  const PoseEstimate estimate = localizer_->estimate_at(located.odometry);
  const bool is_searching = localizer_->state() == Localization::kSearching;
  if (is_searching != was_searching_) {
    ROS_INFO(is_searching ? "localization: searches for its pose" : "localization: knows its pose");
    was_searching_ = is_searching;
  }
  // A frame that is off by the width of a hall would be worse than none.
  if (!is_searching) tell_frame(located, estimate.pose_M);
  if (is_searching)
    start_.reset();
  else
    start_ = estimate;
  if (is_used) tell_pose(located, estimate);
}

void LocalizationNode::tell_frame(const LocatedScan& located, const PlanarPose& pose_M) {
  frame_teller_.tell(pose_M, located.odometry,
                     located.scan.stamp + duration_from_seconds(ahead_s_));
}

void LocalizationNode::tell_pose(const LocatedScan& located, const PoseEstimate& estimate) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.stamp = ros_time(located.scan.stamp);
  pose.header.frame_id = names_.map;
  pose.pose = covariance_message(estimate.pose_M, estimate.covariance);
  pose_.publish(pose);
  if (cloud_.getNumSubscribers() == 0) return;
  geometry_msgs::PoseArray cloud;
  cloud.header = pose.header;
  for (const PlanarPose& particle : localizer_->particles()) {
    cloud.poses.push_back(planar_message(particle));
  }
  cloud_.publish(cloud);
}

}  // namespace

int run_localization(int argc, char** argv) {
  ros::init(argc, argv, "localization");
  return run_node([] { return std::make_unique<LocalizationNode>(); });
}

}  // namespace tagfield
