// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/internal/read_delivery.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "tagfield/field/test/replies_of.h"

namespace tagfield {
namespace {

Time at_nanos(std::int64_t nanos) { return Time(Duration(nanos)); }

/// Records all notifications.
struct Heard final : ReadListener, PoseListener, TruthListener {
  std::vector<std::string> words;
  std::vector<Time> stamps;
  std::vector<TagRead> reads;
  std::vector<double> distances_m;
  void on_read(const TagRead& read) override {
    words.push_back("read " + read.tag);
    stamps.push_back(read.stamp);
    reads.push_back(read);
  }
  void on_update(const AntennaInfo& antenna, Time) override {
    words.push_back("update " + antenna.name);
  }
  void on_pose(const AntennaInfo& antenna, const AntennaPose&) override {
    words.push_back("pose " + antenna.name);
  }
  void on_antenna_pose(const AntennaInfo& antenna, const AntennaPose&) override {
    words.push_back("truth " + antenna.name);
  }
  void on_distance(const TrueDistance& distance) override {
    words.push_back("distance " + distance.tag);
    distances_m.push_back(distance.distance_m);
  }
};

struct DeliveryFixture {
  std::shared_ptr<Heard> heard = std::make_shared<Heard>();
  ReadDelivery delivery{outlets(heard)};
  static Outlets outlets(const std::shared_ptr<Heard>& heard) {
    Outlets all;
    attach(heard, all);
    return all;
  }
};

TagRead read_at(std::int64_t nanos, const std::string& tag) {
  TagRead read;
  read.stamp = at_nanos(nanos);
  read.tag = tag;
  return read;
}

std::shared_ptr<const AntennaInfo> antenna(const std::string& name) {
  AntennaInfo info;
  info.name = name;
  return std::make_shared<const AntennaInfo>(info);
}

TEST(ReadDelivery, KeepsBackReadsThatAreLaterAndPutsThemInOrder) {
  DeliveryFixture fixture;
  fixture.delivery.add(read_at(20, "late"), 1.0);
  fixture.delivery.add(antenna("a"), at_nanos(30), {}, std::nullopt);
  fixture.delivery.add(read_at(10, "early"), 2.0);
  fixture.delivery.tell(at_nanos(15));
  EXPECT_EQ(fixture.heard->words,
            (std::vector<std::string>{"distance early", "read early", "truth a", "update a"}));
  fixture.delivery.add(antenna("b"), at_nanos(30), {}, RigidTransform{});
  fixture.delivery.tell(Time::max());
  EXPECT_EQ(
      fixture.heard->words,
      (std::vector<std::string>{"distance early", "read early", "truth a", "update a",
                                "distance late", "read late", "pose b", "truth b", "update b"}));
}

TEST(ReadDelivery, ShowsAReadersKeptReadsInOrder) {
  DeliveryFixture fixture;
  for (const std::int64_t nanos : {30, 20, 10}) {
    TagRead read = read_at(nanos, std::to_string(nanos));
    read.reader = nanos == 20 ? "other" : "one";
    fixture.delivery.add(read, 1.0);
  }
  fixture.delivery.tell(at_nanos(5));
  const std::vector<TagRead> kept = fixture.delivery.kept_reads("one");
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].tag, "10");
  EXPECT_EQ(kept[1].tag, "30");
  fixture.delivery.tell(at_nanos(10));
  EXPECT_EQ(fixture.delivery.kept_reads("one").size(), 1U);
  EXPECT_EQ(fixture.heard->reads.size(), 1U);
}

TEST(ReadDelivery, TellsNothingTwiceThoughAListenerFails) {
  struct Failing final : ReadListener {
    int calls = 0;
    void on_read(const TagRead&) override {
      ++calls;
      throw Error("no room left");
    }
  };
  const auto failing = std::make_shared<Failing>();
  Outlets outlets;
  attach(failing, outlets);
  ReadDelivery delivery(outlets);
  delivery.add(read_at(1, "a"), 1.0);
  EXPECT_THROW(delivery.tell(Time::max()), Error);
  delivery.tell(Time::max());
  EXPECT_EQ(failing->calls, 1);
}

