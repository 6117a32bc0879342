// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/ros2_outlet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adapters/ros2/robot_topics.h"
#include "adapters/ros2/ros2_robot.h"
#include "adapters/ros2/tee_sink.h"

namespace tagfield::ros2 {
namespace {

/// Keeps all messages as bytes.
class Kept : public MessageSink {
 public:
  std::size_t advertise(const Ros2Topic& topic, const Ros2Type& type) override {
    topics_.push_back({topic, &type});
    return topics_.size() - 1;
  }
  void publish(std::size_t topic, Time stamp, const void* message) override {
    bytes_[topics_.at(topic).first.name].push_back(topics_.at(topic).second->to_cdr(message));
    stamps_[topics_.at(topic).first.name].push_back(stamp);
  }

  /// All messages of a topic.
  template <class Message>
  [[nodiscard]] std::vector<Message> of(const std::string& topic) const {
    std::vector<Message> messages;
    const auto found = bytes_.find(topic);
    if (found == bytes_.end()) return messages;
    for (const std::string& bytes : found->second) {
      messages.emplace_back();
      EXPECT_TRUE(from_cdr(bytes, messages.back()));
    }
    return messages;
  }
  [[nodiscard]] Delivery delivery_of(const std::string& topic) const {
    for (const auto& [known, type] : topics_) {
      if (known.name == topic) return known.delivery;
    }
    ADD_FAILURE() << "no topic " << topic;
    return Delivery::kReliable;
  }

