// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run as ROS 2 messages: an outlet like those for CSV and ROS 1, into DDS or a file.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "adapters/ros2/message_sink.h"
#include "tagfield/field/field_picture.h"
#include "tagfield/stream/listeners.h"

namespace tagfield::ros2 {

/// The world's frame, by REP-105. Frames of antennas and robots hang below it.
inline constexpr const char* kMapFrame = "map";

/// Letters, digits and '_' as they are, all else as '_'; no digit at the front: a token of a
/// topic's name.
std::string topic_token(const std::string& text);

/// A frame's name: Gazebo's world, and that of no name, is the map.
std::string frame_in_ros2(const std::string& frame);

/// Tells the topics of docs/ros2.md as the run goes on:
/// /rfid/reads, /tf (antennas that move, as told), /tf_static (those at rest), /clock,
/// /rfid/truth/antennas, /rfid/truth/tags, /rfid/truth/tags_moved, /ROBOT/ground_truth/odom.
class Ros2Outlet : public ReadListener, public PoseListener, public TruthListener {
 public:
  /// `tells_clock`: /clock too; not where a simulator's bridge does.
  explicit Ros2Outlet(std::shared_ptr<MessageSink> sink, bool tells_clock = true);

  /// Makes its topic, which comes with its first pose otherwise: too late for that pose to reach
  /// those who look for topics first, as recorders do.
  void expect_robot(const std::string& name);
  /// Antennas on a robot whose frames others tell: theirs hang below `base_frame` then, and not
  /// below the map.
  void mount(const std::string& robot, const std::set<std::string>& antennas,
             const std::string& base_frame);
  /// To /clock, unless it has told that time or a later one.
  void tell_time(Time stamp);
  /// To /tf.
  void tell_frame(Time stamp, const geometry_msgs::TransformStamped& frame);
  /// To /tf_static, with all others that were told before, unless it was told just so.
  void tell_fixed_frame(Time stamp, const geometry_msgs::TransformStamped& frame);

  void on_read(const TagRead& read) override;
  void on_update(const AntennaInfo& antenna, Time stamp) override;
  void on_antenna_removed(const std::string& name) override;
  void on_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_tag_added(const TagPosition& tag, const std::string& label) override;
  void on_tag_moved(const TagPosition& tag) override;
  void on_tag_removed(const std::string& id) override;
  void on_tags_placed(Time stamp) override;
  void on_robot_pose(const AntennaPose& robot) override;
  void on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) override;
  void on_distance(const TrueDistance& distance) override;
  void on_restart() override;

 private:
  /// Of one antenna, since its last update.
  struct Update {
    RigidTransform X_WA;
    std::vector<TagRead> reads;
    std::vector<double> distances_m;
  };
  struct Mount {
    std::string robot;
    std::set<std::string> antennas;
    std::string base_frame;
  };
  struct Robot {
    Publisher<nav_msgs::Odometry> odometry;
    std::optional<AntennaPose> last;
  };

  void tell_mounted(const AntennaInfo& antenna, const AntennaPose& pose);
  Robot& robot_named(const std::string& name);

  std::shared_ptr<MessageSink> sink_;
  std::optional<Publisher<rosgraph_msgs::Clock>> clock_;
  Publisher<tf2_msgs::TFMessage> tf_;
  Publisher<tf2_msgs::TFMessage> static_tf_;
  Publisher<tagfield_msgs::TagReads> reads_;
  Publisher<tagfield_msgs::AntennaTruth> antennas_;
  Publisher<tagfield_msgs::TagPositions> tags_;
  Publisher<tagfield_msgs::TagPositions> moved_tags_;
  std::map<std::string, Update> updates_;                         ///< By antenna.
  std::map<std::string, geometry_msgs::TransformStamped> fixed_;  ///< By frame.
  std::map<std::string, TagPosition> places_;                     ///< By tag.
  std::set<std::string> moved_;
  bool has_changed_ = false;
  std::map<std::string, Robot> robots_;
  Mount mount_;
  std::optional<Time> told_time_;
};

/// /rfid/markers, twice a second of simulated time: antennas, their ranges, tags in the colour of
/// their last read.
class Ros2Markers : public FieldPicture {
 public:
  explicit Ros2Markers(std::shared_ptr<MessageSink> sink);

 protected:
  void draw(Time stamp) override;

 private:
  std::shared_ptr<MessageSink> sink_;
  Publisher<visualization_msgs::MarkerArray> markers_;
  std::set<std::string> drawn_antennas_;
};

}  // namespace tagfield::ros2
