// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/tag_memories.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

/// Tag 3 with power from 0 s on, and B in all sessions from 1 s on.
TagMemories inventoried_tag() {
  TagMemories memories({2.0, 10.0});
  memories.power_on(3, at(0.0));
  for (const Session session : {Session::kS0, Session::kS1, Session::kS2, Session::kS3}) {
    memories.set_flag(3, session, Flag::kB, at(1.0));
  }
  return memories;
}

TEST(TagMemories, TagsBeginWithoutPowerInA) {
  const TagMemories memories;
  EXPECT_FALSE(memories.powered(5));
  EXPECT_EQ(memories.flag(5, Session::kS2, at(0.0)), Flag::kA);
}

TEST(TagMemories, S1FallsBackWithPowerToo) {
  const TagMemories memories = inventoried_tag();
  EXPECT_EQ(memories.flag(3, Session::kS1, at(2.999999999)), Flag::kB);
  EXPECT_EQ(memories.flag(3, Session::kS1, at(3.0)), Flag::kA);
  EXPECT_EQ(memories.falls_back(3, Session::kS1), at(3.0));
}

TEST(TagMemories, TheOthersLastWhileThereIsPower) {
  const TagMemories memories = inventoried_tag();
  for (const Session session : {Session::kS0, Session::kS2, Session::kS3}) {
    EXPECT_EQ(memories.flag(3, session, at(1e6)), Flag::kB);
    EXPECT_EQ(memories.falls_back(3, session), Time::max());
  }
}

TEST(TagMemories, WithoutPowerS0IsLostAtOnceAndS2LastsAWhile) {
  TagMemories memories = inventoried_tag();
  memories.power_off(3, at(1.5));
  EXPECT_EQ(memories.flag(3, Session::kS0, at(1.5)), Flag::kA);
  EXPECT_EQ(memories.flag(3, Session::kS1, at(2.9)), Flag::kB);
  EXPECT_EQ(memories.flag(3, Session::kS1, at(3.0)), Flag::kA);
  for (const Session session : {Session::kS2, Session::kS3}) {
    EXPECT_EQ(memories.flag(3, session, at(11.499999999)), Flag::kB);
    EXPECT_EQ(memories.flag(3, session, at(11.5)), Flag::kA);
  }
}

TEST(TagMemories, PowerInTimeKeepsS2AndTooLateDoesNot) {
  TagMemories memories = inventoried_tag();
  memories.power_off(3, at(2.0));
  memories.power_on(3, at(11.0));
  EXPECT_EQ(memories.flag(3, Session::kS2, at(100.0)), Flag::kB);
  memories.power_off(3, at(100.0));
  memories.power_on(3, at(111.0));
  EXPECT_EQ(memories.flag(3, Session::kS2, at(111.0)), Flag::kA);
}

TEST(TagMemories, OneOfTwoAntennasIsEnough) {
  TagMemories memories = inventoried_tag();
  memories.power_on(3, at(2.0));
  memories.power_off(3, at(3.0));
  EXPECT_TRUE(memories.powered(3));
  EXPECT_EQ(memories.flag(3, Session::kS0, at(4.0)), Flag::kB);
  memories.power_off(3, at(5.0));
  EXPECT_FALSE(memories.powered(3));
  memories.power_off(3, at(5.0));
  memories.power_on(3, at(6.0));
  EXPECT_TRUE(memories.powered(3));
}

TEST(TagMemories, AForgottenTagsSlotIsLikeNew) {
  TagMemories memories = inventoried_tag();
  const std::uint64_t version = memories.version();
  memories.forget(3);
  EXPECT_FALSE(memories.powered(3));
  EXPECT_EQ(memories.flag(3, Session::kS2, at(1.0)), Flag::kA);
  EXPECT_GT(memories.version(), version);
}

TEST(TagMemories, BadPersistenceIsNamedWithItsRange) {
  EXPECT_EQ(error_of([] { check(Persistence{6.0, 10.0}); }), "s1 must be from 0.5 to 5 s, is 6");
  EXPECT_EQ(error_of([] {
              TagMemories memories({2.0, 1.0});
            }),
            "s2_s3 must be from 2 to 1e+09 s, is 1");
}

}  // namespace
}  // namespace tagfield