 private:
  std::vector<std::pair<Ros2Topic, const Ros2Type*>> topics_;
  std::map<std::string, std::vector<std::string>> bytes_;
  std::map<std::string, std::vector<Time>> stamps_;
};

AntennaInfo antenna_called(const std::string& name, bool is_fixed) {
  AntennaInfo antenna;
  antenna.name = antenna.frame_id = name;
  antenna.reader = "reader";
  antenna.is_fixed = is_fixed;
  return antenna;
}

constexpr Time at(double seconds) {
  return Time(Duration(static_cast<Duration::rep>(seconds * 1e9)));
}

/// An update with one read.
void update(Ros2Outlet& outlet, const AntennaInfo& antenna, double seconds) {
  const RigidTransform X_WA = from_translation({antenna.is_fixed ? 1.0 : seconds, 2.0, 3.0});
  outlet.on_pose(antenna, {at(seconds), antenna.name, X_WA, std::nullopt});
  outlet.on_antenna_pose(antenna, {at(seconds), antenna.name, X_WA, std::nullopt});
  outlet.on_distance({at(seconds), antenna.name, "tag", 4.5});
  TagRead read;
  read.stamp = at(seconds);
  read.reader = antenna.reader;
  read.antenna = antenna.name;
  read.tag = "tag";
  read.frequency_hz = 865.7e6;
  read.phase_rad = 1.25;
  read.rssi_dbm = -61.5;
  outlet.on_read(read);
  outlet.on_update(antenna, at(seconds));
}

TEST(Ros2Outlet, TellsReadsAndTheTruthApart) {
  const auto kept = std::make_shared<Kept>();
  Ros2Outlet outlet(kept);
  update(outlet, antenna_called("mobile", false), 1.5);
  const auto reads = kept->of<tagfield_msgs::TagReads>("/rfid/reads");
  ASSERT_EQ(reads.size(), 1U);
  EXPECT_EQ(reads[0].header.frame_id, "mobile");
  EXPECT_EQ(reads[0].header.stamp.sec, 1);
  EXPECT_EQ(reads[0].header.stamp.nanosec, 500'000'000U);
  ASSERT_EQ(reads[0].reads.size(), 1U);
  EXPECT_EQ(reads[0].reads[0].epc, "tag");
  EXPECT_EQ(reads[0].reads[0].phase, 1.25);
  EXPECT_EQ(reads[0].reads[0].rssi, -61.5);
  EXPECT_TRUE(std::isnan(reads[0].reads[0].doppler)) << "the reader does not tell it";
  const auto truth = kept->of<tagfield_msgs::AntennaTruth>("/rfid/truth/antennas");
  ASSERT_EQ(truth.size(), 1U);
  EXPECT_EQ(truth[0].header.frame_id, "map");
  EXPECT_EQ(truth[0].epcs, std::vector<std::string>{"tag"});
  EXPECT_EQ(truth[0].distances, std::vector<double>{4.5});
  EXPECT_EQ(truth[0].pose.position.y, 2.0);
}

TEST(Ros2Outlet, UpdatesWithoutReadsAreReportedToo) {
  const auto kept = std::make_shared<Kept>();
  Ros2Outlet outlet(kept);
  outlet.on_update(antenna_called("mobile", false), at(1));
  EXPECT_TRUE(kept->of<tagfield_msgs::TagReads>("/rfid/reads").at(0).reads.empty());
}

TEST(Ros2Outlet, FramesThatMoveAndThoseThatDont) {
  const auto kept = std::make_shared<Kept>();
  Ros2Outlet outlet(kept);
  for (const double seconds : {1.0, 2.0}) {
    update(outlet, antenna_called("mobile", false), seconds);
    update(outlet, antenna_called("gate", true), seconds);
    AntennaInfo dock = antenna_called("dock", true);
    dock.parent_frame = "world";
    update(outlet, dock, seconds);
  }
  const auto moving = kept->of<tf2_msgs::TFMessage>("/tf");
  ASSERT_EQ(moving.size(), 2U);
  EXPECT_EQ(moving[1].transforms.at(0).header.frame_id, "map");
  EXPECT_EQ(moving[1].transforms.at(0).child_frame_id, "mobile");
  EXPECT_EQ(moving[1].transforms.at(0).transform.translation.x, 2.0);
  const auto fixed = kept->of<tf2_msgs::TFMessage>("/tf_static");
  ASSERT_EQ(fixed.size(), 2U) << "one as each of them is known";
  ASSERT_EQ(fixed[1].transforms.size(), 2U) << "the last one holds all";
  for (const auto& frame : fixed[1].transforms) EXPECT_EQ(frame.header.frame_id, "map");
  EXPECT_EQ(kept->delivery_of("/tf_static"), Delivery::kLatched);
}

TEST(Ros2Outlet, TheClockNeverStandsOrFalls) {
  const auto kept = std::make_shared<Kept>();
  Ros2Outlet outlet(kept);
  for (const double seconds : {1.0, 1.0, 2.0}) {
    update(outlet, antenna_called("mobile", false), seconds);
  }
  const auto clock = kept->of<rosgraph_msgs::Clock>("/clock");
  ASSERT_EQ(clock.size(), 2U);
  EXPECT_EQ(clock[1].clock.sec, 2);
}

TEST(Ros2Outlet, TagsAreLatchedAndMovesAreReported) {
  const auto kept = std::make_shared<Kept>();
  Ros2Outlet outlet(kept);
  outlet.on_tag_added({at(0), "a", {1, 2, 3}}, "");
  outlet.on_tag_added({at(0), "b", {4, 5, 6}}, "");
  outlet.on_tags_placed(at(0));
  outlet.on_tag_moved({at(1), "b", {7, 8, 9}});
  outlet.on_tags_placed(at(1));
  outlet.on_tag_removed("a");
  outlet.on_tags_placed(at(2));
  const auto tags = kept->of<tagfield_msgs::TagPositions>("/rfid/truth/tags");
  ASSERT_EQ(tags.size(), 2U);
  EXPECT_EQ(tags[0].tags.size(), 2U);
  ASSERT_EQ(tags[1].tags.size(), 1U);
  EXPECT_EQ(tags[1].tags[0].position.x, 7.0) << "where it moved to";
  const auto moved = kept->of<tagfield_msgs::TagPositions>("/rfid/truth/tags_moved");
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].tags.at(0).epc, "b");
}

