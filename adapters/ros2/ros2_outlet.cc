// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/ros2_outlet.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "adapters/ros2/internal/to_message.h"

namespace tagfield::ros2 {
namespace {

constexpr Duration kMarkerInterval = std::chrono::milliseconds(500);
constexpr double kTagEdge_m = 0.1;  // Larger than a label, to be visible across a hall.
constexpr double kArrowLength_m = 0.5;
constexpr double kArrowWidth_m = 0.08;

using visualization_msgs::Marker;

tagfield_msgs::TagRead read_message(const TagRead& read, const std::string& frame) {
  return {header_message(read.stamp, frame),
          read.tag,
          read.reader,
          read.antenna,
          read.frequency_hz,
          read.phase_rad,
          read.rssi_dbm,
          read.doppler_hz.value_or(std::numeric_limits<double>::quiet_NaN())};
}

tagfield_msgs::TagPosition position_message(const TagPosition& tag) {
  return {tag.tag, point_message(tag.p_WT)};
}

/// Mean velocity between two poses, in the robot's own frame (REP-103).
geometry_msgs::Twist twist_between(const AntennaPose& before, const AntennaPose& now) {
  const double seconds = to_seconds(now.stamp - before.stamp);
  if (!(seconds > 0.0)) return {};
  const RigidTransform X_BN = before.X_WA.inverse() * now.X_WA;
  const Eigen::AngleAxisd turn(X_BN.rotation);
  return {vector_message(X_BN.translation / seconds),
          vector_message(turn.axis() * turn.angle() / seconds)};
}

/// Whether the frames are equal, regardless of their stamps.
bool is_same(const geometry_msgs::TransformStamped& a, const geometry_msgs::TransformStamped& b) {
  return a.header.frame_id == b.header.frame_id && to_cdr(a.transform) == to_cdr(b.transform);
}

std_msgs::ColorRGBA color_message(const ReadColor& color) {
  return {static_cast<float>(color.red), static_cast<float>(color.green),
          static_cast<float>(color.blue), static_cast<float>(color.alpha)};
}

Marker marker_of(Time stamp, const std::string& name_space, std::int32_t id, std::int32_t type) {
  Marker marker;
  marker.header = header_message(stamp, kMapFrame);
  marker.ns = name_space;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::kADD;
  return marker;
}

Marker arrow_of(Time stamp, std::int32_t id, const SeenAntenna& antenna) {
  Marker marker = marker_of(stamp, "antennas", id, Marker::kARROW);
  marker.pose = pose_message(antenna.X_WA);
  marker.scale = {kArrowLength_m, kArrowWidth_m, kArrowWidth_m};
  marker.color = color_message({0.9, 0.55, 0.0, 1.0});
  return marker;
}

Marker ball_of(Time stamp, std::int32_t id, const SeenAntenna& antenna) {
  Marker marker = marker_of(stamp, "ranges", id, Marker::kSPHERE);
  marker.pose.position = point_message(antenna.X_WA.translation);
  marker.scale = {2.0 * antenna.range_m, 2.0 * antenna.range_m, 2.0 * antenna.range_m};
  marker.color = color_message({0.9, 0.7, 0.2, 0.08});
  return marker;
}

Marker clear_all(Time stamp) {
  Marker marker = marker_of(stamp, "", 0, 0);
  marker.action = Marker::kDELETEALL;
  return marker;
}

}  // namespace

std::string topic_token(const std::string& text) {
  const char first = text.empty() ? '_' : text.front();
  const bool is_letter = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
  // A token can't begin with a digit, and a leading '_' would hide the topic.
  std::string token = is_letter ? "" : "n";
  for (const char c : text) {
    const bool allowed =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    token += allowed ? c : '_';
  }
  return token;
}

std::string frame_in_ros2(const std::string& frame) {
  return frame.empty() || frame == "world" ? kMapFrame : frame;
}

Ros2Outlet::Ros2Outlet(std::shared_ptr<MessageSink> sink, bool reports_clock)
    : sink_(std::move(sink)),
      tf_(*sink_, {"/tf"}),
      static_tf_(*sink_, {"/tf_static", Delivery::kLatched}),
      reads_(*sink_, {"/rfid/reads"}),
      antennas_(*sink_, {"/rfid/truth/antennas"}),
      tags_(*sink_, {"/rfid/truth/tags", Delivery::kLatched}),
      moved_tags_(*sink_, {"/rfid/truth/tags_moved"}) {
  if (reports_clock) clock_.emplace(*sink_, Ros2Topic{"/clock", Delivery::kBestEffort});
}

void Ros2Outlet::tell_time(Time stamp) {
  if (!clock_ || (stated_time_ && stamp <= *stated_time_)) return;
  stated_time_ = stamp;
  clock_->publish(stamp, {to_message(stamp)});
}

void Ros2Outlet::tell_frame(Time stamp, const geometry_msgs::TransformStamped& frame) {
  tf_.publish(stamp, {{frame}});
}

void Ros2Outlet::tell_fixed_frame(Time stamp, const geometry_msgs::TransformStamped& frame) {
  const auto [known, is_new] = fixed_.emplace(frame.child_frame_id, frame);
  if (!is_new && is_same(known->second, frame)) return;
  known->second = frame;
  // A latched topic keeps only its last message.
  tf2_msgs::TFMessage all;
  for (const auto& [name, fixed] : fixed_) all.transforms.push_back(fixed);
  static_tf_.publish(stamp, all);
}

void Ros2Outlet::on_tag_added(const TagPosition& tag, const std::string& /*label*/) {
  places_[tag.tag] = tag;
  has_changed_ = true;
}

void Ros2Outlet::on_tag_removed(const std::string& id) {
  places_.erase(id);
  moved_.erase(id);
  has_changed_ = true;
}

void Ros2Outlet::on_tag_moved(const TagPosition& tag) {
  places_[tag.tag] = tag;
  moved_.insert(tag.tag);
}

void Ros2Outlet::on_tags_placed(Time stamp) {
  tell_time(stamp);
  tagfield_msgs::TagPositions message{header_message(stamp, kMapFrame), {}};
  if (std::exchange(has_changed_, false)) {
    for (const auto& [id, place] : places_) message.tags.push_back(position_message(place));
    tags_.publish(stamp, message);
    message.tags.clear();
  }
  for (const std::string& id : std::exchange(moved_, {})) {
    message.tags.push_back(position_message(places_.at(id)));
  }
  if (!message.tags.empty()) moved_tags_.publish(stamp, message);
}

void Ros2Outlet::expect_robot(const std::string& name) { robot_named(name); }

void Ros2Outlet::mount(const std::string& robot, const std::set<std::string>& antennas,
                       const std::string& base_frame) {
  mount_ = {robot, antennas, base_frame};
}

/// Publishes its pose on the robot, which is known: its mount, and the height of its lift.
void Ros2Outlet::tell_mounted(const AntennaInfo& antenna, const AntennaPose& pose) {
  const auto robot = robots_.find(mount_.robot);
  if (robot == robots_.end() || !robot->second.last || robot->second.last->stamp != pose.stamp) {
    return;
  }
  const RigidTransform X_BA = robot->second.last->X_WA.inverse() * pose.X_WA;
  tell_frame(pose.stamp, frame_message(pose.stamp, mount_.base_frame, antenna.frame_id, X_BA));
}

void Ros2Outlet::on_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  tell_time(pose.stamp);
  if (mount_.antennas.count(antenna.name) > 0) return;
  const geometry_msgs::TransformStamped transform =
      frame_message(pose.stamp, frame_in_ros2(antenna.parent_frame), antenna.frame_id, pose.X_WA);
  if (antenna.is_fixed) {
    tell_fixed_frame(pose.stamp, transform);
  } else {
    tell_frame(pose.stamp, transform);
  }
}

