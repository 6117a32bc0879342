// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tagfield/base/error.h"
#include "tagfield/localization/problem.h"

namespace tagfield {
namespace {

using Eigen::Vector2d;

Candidate candidate(double x, double y, double expected = 0.01) {
  Candidate of;
  of.p_WT = {x, y, 0.0};
  of.expected_error_m = expected;
  return of;
}

TagEstimate two_sided() {
  TagEstimate estimate;
  estimate.verdict = Verdict::kAmbiguous;
  estimate.reason = "two";
  estimate.candidates = {candidate(1.0, -2.0), candidate(1.0, 2.0)};
  return estimate;
}

TEST(TagArea, SidesOfAWay) {
  const Vector2d middle(1.0, 1.0);
  const Vector2d along = Vector2d(1.0, 1.0).normalized();
  const Vector2d above(0.0, 3.0);
  const Vector2d below(3.0, 0.0);
  for (const char* word : {"left", "-x", "+y"}) {
    EXPECT_TRUE(is_within({tag_side(word), {}}, middle, along, above)) << word;
    EXPECT_FALSE(is_within({tag_side(word), {}}, middle, along, below)) << word;
  }
  for (const char* word : {"right", "+x", "-y"}) {
    EXPECT_FALSE(is_within({tag_side(word), {}}, middle, along, above)) << word;
    EXPECT_TRUE(is_within({tag_side(word), {}}, middle, along, below)) << word;
  }
  // Sides by axis don't depend on the direction of travel.
  EXPECT_TRUE(is_within({tag_side("+y"), {}}, middle, -along, above));
  EXPECT_FALSE(is_within({tag_side("left"), {}}, middle, -along, above));
  EXPECT_THROW(tag_side("up"), Error);
}

TEST(TagArea, WayIsTheLongestExtentFromTheFirstPlaceOn) {
  const PathLine way = path_line({{0.0, 0.0}, {0.5, 0.1}, {2.0, 0.0}, {1.0, 0.0}});
  EXPECT_NEAR((way.middle - Vector2d(1.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((way.along - Vector2d(1.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(TagArea, OneOfTwoMirrorImagesIsAPlace) {
  TagEstimate estimate = two_sided();
  keep_within({TagSide::kLeft, {}}, {}, 0.15, estimate);
  EXPECT_EQ(estimate.verdict, Verdict::kLocated);
  ASSERT_EQ(estimate.candidates.size(), 1U);
  EXPECT_GT(estimate.candidates.front().p_WT.y(), 0.0);
  EXPECT_EQ(estimate.reason, "");
}

TEST(TagArea, NoneWithinIsNoPlace) {
  TagEstimate estimate = two_sided();
  keep_within({std::nullopt, Eigen::AlignedBox2d(Vector2d(5.0, 5.0), Vector2d(6.0, 6.0))}, {}, 0.15,
              estimate);
  EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
  EXPECT_TRUE(estimate.candidates.empty());
}

TEST(TagArea, APoorPlaceThatIsLeftIsNone) {
  TagEstimate estimate = two_sided();
  estimate.candidates[1].expected_error_m = 0.3;
  keep_within({TagSide::kLeft, {}}, {}, 0.15, estimate);
  EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
}

}  // namespace
}  // namespace tagfield
