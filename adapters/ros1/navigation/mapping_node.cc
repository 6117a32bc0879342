// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include <memory>
#include <optional>

#include "adapters/ros1/navigation/frame_listener.h"
#include "adapters/ros1/navigation/map_keeper.h"
#include "adapters/ros1/navigation/navigation_messages.h"
#include "adapters/ros1/navigation/node_parameters.h"
#include "adapters/ros1/navigation/nodes.h"
#include "adapters/ros1/navigation/scan_source.h"
#include "tagfield/navigation/grid_mapper.h"

namespace tagfield {
namespace {

class MappingNode {
 public:
  MappingNode();
  ~MappingNode();
  MappingNode(const MappingNode&) = delete;
  MappingNode& operator=(const MappingNode&) = delete;

 private:
  static FrameNames frame_names(const NodeParameters& parameters);
  static MapperSettings mapper_settings(const NodeParameters& parameters);
  void on_frames();
  void on_scan(const LocatedScan& located);
  void tell_map();
  void save() const;
  void begin_anew();

  ros::NodeHandle node_;
  NodeParameters parameters_{ros::NodeHandle("~")};
  FrameNames names_ = frame_names(parameters_);
  MapperSettings settings_ = mapper_settings(parameters_);
  PlanarPose start_M_ = parameters_.initial_pose();
  double interval_s_ = parameters_.positive("map_update_interval", 5.0);
  double delay_s_ = parameters_.number("tf_delay", 0.05);
  std::string map_file_ = parameters_.text("map_file", "");
  int seed_ = parameters_.count("seed", 1);
  std::optional<GridMapper> mapper_;
  std::optional<Time> published_;
  bool is_changed_ = false;
  TimeWatch time_;
  MapFrameTeller frame_teller_{node_, names_};
  MapTeller map_{node_, "dynamic_map", names_.map};
  FrameListener frames_{node_, [this] { on_frames(); }};
  ScanSource scans_{node_, frames_, names_, true,
                    [this](const LocatedScan& located) { on_scan(located); }};
};

MappingNode::~MappingNode() {
  if (map_file_.empty() || !mapper_) return;
  mapper_->polish();
  save();
}

MappingNode::MappingNode() { ROS_INFO("mapping: waits for scans and tf"); }

FrameNames MappingNode::frame_names(const NodeParameters& parameters) {
  return {parameters.text("map_frame", "map"), parameters.text("odom_frame", "odom"),
          parameters.text("base_frame", "base_link")};
}

MapperSettings MappingNode::mapper_settings(const NodeParameters& parameters) {
  MapperSettings settings;
  settings.particles = parameters.count("particles", settings.particles);
  settings.resolution_m = parameters.positive("delta", settings.resolution_m);
  settings.update_distance_m = parameters.positive("linearUpdate", settings.update_distance_m);
  settings.update_turn_rad = parameters.positive("angularUpdate", settings.update_turn_rad);
  settings.max_clear_m = parameters.positive("maxUrange", settings.max_clear_m);
  settings.threads = parameters.count("threads", settings.threads);
  return settings;
}

void MappingNode::begin_anew() {
  ROS_WARN("time went back: mapping starts again");
  frames_.forget();
  scans_.forget();
  mapper_.reset();
  published_.reset();
}

void MappingNode::on_frames() {
  if (time_.went_back()) begin_anew();
  scans_.try_again();
}

void MappingNode::on_scan(const LocatedScan& located) {
  if (!mapper_) {
    mapper_.emplace(settings_, located.X_RL, start_M_, static_cast<std::uint64_t>(seed_));
    ROS_INFO("mapping: begins");
  }
  is_changed_ = mapper_->update(located.scan, located.odometry) || is_changed_;
  const Time now = located.scan.stamp;
  frame_teller_.tell(mapper_->pose_at(located.odometry), located.odometry,
                     now + duration_from_seconds(delay_s_));
  if (!is_changed_ || (published_ && to_seconds(now - *published_) < interval_s_)) return;
  published_ = now;
  tell_map();
}

void MappingNode::tell_map() {
  is_changed_ = false;
  map_.tell(mapper_->map());
  save();
}

void MappingNode::save() const {
  if (map_file_.empty() || !mapper_ || mapper_->updates() == 0) return;
  try {
    write_map(mapper_->map(), map_file_);
  } catch (const Error& error) {
    ROS_ERROR("%s", error.what());
  }
}

}  // namespace

int run_mapping(int argc, char** argv) {
  ros::init(argc, argv, "mapping");
  return run_node([] { return std::make_unique<MappingNode>(); });
}

}  // namespace tagfield
