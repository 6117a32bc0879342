// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run as ROS 2 messages: an outlet like those for CSV and ROS 1, to DDS or a file.
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

/// The world's frame according to REP-105. It is the parent of the frames of antennas and robots.
inline constexpr const char* kMapFrame = "map";

/// `text` as a token of a topic name: letters, digits and '_' stay, other characters become '_',
/// with an 'n' in front unless it begins with a letter.
std::string topic_token(const std::string& text);

/// A frame's name in ROS 2: Gazebo's world, and a frame without a name, is the map.
std::string frame_in_ros2(const std::string& frame);

/// Publishes the topics of docs/ros2.md during the run: /rfid/reads, /tf (moving antennas, as
/// reported), /tf_static (those at rest), /clock, /rfid/truth/antennas, /rfid/truth/tags,
/// /rfid/truth/tags_moved, /ROBOT/ground_truth/odom.
class Ros2Outlet : public ReadListener, public PoseListener, public TruthListener {
 public:
  /// `reports_clock`: publish /clock too; false if a simulator's bridge does.
  explicit Ros2Outlet(std::shared_ptr<MessageSink> sink, bool reports_clock = true);

  /// Creates the robot's topic, which otherwise is created with its first pose: too late for that
  /// pose to reach programs that look for topics first, such as recorders.
  void expect_robot(const std::string& name);
  /// Registers antennas on a robot whose frames other code publishes: the parent of their frames is
  /// then `base_frame` instead of the map.
  void mount(const std::string& robot, const std::set<std::string>& antennas,
             const std::string& base_frame);
  /// Publishes to /clock, unless that time or a later one has been published.
  void tell_time(Time stamp);
  /// Publishes to /tf.
  void tell_frame(Time stamp, const geometry_msgs::TransformStamped& frame);
  /// Publishes to /tf_static, with all earlier frames, unless it is unchanged.
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
  /// Data of one antenna since its last update.
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
  std::optional<Time> stated_time_;
};

/// Publishes /rfid/markers, twice per simulated second: antennas, their ranges, tags coloured by
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