TEST(Ros2Outlet, TheTopicOfARobotIsThereBeforeItsFirstPose) {
  const auto kept = std::make_shared<Kept>();
  Ros2Outlet outlet(kept);
  outlet.expect_robot("cart");
  EXPECT_EQ(kept->delivery_of("/cart/ground_truth/odom"), Delivery::kReliable);
  outlet.on_robot_pose({at(1), "cart", {}, std::nullopt});
  EXPECT_EQ(kept->of<nav_msgs::Odometry>("/cart/ground_truth/odom").size(), 1U);
}

TEST(Ros2Outlet, OdometryHasTheSpeedInTheRobotsFrame) {
  const auto kept = std::make_shared<Kept>();
  Ros2Outlet outlet(kept);
  // Facing +y and driving in that direction: forward is the robot's +x.
  const RigidTransform X_before = from_xyz_rpy({1, 0, 0}, {0, 0, M_PI / 2});
  const RigidTransform X_after = from_xyz_rpy({1, 1, 0}, {0, 0, M_PI / 2});
  outlet.on_robot_pose({at(1), "cart 1", X_before, std::nullopt});
  outlet.on_robot_pose({at(3), "cart 1", X_after, std::nullopt});
  const auto odometry = kept->of<nav_msgs::Odometry>("/cart_1/ground_truth/odom");
  ASSERT_EQ(odometry.size(), 2U);
  EXPECT_EQ(odometry[0].twist.twist.linear.x, 0.0);
  EXPECT_NEAR(odometry[1].twist.twist.linear.x, 0.5, 1e-12);
  EXPECT_NEAR(odometry[1].twist.twist.linear.y, 0.0, 1e-12);
  EXPECT_EQ(odometry[1].child_frame_id, "cart 1/base_link");
}

TEST(Ros2Outlet, AntennasOnARobotThatOthersPlaceHangBelowIt) {
  const auto kept = std::make_shared<Kept>();
  Ros2Outlet outlet(kept);
  outlet.mount("cart", {"mast"}, "base_link");
  const RigidTransform X_WB = from_xyz_rpy({5, 5, 0}, {0, 0, M_PI / 2});
  const RigidTransform X_BA = from_translation({0.1, 0.2, 1.5});
  const AntennaInfo antenna = antenna_called("mast", false);
  outlet.on_robot_pose({at(1), "cart", X_WB, std::nullopt});
  outlet.on_pose(antenna, {at(1), "mast", RigidTransform{}, std::nullopt});
  outlet.on_antenna_pose(antenna, {at(1), "mast", X_WB * X_BA, std::nullopt});
  const auto frames = kept->of<tf2_msgs::TFMessage>("/tf");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].transforms.at(0).header.frame_id, "base_link");
  EXPECT_NEAR(frames[0].transforms.at(0).transform.translation.x, 0.1, 1e-12);
  EXPECT_NEAR(frames[0].transforms.at(0).transform.translation.y, 0.2, 1e-12);
}

TEST(ScanMessage, SaysWhatABeamMetAsRep117Does) {
  LaserScan scan;
  scan.first_angle_rad = -1.0;
  scan.angle_step_rad = 0.5;
  scan.min_range_m = 0.3;
  scan.max_range_m = 30.0;
  scan.ranges_m = {2.5F, nothing_range(30.0), 0.0F};
  const sensor_msgs::LaserScan message = scan_message(scan, "laser", 20.0);
  EXPECT_EQ(message.ranges.at(0), 2.5F);
  EXPECT_EQ(message.ranges.at(1), std::numeric_limits<float>::infinity());
  EXPECT_EQ(message.ranges.at(2), -std::numeric_limits<float>::infinity());
  EXPECT_EQ(message.angle_max, 0.0F);
  EXPECT_NEAR(message.scan_time, 0.05, 1e-7);
}