// Against a stable sort of all reads: in any order of arrival, as long as no read between two calls
// is earlier than those already delivered.
RC_GTEST_PROP(ReadDelivery, IsAStableSort, ()) {
  DeliveryFixture fixture;
  std::vector<TagRead> expected;
  std::int64_t reported_until = 0;
  int made = 0;
  for (int round = 0; round < 5; ++round) {
    for (const int later : *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 30))) {
      expected.push_back(read_at(reported_until + later, std::to_string(made++)));
      fixture.delivery.add(expected.back(), 1.0);
    }
    reported_until += *rc::gen::inRange(0, 20);
    fixture.delivery.tell(at_nanos(reported_until));
  }
  fixture.delivery.tell(Time::max());
  std::stable_sort(expected.begin(), expected.end(),
                   [](const TagRead& a, const TagRead& b) { return a.stamp < b.stamp; });
  std::vector<std::string> words;
  for (const TagRead& read : expected) {
    words.push_back("distance " + read.tag);
    words.push_back("read " + read.tag);
  }
  RC_ASSERT(fixture.heard->words == words);
}

/// An antenna and the tags A, B and C in slots 0, 1 and 2.
struct ThreeTags {
  ThreeTags() {
    FieldAntenna made;
    made.parameters.name = "gate";
    made.parameters.reader = "reader_1";
    antenna = std::make_shared<const FieldAntenna>(made);
    for (const std::string id : {"A", "B", "C"}) {
      tags.add(static_cast<std::uint32_t>(tags.size()), id, Eigen::Vector3d::Zero());
    }
  }
  [[nodiscard]] static std::vector<TagReply> replies_at(std::int64_t nanos) {
    std::vector<TagReply> replies;
    for (const std::uint32_t slot : {2U, 0U, 1U}) {
      replies.push_back(
          {slot, at_nanos(nanos), 865.7e6, 0.5 * slot, -60.0 - slot, 1.0 + slot, 2.0});
    }
    return replies;
  }
  std::shared_ptr<const FieldAntenna> antenna;
  TagPopulation tags{3.5};
};

TEST(ReadDelivery, TellsManyReadsAsItTellsThemOneByOne) {
  const ThreeTags field;
  DeliveryFixture together;
  DeliveryFixture apart;
  for (const std::int64_t nanos : {5, 9}) {
    std::vector<TagReply> replies = ThreeTags::replies_at(nanos);
    for (const TagReply& reply : replies) {
      apart.delivery.add(to_read(field.antenna->parameters, field.tags.id(reply.slot), reply),
                         reply.distance_m);
    }
    together.delivery.add(field.antenna, at_nanos(nanos), field.tags, replies);
    EXPECT_TRUE(replies.empty());
    for (DeliveryFixture* const fixture : {&together, &apart}) {
      fixture->delivery.add(antenna("gate"), at_nanos(nanos), {}, std::nullopt);
      fixture->delivery.tell(at_nanos(nanos));
    }
  }
  const std::vector<std::string> of_one_update = {"distance C", "distance A", "distance B",
                                                  "read C",     "read A",     "read B",
                                                  "truth gate", "update gate"};
  std::vector<std::string> of_both = of_one_update;
  of_both.insert(of_both.end(), of_one_update.begin(), of_one_update.end());
  EXPECT_EQ(together.heard->words, of_both);
  // One by one, each distance is delivered directly before its read.
  EXPECT_EQ(apart.heard->words[0], "distance C");
  EXPECT_EQ(apart.heard->words[1], "read C");
  EXPECT_EQ(together.heard->distances_m, apart.heard->distances_m);
  EXPECT_EQ(together.delivery.reads(), 6);
  EXPECT_EQ(apart.delivery.reads(), 6);
  ASSERT_EQ(apart.heard->reads.size(), 6U);
  ASSERT_EQ(together.heard->reads.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const TagRead& one = together.heard->reads[i];
    const TagRead& other = apart.heard->reads[i];
    EXPECT_EQ(std::tie(one.stamp, one.reader, one.antenna, one.tag, one.frequency_hz, one.phase_rad,
                       one.rssi_dbm, one.doppler_hz),
              std::tie(other.stamp, other.reader, other.antenna, other.tag, other.frequency_hz,
                       other.phase_rad, other.rssi_dbm, other.doppler_hz));
  }
}

