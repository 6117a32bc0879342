#include "tagfield/field/internal/telling.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace tagfield {
namespace {

Time at_nanos(std::int64_t nanos) { return Time(Duration(nanos)); }

/// Writes down what it is told.
struct Heard final : ReadListener, PoseListener, TruthListener {
  std::vector<std::string> words;
  std::vector<Time> stamps;
  void on_read(const TagRead& read) override {
    words.push_back("read " + read.tag);
    stamps.push_back(read.stamp);
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
  }
};

struct Told {
  std::shared_ptr<Heard> heard = std::make_shared<Heard>();
  Telling telling{outlets(heard)};
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

TEST(Telling, KeepsBackReadsThatAreLaterAndPutsThemInOrder) {
  Told told;
  told.telling.add(read_at(20, "late"), 1.0);
  told.telling.add(antenna("a"), at_nanos(30), {}, std::nullopt);
  told.telling.add(read_at(10, "early"), 2.0);
  told.telling.tell(at_nanos(15));
  EXPECT_EQ(told.heard->words,
            (std::vector<std::string>{"distance early", "read early", "truth a", "update a"}));
  told.telling.add(antenna("b"), at_nanos(30), {}, RigidTransform{});
  told.telling.tell(Time::max());
  EXPECT_EQ(told.heard->words, (std::vector<std::string>{"distance early", "read early", "truth a",
                                                         "update a", "distance late", "read late",
                                                         "pose b", "truth b", "update b"}));
}

TEST(Telling, TellsNothingTwiceThoughAListenerFails) {
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
  Telling telling(outlets);
  telling.add(read_at(1, "a"), 1.0);
  EXPECT_THROW(telling.tell(Time::max()), Error);
  telling.tell(Time::max());
  EXPECT_EQ(failing->calls, 1);
}

// Against a stable sort of all: whatever comes in which order, between two calls nothing earlier
// than what was told already.
RC_GTEST_PROP(Telling, IsAStableSort, ()) {
  Told told;
  std::vector<TagRead> expected;
  std::int64_t told_until = 0;
  int made = 0;
  for (int round = 0; round < 5; ++round) {
    for (const int later : *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 30))) {
      expected.push_back(read_at(told_until + later, std::to_string(made++)));
      told.telling.add(expected.back(), 1.0);
    }
    told_until += *rc::gen::inRange(0, 20);
    told.telling.tell(at_nanos(told_until));
  }
  told.telling.tell(Time::max());
  std::stable_sort(expected.begin(), expected.end(),
                   [](const TagRead& a, const TagRead& b) { return a.stamp < b.stamp; });
  std::vector<std::string> words;
  for (const TagRead& read : expected) {
    words.push_back("distance " + read.tag);
    words.push_back("read " + read.tag);
  }
  RC_ASSERT(told.heard->words == words);
}

}  // namespace
}  // namespace tagfield