TEST(Ros2Navigation, TellsTheMapOnceAndWhereEachScanWasTaken) {
  const auto kept = std::make_shared<Kept>();
  LaserParameters laser;
  laser.X_RL = from_translation({0.15, 0.0, 0.3});
  laser.rate_hz = 20.0;
  Ros2Navigation navigation(kept, std::make_shared<Ros2Outlet>(kept), laser);
  OccupancyGrid map;
  map.resolution_m = 0.05;
  map.width = 2;
  map.height = 1;
  map.origin = {-3.0, 4.0};
  map.cells = {-1, 100};
  navigation.on_map(map);
  LaserScan scan;
  scan.stamp = at(2.5);
  scan.angle_step_rad = 0.5;
  scan.max_range_m = 30.0;
  scan.ranges_m = {2.5F};
  navigation.on_scan("cart 1", {1.0, 2.0, M_PI / 2}, scan);
  navigation.on_scan("cart 2", {}, scan);

  EXPECT_EQ(kept->delivery_of("/map"), Delivery::kLatched);
  const auto maps = kept->of<nav_msgs::OccupancyGrid>("/map");
  ASSERT_EQ(maps.size(), 1U);
  EXPECT_EQ(maps[0].header.frame_id, "map");
  EXPECT_EQ(maps[0].info.resolution, 0.05F);
  EXPECT_EQ(maps[0].info.width, 2U);
  EXPECT_EQ(maps[0].info.height, 1U);
  EXPECT_EQ(maps[0].info.origin.position.x, -3.0);
  EXPECT_EQ(maps[0].info.origin.position.y, 4.0);
  EXPECT_EQ(maps[0].info.origin.orientation.w, 1.0);
  EXPECT_EQ(maps[0].data, (std::vector<std::int8_t>{-1, 100}));

  const auto scans = kept->of<sensor_msgs::LaserScan>("/cart_1/scan");
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].header.frame_id, "cart 1/laser");
  const auto clock = kept->of<rosgraph_msgs::Clock>("/clock");
  ASSERT_EQ(clock.size(), 1U) << "both robots look at once";
  EXPECT_EQ(clock[0].clock.nanosec, 500'000'000U);
  const auto frames = kept->of<tf2_msgs::TFMessage>("/tf");
  ASSERT_EQ(frames.size(), 2U);
  const geometry_msgs::TransformStamped& frame = frames[0].transforms.at(0);
  EXPECT_EQ(frame.header.frame_id, "map");
  EXPECT_EQ(frame.child_frame_id, "cart 1/base_link");
  EXPECT_EQ(frame.header.stamp.nanosec, 500'000'000U);
  EXPECT_EQ(frame.transform.translation.y, 2.0);
  EXPECT_NEAR(frame.transform.rotation.z, std::sqrt(0.5), 1e-12);
  const auto fixed = kept->of<tf2_msgs::TFMessage>("/tf_static");
  ASSERT_EQ(fixed.size(), 2U);
  ASSERT_EQ(fixed[1].transforms.size(), 2U) << "a latched topic keeps its last message alone";
  EXPECT_EQ(fixed[1].transforms[1].child_frame_id, "cart 2/laser");
}