/// `count` tags within range of an antenna at the origin, which uses the paper's model.
struct ManyTags {
  explicit ManyTags(std::uint32_t count) {
    FieldAntenna made;
    made.parameters.name = "gate";
    made.parameters.reader = "reader_1";
    antenna = std::make_shared<const FieldAntenna>(made);
    for (std::uint32_t slot = 0; slot < count; ++slot) {
      tags.add(slot, "T" + std::to_string(slot), {1.0 + 0.001 * slot, 0.5, 0.0});
    }
  }
  std::shared_ptr<const FieldAntenna> antenna;
  TagPopulation tags{3.5};
};

// Reads generated on delivery, a piece at a time, against all of them generated at once.
TEST(ReadDelivery, MakesReadsAsItTellsThem) {
  const ManyTags field(1000);
  DeliveryFixture later;
  later.delivery.add(field.antenna, at_nanos(5), field.tags, Eigen::Vector3d::Zero());
  EXPECT_EQ(later.delivery.reads(), 0);
  DeliveryFixture made;
  const std::vector<TagReply> replies =
      replies_of(field.antenna->parameters, Eigen::Vector3d::Zero(), at_nanos(5),
                 field.antenna->seed, field.tags);
  ASSERT_EQ(replies.size(), 1000U);
  for (const TagReply& reply : replies) {
    made.delivery.add(to_read(field.antenna->parameters, field.tags.id(reply.slot), reply),
                      reply.distance_m);
  }
  for (DeliveryFixture* const fixture : {&later, &made}) {
    fixture->delivery.tell(at_nanos(5));
    EXPECT_EQ(fixture->delivery.reads(), 1000);
  }
  EXPECT_EQ(later.heard->distances_m, made.heard->distances_m);
  ASSERT_EQ(later.heard->reads.size(), 1000U);
  for (std::size_t i = 0; i < 1000; ++i) {
    const TagRead& one = later.heard->reads[i];
    const TagRead& other = made.heard->reads[i];
    EXPECT_EQ(std::tie(one.stamp, one.reader, one.antenna, one.tag, one.frequency_hz, one.phase_rad,
                       one.rssi_dbm),
              std::tie(other.stamp, other.reader, other.antenna, other.tag, other.frequency_hz,
                       other.phase_rad, other.rssi_dbm));
  }
}

TEST(ReadDelivery, MakesReadsOfWhereTagsWereThoughItTellsThemLater) {
  ManyTags field(2);
  DeliveryFixture fixture;
  fixture.delivery.add(field.antenna, at_nanos(5), field.tags, Eigen::Vector3d::Zero());
  fixture.delivery.tell(at_nanos(4));
  EXPECT_TRUE(fixture.heard->words.empty());
  EXPECT_EQ(fixture.delivery.reads(), 2);
  field.tags.remove(0);
  field.tags.move(1, {3.0, 0.0, 0.0});
  fixture.delivery.tell(at_nanos(5));
  EXPECT_EQ(fixture.heard->words,
            (std::vector<std::string>{"distance T0", "read T0", "distance T1", "read T1"}));
  EXPECT_DOUBLE_EQ(fixture.heard->distances_m[1], std::hypot(1.001, 0.5));
  EXPECT_EQ(fixture.delivery.reads(), 2);
}

TEST(ReadDelivery, KeepsTheNameOfATagThatWentBeforeItsReadIsDelivered) {
  ThreeTags field;
  DeliveryFixture fixture;
  std::vector<TagReply> replies = ThreeTags::replies_at(5);
  fixture.delivery.add(field.antenna, at_nanos(5), field.tags, replies);
  fixture.delivery.tell(at_nanos(4));
  EXPECT_TRUE(fixture.heard->words.empty());
  field.tags.remove(2);
  field.tags.add(2, "D", Eigen::Vector3d::Zero());
  fixture.delivery.tell(at_nanos(5));
  EXPECT_EQ(fixture.heard->words, (std::vector<std::string>{"distance C", "read C", "distance A",
                                                            "read A", "distance B", "read B"}));
}

}  // namespace
}  // namespace tagfield
