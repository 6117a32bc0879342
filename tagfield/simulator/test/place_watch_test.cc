// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/place_watch.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

/// A glance every 0.1 s, from 0 on; the robot drives at 0.5 m/s.
class Looks {
 public:
  void go_on(double seconds, bool knows_position, double off_m, double off_rad = 0.0) {
    for (int i = 0; i < static_cast<int>(seconds * 10.0 + 0.5); ++i, ++count_) {
      const double now = 0.1 * count_;
      watch.look({time_from_seconds(now), 0.5 * now, knows_position, off_m, off_rad});
    }
  }
  PlaceWatch watch;

 private:
  int count_ = 0;
};

TEST(PlaceWatch, TimesAnUnknownStart) {
  Looks looks;
  looks.watch.put(PositionLoss::kStart);
  looks.go_on(8.0, false, 4.0);
  looks.go_on(5.0, true, 0.02);
  ASSERT_EQ(looks.watch.findings().size(), 1U);
  const Finding& finding = looks.watch.findings().front();
  EXPECT_EQ(finding.why, PositionLoss::kStart);
  EXPECT_TRUE(finding.noticed);
  EXPECT_NEAR(finding.seconds.value(), 8.0, 1e-9);
  EXPECT_NEAR(finding.driven_m, 4.0, 1e-9);
  EXPECT_EQ(finding.wrong, 0);
}

TEST(PlaceWatch, CountsWrongPlaces) {
  Looks looks;
  looks.watch.put(PositionLoss::kStart);
  looks.go_on(2.0, false, 4.0);
  looks.go_on(3.0, true, 4.0);  // Elsewhere,
  looks.go_on(1.0, false, 4.0);
  looks.go_on(3.0, true, 0.1, 3.14);  // the right position with a reversed heading,
  looks.go_on(1.0, false, 4.0);
  looks.go_on(0.5, true, 0.1);  // right, but not for long,
  looks.go_on(1.0, false, 0.1);
  looks.go_on(3.0, true, 0.1);
  ASSERT_EQ(looks.watch.findings().size(), 1U);
  EXPECT_EQ(looks.watch.findings()[0].wrong, 2);
  EXPECT_NEAR(looks.watch.findings()[0].seconds.value(), 11.5, 1e-9);
}

TEST(PlaceWatch, TellsKidnappingsApart) {
  Looks looks;
  looks.go_on(2.0, true, 0.01);
  looks.watch.put(PositionLoss::kKidnapped);
  looks.go_on(3.0, true, 5.0);  // It does not notice yet. That is not a wrong finding.
  looks.go_on(4.0, false, 5.0);
  looks.go_on(2.0, true, 0.01);
  looks.go_on(1.0, false, 0.01);  // It loses its pose by itself,
  looks.go_on(2.0, true, 0.01);
  looks.watch.put(PositionLoss::kKidnapped);
  looks.go_on(2.0, true, 3.0);  // and never notices the second kidnapping.
  const std::vector<Finding>& findings = looks.watch.findings();
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_EQ(findings[0].why, PositionLoss::kKidnapped);
  EXPECT_TRUE(findings[0].noticed);
  EXPECT_EQ(findings[0].wrong, 0);
  EXPECT_NEAR(findings[0].seconds.value(), 7.0, 1e-9);
  EXPECT_EQ(findings[1].why, PositionLoss::kLost);
  EXPECT_NEAR(findings[1].seconds.value(), 1.0, 1e-9);
  EXPECT_FALSE(findings[2].noticed);
  EXPECT_FALSE(findings[2].seconds.has_value());
}

TEST(PlaceWatch, HasNothingToTellOfOneThatKnows) {
  Looks looks;
  looks.go_on(5.0, true, 0.01);
  EXPECT_TRUE(looks.watch.findings().empty());
}

}  // namespace
}  // namespace tagfield