TEST(RobotTopics, AreThoseOfItsNamespaceAndHangBelowTheMap) {
  const auto kept = std::make_shared<Kept>();
  RobotNames names;
  names.name_space = "/hall/cart 1";
  names.odom_parent = "world";
  const RobotTopics topics(kept, names);
  OdometryReport odometry;
  odometry.stamp = at(1);
  odometry.pose = {1.0, 2.0, M_PI / 2};
  odometry.covariance << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  odometry.velocity = {0.5, 0.25};
  odometry.velocity_variance = {0.1, 0.2};
  topics.publish(odometry);
  topics.publish(MotionReport{at(1), from_translation({1, 2, 3}), {4, 5, 6}, {7, 8, 9}});
  topics.publish(ScanReport{at(1), -1.0, 1.0, 0.05, 0.1, 30.0, {1.0F, 2.0F, 3.0F}});
  topics.publish_fixed_frames(at(1), from_translation({0.2, 0, 0}), from_translation({5, 0, 0}));

  const auto published = kept->of<nav_msgs::Odometry>("/hall/cart_1/odom").at(0);
  EXPECT_EQ(published.header.frame_id, "odom");
  EXPECT_EQ(published.child_frame_id, "base_link");
  EXPECT_EQ(published.twist.twist.linear.x, 0.5);
  // Of x, y and yaw, which are the first two and the sixth of six.
  const auto& covariance = published.pose.covariance;
  EXPECT_EQ((std::array{covariance[0], covariance[1], covariance[5]}), (std::array{1.0, 2.0, 3.0}));
  EXPECT_EQ((std::array{covariance[30], covariance[31], covariance[35]}),
            (std::array{7.0, 8.0, 9.0}));
  EXPECT_EQ(published.twist.covariance[0], 0.1);
  EXPECT_EQ(published.twist.covariance[35], 0.2);
  const auto truth = kept->of<nav_msgs::Odometry>("/hall/cart_1/ground_truth/odom").at(0);
  EXPECT_EQ(truth.header.frame_id, "map");
  EXPECT_EQ(truth.pose.pose.position.z, 3.0);
  EXPECT_EQ(truth.twist.twist.angular.x, 7.0);
  const auto scan = kept->of<sensor_msgs::LaserScan>("/hall/cart_1/scan").at(0);
  EXPECT_EQ(scan.angle_increment, 1.0F);
  EXPECT_EQ(scan.ranges, (std::vector<float>{1.0F, 2.0F, 3.0F}));
  const auto fixed = kept->of<tf2_msgs::TFMessage>("/tf_static").at(0).transforms;
  ASSERT_EQ(fixed.size(), 2U);
  EXPECT_EQ(fixed[0].child_frame_id, "laser");
  EXPECT_EQ(fixed[1].header.frame_id, "map");
  EXPECT_EQ(fixed[1].transform.translation.x, 5.0);
}

TEST(TeeSink, EachSinkGetsAllUnderItsOwnNumbers) {
  const auto one = std::make_shared<Kept>();
  const auto other = std::make_shared<Kept>();
  const Publisher<rosgraph_msgs::Clock> before(*other, {"/before"});
  TeeSink tee({one, other});
  const Publisher<rosgraph_msgs::Clock> clock(tee, {"/clock"});
  const Publisher<tf2_msgs::TFMessage> frames(tee, {"/tf"});
  clock.publish(at(1), {{1, 0}});
  frames.publish(at(1), {});
  for (const auto& kept : {one, other}) {
    ASSERT_EQ(kept->of<rosgraph_msgs::Clock>("/clock").size(), 1U);
    EXPECT_EQ(kept->of<rosgraph_msgs::Clock>("/clock")[0].clock.sec, 1);
    EXPECT_EQ(kept->of<tf2_msgs::TFMessage>("/tf").size(), 1U);
  }
}

TEST(TopicToken, IsOneThatRos2Takes) {
  EXPECT_EQ(topic_token("gate_1"), "gate_1");
  EXPECT_EQ(topic_token("gate 1/a"), "gate_1_a");
  EXPECT_EQ(topic_token("1st"), "n1st");
  EXPECT_EQ(topic_token("_x"), "n_x");
  EXPECT_EQ(topic_token(""), "n");
}

TEST(Ros2Markers, DrawAntennasRangesAndTags) {
  const auto kept = std::make_shared<Kept>();
  Ros2Markers markers(kept);
  markers.on_tag_added({at(0), "a", {1, 2, 3}}, "");
  AntennaInfo antenna = antenna_called("gate", true);
  antenna.range_m = 4.0;
  markers.on_antenna_pose(antenna, {at(1), "gate", from_translation({1, 1, 1}), std::nullopt});
  markers.on_update(antenna, at(1));
  const auto drawn = kept->of<visualization_msgs::MarkerArray>("/rfid/markers");
  ASSERT_EQ(drawn.size(), 1U);
  ASSERT_EQ(drawn[0].markers.size(), 4U) << "away with the old, tags, arrow, ball";
  EXPECT_EQ(drawn[0].markers[1].points.size(), 1U);
  EXPECT_EQ(drawn[0].markers[3].scale.x, 8.0);
}

}  // namespace
}  // namespace tagfield::ros2