void Ros2Outlet::on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  updates_[antenna.name].X_WA = pose.X_WA;
  if (mount_.antennas.count(antenna.name) > 0) tell_mounted(antenna, pose);
}

void Ros2Outlet::on_distance(const TrueDistance& distance) {
  updates_[distance.antenna].distances_m.push_back(distance.distance_m);
}

void Ros2Outlet::on_read(const TagRead& read) { updates_[read.antenna].reads.push_back(read); }

void Ros2Outlet::on_update(const AntennaInfo& antenna, Time stamp) {
  const Update update = std::exchange(updates_[antenna.name], {});
  tagfield_msgs::AntennaTruth truth{header_message(stamp, kMapFrame),
                                    antenna.name,
                                    pose_message(update.X_WA),
                                    {},
                                    update.distances_m};
  tagfield_msgs::TagReads reads{header_message(stamp, antenna.frame_id), antenna.name, {}};
  for (const TagRead& read : update.reads) {
    truth.epcs.push_back(read.tag);
    reads.reads.push_back(read_message(read, antenna.frame_id));
  }
  tell_time(stamp);
  reads_.publish(stamp, reads);
  antennas_.publish(stamp, truth);
}

void Ros2Outlet::on_antenna_removed(const std::string& name) { updates_.erase(name); }

