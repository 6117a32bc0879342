// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/field_driver.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }
RigidTransform place(double x) { return from_translation({x, 0.0, 0.0}); }

std::shared_ptr<const FieldAntenna> antenna(const std::string& name, double rate_hz) {
  auto antenna = std::make_shared<FieldAntenna>();
  antenna->parameters.name = name;
  antenna->parameters.rate_hz = rate_hz;
  return antenna;
}

TEST(FieldDriver, GivesANumberAgainOnceItsTagIsGone) {
  FieldDriver driver;
  const std::uint32_t a = driver.add_tag("a");
  const std::uint32_t b = driver.add_tag("b");
  EXPECT_NE(a, b);
  EXPECT_EQ(error_of([&] { driver.add_tag("a"); }), "there is a tag with the ID 'a' already");
  driver.remove_tag(a);
  EXPECT_EQ(driver.add_tag("a"), a);
}

TEST(FieldDriver, TellsATagFirstWhereItIsPlacedFirst) {
  FieldDriver driver;
  const std::uint32_t a = driver.add_tag("a", "shelf::a");
  EXPECT_TRUE(driver.take_step(at(0.0)).added.empty());
  driver.place_tag(a, place(std::numeric_limits<double>::quiet_NaN()), at(0.5));
  EXPECT_TRUE(driver.take_step(at(0.5)).added.empty());
  driver.place_tag(a, place(1.0), at(1.0));
  driver.place_tag(a, place(2.0), at(1.5));
  const FieldStep step = driver.take_step(at(2.0));
  ASSERT_EQ(step.added.size(), 1U);
  EXPECT_EQ(step.added[0].label, "shelf::a");
  EXPECT_EQ(step.added[0].since, at(1.0));
  ASSERT_EQ(step.moved.size(), 1U);
  EXPECT_EQ(step.moved[0].X_WT.translation.x(), 2.0);
}

TEST(FieldDriver, SaysNothingOfATagThatCameAndWentBetweenTwoSteps) {
  FieldDriver driver;
  const std::uint32_t a = driver.add_tag("a");
  driver.place_tag(a, place(1.0), at(0.0));
  driver.remove_tag(a);
  EXPECT_FALSE(driver.has_news());
}

TEST(FieldDriver, AntennasAreDueByTheirRates) {
  FieldDriver driver;
  const auto fast = antenna("fast", 10.0);
  const auto slow = antenna("slow", 4.0);
  driver.add_antenna(fast);
  driver.add_antenna(slow);
  EXPECT_EQ(driver.next_due(), std::nullopt);
  driver.start(fast, at(0.05));
  driver.start(slow, at(0.0));
  EXPECT_TRUE(contains(error_of([&] { driver.add_antenna(fast); }), "'fast'"));
  std::vector<std::string> updates;
  while (*driver.next_due() < at(0.55)) {
    const Time now = *driver.next_due();
    for (const AntennaDue& due : driver.take_due(now)) {
      updates.push_back(due.antenna->parameters.name + " " + format_stamp(now));
    }
  }
  EXPECT_EQ(updates,
            (std::vector<std::string>{"slow 0.000000000", "fast 0.100000000", "fast 0.200000000",
                                      "slow 0.250000000", "fast 0.300000000", "fast 0.400000000",
                                      "fast 0.500000000", "slow 0.500000000"}));
  driver.go_on(at(0.0));  // Time jumped back.
  EXPECT_EQ(driver.next_due(), at(0.0));
}

TEST(FieldDriver, StampsThatAreGivenGoBeforeTheRateAndEnd) {
  FieldDriver driver;
  const auto replayed = antenna("replayed", 10.0);
  driver.add_antenna(replayed);
  driver.start(replayed, at(0.0), {at(-1.0), at(0.3), at(0.7)});
  EXPECT_FALSE(driver.take_due(*driver.next_due())[0].is_last);
  EXPECT_EQ(driver.next_due(), at(0.7));
  EXPECT_TRUE(driver.take_due(at(0.7))[0].is_last);
  EXPECT_EQ(driver.next_due(), std::nullopt);
}

// Against a plain map: applying the steps' lists in their documented order gives the current tags.
RC_GTEST_PROP(FieldDriver, StepsAddUpToWhatIsThere, ()) {
  FieldDriver driver;
  std::map<std::string, std::uint32_t> present;
  std::map<std::uint32_t, std::pair<std::string, double>> reported;
  std::map<std::string, double> places;
  int made = 0;
  for (int n = 0; n < 12; ++n) {
    for (const int what : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 6))) {
      if (what < 3) {
        const std::string id = "tag" + std::to_string(made++);
        present[id] = driver.add_tag(id);
        driver.place_tag(present[id], place(what), at(n));
        places[id] = what;
      } else if (!present.empty()) {
        const auto any = present.begin();
        if (what == 3) {
          driver.remove_tag(any->second);
          places.erase(any->first);
          present.erase(any);
        } else {
          driver.place_tag(any->second, place(10.0 * n + what), at(n));
          places[any->first] = 10.0 * n + what;
        }
      }
    }
    const FieldStep step = driver.take_step(at(n));
    for (const std::uint32_t number : step.removed) RC_ASSERT(reported.erase(number) == 1U);
    for (const TagAdded& tag : step.added) {
      RC_ASSERT(reported.emplace(tag.number, std::pair(tag.id, tag.X_WT.translation.x())).second);
    }
    for (const TagMoved& tag : step.moved)
      reported.at(tag.number).second = tag.X_WT.translation.x();
    std::map<std::string, double> sum;
    for (const auto& [number, tag] : reported) sum.insert(tag);
    RC_ASSERT(sum == places);
  }
}

}  // namespace
}  // namespace tagfield
