// SPDX-License-Identifier: Apache-2.0
#include "adapters/gz/transport_publisher.h"

#include <gtest/gtest.h>
#include <tagfield/msgs/truth.pb.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <vector>

#include "adapters/gazebo_common/gz_names.h"
#if defined(TAGFIELD_GZ_IS_IGNITION)
#include <ignition/msgs/Factory.hh>
#else
#include <gz/msgs/Factory.hh>
#endif

namespace tagfield {
namespace {

/// Messages received on a topic by another node.
template <class Message>
class Heard {
 public:
  explicit Heard(const std::string& topic) {
    std::function<void(const Message&)> take = [this](const Message& message) {
      const std::lock_guard lock(mutex_);
      messages_.push_back(message);
      changed_.notify_all();
    };
    node_.Subscribe(topic, take);
  }

  /// Waits for `count` messages; returns those received, after ten seconds at the latest.
  std::vector<Message> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(10), [&] { return messages_.size() >= count; });
    return messages_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Message> messages_;
  gz_transport::Node node_;
};

AntennaInfo gate() {
  AntennaInfo antenna;
  antenna.name = "gate";
  antenna.reader = "reader_1";
  antenna.frame_id = "gate_frame";
  return antenna;
}

Time at(std::int64_t nanoseconds) { return Time(Duration(nanoseconds)); }

TagRead read_at(std::int64_t nanoseconds, const std::string& tag) {
  return {at(nanoseconds), "reader_1", "gate", tag, 865.7e6, 1.25, -61.5, {}};
}

TEST(TransportPublisher, TellsTheReadsOfAnUpdate) {
  TransportPublisher publisher;
  publisher.on_antenna_added(gate());
  Heard<msgs::TagReads> heard("/rfid/reads");
  publisher.on_read(read_at(3'000'000'001, "a"));
  TagRead second = read_at(3'000'000'002, "b");
  second.doppler_hz = -2.5;
  publisher.on_read(second);
  publisher.on_update(gate(), at(3'066'666'667));
  publisher.on_update(gate(), at(4'000'000'000));
  const std::vector<msgs::TagReads> messages = heard.wait_for(2);
  ASSERT_EQ(messages.size(), 2U);
  const msgs::TagReads& first = messages[0];
  EXPECT_EQ(first.stamp().sec(), 3);
  EXPECT_EQ(first.stamp().nsec(), 66'666'667);
  EXPECT_EQ(first.frame_id(), "gate_frame");
  EXPECT_EQ(first.antenna(), "gate");
  ASSERT_EQ(first.reads_size(), 2);
  EXPECT_EQ(first.reads(0).epc(), "a");
  EXPECT_EQ(first.reads(0).stamp().nsec(), 1);
  EXPECT_EQ(first.reads(0).reader(), "reader_1");
  EXPECT_EQ(first.reads(0).frequency_hz(), 865.7e6);
  EXPECT_EQ(first.reads(0).phase_rad(), 1.25);
  EXPECT_EQ(first.reads(0).rssi_dbm(), -61.5);
  EXPECT_FALSE(first.reads(0).has_doppler_hz());
  EXPECT_EQ(first.reads(1).doppler_hz(), -2.5);
  EXPECT_EQ(messages[1].reads_size(), 0);
}

TEST(TransportPublisher, TellsTheTruthApart) {
  TransportPublisher publisher;
  publisher.on_antenna_added(gate());
  Heard<msgs::AntennaTruth> heard("/rfid/truth/antennas");
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  publisher.on_antenna_pose(gate(), {at(1'000), "gate", {turn, {1.0, 2.0, 3.0}}});
  publisher.on_distance({at(900), "gate", "a", 2.75});
  publisher.on_read(read_at(900, "a"));
  publisher.on_update(gate(), at(1'000));
  const std::vector<msgs::AntennaTruth> messages = heard.wait_for(1);
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].position().y(), 2.0);
  EXPECT_EQ(messages[0].orientation().w(), turn.w());
  EXPECT_EQ(messages[0].orientation().z(), turn.z());
  ASSERT_EQ(messages[0].distances_size(), 1);
  EXPECT_EQ(messages[0].distances(0).epc(), "a");
  EXPECT_EQ(messages[0].distances(0).distance_m(), 2.75);
}

TEST(TransportPublisher, TellsAllTagsAgainAndMovedOnesAtOnce) {
  TransportPublisher publisher;
  Heard<msgs::TagPositions> all("/rfid/truth/tags");
  Heard<msgs::TagPositions> moved("/rfid/truth/tags_moved");
  publisher.on_tag_added({at(0), "a", {1.0, 0.0, 0.0}}, "");
  publisher.on_tag_added({at(0), "b", {2.0, 0.0, 0.0}}, "");
  publisher.on_tags_placed(at(0));
  publisher.on_tag_moved({at(100'000'000), "b", {2.5, 0.0, 0.0}});
  publisher.on_tags_placed(at(100'000'000));
  publisher.on_tags_placed(at(999'999'999));
  publisher.on_tag_removed("a");
  publisher.on_tags_placed(at(1'000'000'000));
  publisher.on_tags_placed(at(2'000'000'000));
  const std::vector<msgs::TagPositions> messages = all.wait_for(3);
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0].tags_size(), 2);
  ASSERT_EQ(messages[1].tags_size(), 1);
  EXPECT_EQ(messages[1].tags(0).epc(), "b");
  EXPECT_EQ(messages[1].tags(0).position().x(), 2.5);
  EXPECT_EQ(messages[2].stamp().sec(), 2);
  const std::vector<msgs::TagPositions> changes = moved.wait_for(1);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].stamp().nsec(), 100'000'000);
  ASSERT_EQ(changes[0].tags_size(), 1);
}

TEST(TransportPublisher, TellsWhoComesLateOfTagsAtRest) {
  TransportPublisher publisher;
  publisher.on_antenna_added(gate());
  publisher.on_tag_added({at(0), "a", {1.0, 0.0, 0.0}}, "");
  publisher.on_tags_placed(at(0));
  Heard<msgs::TagPositions> late("/rfid/truth/tags");
  publisher.on_update(gate(), at(500'000'000));
  publisher.on_update(gate(), at(1'000'000'000));
  publisher.on_update(gate(), at(1'500'000'000));
  publisher.on_update(gate(), at(2'000'000'000));
  const std::vector<msgs::TagPositions> messages = late.wait_for(2);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].stamp().sec(), 1);
  ASSERT_EQ(messages[1].tags_size(), 1);
  EXPECT_EQ(messages[1].tags(0).position().x(), 1.0);
}

TEST(TransportPublisher, KeepsNameSpacesApart) {
  TransportPublisher publisher;
  AntennaInfo antenna = gate();
  antenna.name_space = "/hall 2/";
  publisher.on_antenna_added(antenna);
  Heard<msgs::TagReads> here("/hall_2/rfid/reads");
  publisher.on_update(antenna, at(5));
  ASSERT_EQ(here.wait_for(1).size(), 1U);
}

/// `ign topic` and `gz topic` can't show messages whose descriptor they don't find.
TEST(TransportPublisher, SendsWhatTheCommandOfGazeboCanShow) {
  gz_msgs::Factory::LoadDescriptors(TAGFIELD_GZ_DESCRIPTORS);
  for (const std::string type : {"TagReads", "AntennaTruth", "TagPositions"}) {
    EXPECT_TRUE(gz_msgs::Factory::New("tagfield.msgs." + type)) << type;
  }
}

}  // namespace
}  // namespace tagfield