Ros2Outlet::Robot& Ros2Outlet::robot_named(const std::string& name) {
  const auto found = robots_.find(name);
  if (found != robots_.end()) return found->second;
  const Ros2Topic topic{fmt::format("/{}/ground_truth/odom", topic_token(name))};
  return robots_.emplace(name, Robot{{*sink_, topic}, std::nullopt}).first->second;
}

void Ros2Outlet::on_robot_pose(const AntennaPose& pose) {
  Robot& robot = robot_named(pose.antenna);
  nav_msgs::Odometry message;
  message.header = header_message(pose.stamp, kMapFrame);
  message.child_frame_id = pose.antenna + "/base_link";
  message.pose.pose = pose_message(pose.X_WA);
  if (robot.last) message.twist.twist = twist_between(*robot.last, pose);
  robot.last = pose;
  tell_time(pose.stamp);
  robot.odometry.publish(pose.stamp, message);
}

void Ros2Outlet::on_restart() {
  updates_.clear();
  stated_time_.reset();
  for (auto& [name, robot] : robots_) robot.last.reset();
}

Ros2Markers::Ros2Markers(std::shared_ptr<MessageSink> sink)
    : FieldPicture(kMarkerInterval), sink_(std::move(sink)), markers_(*sink_, {"/rfid/markers"}) {}

void Ros2Markers::draw(Time stamp) {
  visualization_msgs::MarkerArray message;
  std::set<std::string> present;
  for (const auto& [name, antenna] : antennas()) present.insert(name);
  if (present != drawn_antennas_) message.markers.push_back(clear_all(stamp));
  drawn_antennas_ = std::move(present);

  Marker cubes = marker_of(stamp, "tags", 0, Marker::kCUBE_LIST);
  cubes.scale = {kTagEdge_m, kTagEdge_m, kTagEdge_m};
  for (const auto& [id, tag] : tags()) {
    cubes.points.push_back(point_message(tag.p_WT));
    cubes.colors.push_back(color_message(color_of(tag, stamp)));
  }
  if (cubes.points.empty()) cubes.action = Marker::kDELETE;
  message.markers.push_back(std::move(cubes));
  std::int32_t number = 0;
  for (const auto& [name, antenna] : antennas()) {
    message.markers.push_back(arrow_of(stamp, number, antenna));
    message.markers.push_back(ball_of(stamp, number, antenna));
    ++number;
  }
  markers_.publish(stamp, message);
}

}  // namespace tagfield::ros2
