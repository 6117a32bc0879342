// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_population.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "tagfield/base/test/error_text.h"
#include "tagfield/channel/paper_model.h"
#include "tagfield/field/test/replies_of.h"

namespace tagfield {
namespace {

const Eigen::Vector3d kOrigin = Eigen::Vector3d::Zero();

AntennaParameters antenna() {
  AntennaParameters antenna;
  antenna.name = "gate";
  antenna.reader = "reader_1";
  return antenna;
}

TEST(TagPopulation, HoldsTagsUnderTheirSlots) {
  TagPopulation tags(3.5);
  tags.add(0, "A", {1.0, 2.0, 3.0});
  tags.add(3, "B", kOrigin);
  EXPECT_TRUE(tags.has(0));
  EXPECT_FALSE(tags.has(1));
  EXPECT_FALSE(tags.has(9));
  EXPECT_EQ(tags.id(3), "B");
  EXPECT_EQ(tags.position(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(tags.size(), 2U);
}

TEST(TagPopulation, RefusesASecondTagOfTheSameIdOrInTheSameSlot) {
  TagPopulation tags(3.5);
  tags.add(0, "A", kOrigin);
  EXPECT_EQ(error_of([&] { tags.add(1, "A", kOrigin); }), "there is a tag with the ID 'A' already");
  EXPECT_EQ(error_of([&] { tags.add(0, "B", kOrigin); }), "there is a tag of number 0 already");
  EXPECT_EQ(tags.size(), 1U);
}

TEST(TagPopulation, RefusesAPlaceThatIsNowhereAndStaysWhole) {
  TagPopulation tags(3.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(error_of([&] { tags.add(0, "A", {nan, 0.0, 0.0}); }), "finite"));
  EXPECT_EQ(tags.size(), 0U);
  tags.add(0, "A", kOrigin);
  EXPECT_TRUE(tags.has(0));
}

/// One antenna's updates in a row, with tags kept in range, against a new search in each.
RC_GTEST_PROP(ReadTags, AreThoseOfANewSearchWhateverMovedSince, ()) {
  TagPopulation tags(3.5);
  const auto place = [] { return 0.01 * *rc::gen::inRange(-600, 600); };
  for (std::uint32_t i = 0; i < 300; ++i) {
    tags.add(i, "tag" + std::to_string(i), {place(), place(), 1.0});
  }
  AntennaParameters parameters = antenna();
  paper(parameters).range_sigma = *rc::gen::element(0.0, 0.1, 0.6);
  Eigen::Vector3d p_WA = kOrigin;
  TagsInRange near;
  for (std::int64_t update = 1; update < 30; ++update) {
    const int what = *rc::gen::inRange(0, 8);
    if (what == 0) p_WA = {place(), place(), 1.5};
    if (what == 1) tags.move(7, {place(), place(), 1.0});
    if (what == 2 && tags.has(9)) tags.remove(9);
    const Time stamp = update_stamp(parameters, update);
    std::vector<TagReply> kept;
    read_tags(parameters, p_WA, stamp, 1, tags, near, [&](const PaperReads& some) {
      for (std::size_t i = 0; i < some.slots.size(); ++i) kept.push_back(to_reply(some, i, stamp));
    });
    const std::vector<TagReply> anew = replies_of(parameters, p_WA, stamp, 1, tags);
    RC_ASSERT(kept.size() == anew.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      RC_ASSERT(kept[i].slot == anew[i].slot);
      RC_ASSERT(kept[i].phase_rad == anew[i].phase_rad);
      RC_ASSERT(kept[i].rssi_dbm == anew[i].rssi_dbm);
      RC_ASSERT(kept[i].distance_m == anew[i].distance_m);
    }
  }
}

RC_GTEST_PROP(ReadTags, ReportOnlyWhatReachesTheSensitivity, ()) {
  TagPopulation tags(3.5);
  for (std::uint32_t i = 0; i < 700; ++i) tags.add(i, "tag" + std::to_string(i), {0.01 * i, 0, 1});
  AntennaParameters parameters = antenna();
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const std::vector<TagReply> all = replies_of(parameters, kOrigin, Time{}, seed, tags);
  const double min_dbm = *rc::gen::inRange(-100, -20);
  paper(parameters).sensitivity_dbm = min_dbm;
  const std::vector<TagReply> heard = replies_of(parameters, kOrigin, Time{}, seed, tags);
  std::size_t next = 0;
  for (const TagReply& reply : all) {
    if (reply.rssi_dbm < min_dbm) continue;
    RC_ASSERT(next < heard.size());
    RC_ASSERT(heard[next].slot == reply.slot);
    RC_ASSERT(heard[next].phase_rad == reply.phase_rad);
    RC_ASSERT(heard[next].rssi_dbm == reply.rssi_dbm);
    ++next;
  }
  RC_ASSERT(next == heard.size());
}

// Against a map: whatever is added, moved and removed, the population contains what the map
// contains, and an antenna reads exactly those within its range, each as read_tag() would alone.
RC_GTEST_PROP(ReadTags, GiveWhatEachTagAloneGives, ()) {
  TagPopulation tags(3.5);
  std::map<std::string, Eigen::Vector3d> expected;
  const auto any_place = [] {
    return Eigen::Vector3d(0.01 * (*rc::gen::inRange(-1200, 1200)),
                           0.01 * (*rc::gen::inRange(-1200, 1200)),
                           0.01 * (*rc::gen::inRange(0, 300)));
  };
  for (const int what : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 90))) {
    const auto slot = static_cast<std::uint32_t>(what / 3);
    const std::string id = "tag" + std::to_string(slot);
    const Eigen::Vector3d place = any_place();
    if (!tags.has(slot)) {
      tags.add(slot, id, place);
      expected[id] = place;
    } else if (what % 3 == 0) {
      tags.remove(slot);
      expected.erase(id);
    } else {
      tags.move(slot, place);
      expected[id] = place;
    }
  }
  RC_ASSERT(tags.size() == expected.size());
  const Eigen::Vector3d p_WA = any_place();
  const Time stamp{Duration(*rc::gen::inRange<std::int64_t>(0, 1'000'000'000))};
  const std::vector<TagReply> replies = replies_of(antenna(), p_WA, stamp, 7, tags);

  const double range = perturbed_range(antenna(), stamp, 7);
  std::size_t in_range = 0;
  for (const auto& [id, place] : expected) in_range += (place - p_WA).norm() <= range ? 1U : 0U;
  RC_ASSERT(replies.size() == in_range);
  for (std::size_t i = 0; i < replies.size(); ++i) {
    const std::string& id = tags.id(replies[i].slot);
    // In parentheses: RapidCheck's own || would evaluate the element before the first.
    RC_ASSERT((i == 0 || replies[i - 1].slot < replies[i].slot));
    const TagRead read = to_read(antenna(), id, replies[i]);
    const LinkGeometry link = link_between(p_WA, expected.at(id));
    const TagRead alone = read_tag(antenna(), id, link, stamp, 7);
    RC_ASSERT(read.phase_rad == alone.phase_rad && read.rssi_dbm == alone.rssi_dbm);
    RC_ASSERT(read.tag == id && read.antenna == "gate" && read.reader == "reader_1");
    RC_ASSERT(replies[i].distance_m == link.distance_m);
  }
}

TEST(ReadTags, GiveNothingForAnAntennaThatIsNowhere) {
  TagPopulation tags(3.5);
  tags.add(0, "A", kOrigin);
  EXPECT_TRUE(replies_of(antenna(), {std::nan(""), 0.0, 0.0}, Time{}, 1, tags).empty());
}

}  // namespace
}  // namespace tagfield
