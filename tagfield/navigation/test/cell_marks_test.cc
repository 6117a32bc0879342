// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/internal/cell_marks.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

namespace tagfield {
namespace {

constexpr double kTouch = 1e-9;

/// Range of fractions of the segment that lies within the cell: from, to; to < from if none does.
std::pair<double, double> share_within(const Eigen::Vector2d& a, const Eigen::Vector2d& b, int x,
                                       int y) {
  const Eigen::Vector2d low(x, y);
  double from = 0.0;
  double to = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double way = b[axis] - a[axis];
    if (way == 0.0) {
      if (a[axis] < low[axis] || a[axis] >= low[axis] + 1.0) return {1.0, 0.0};
      continue;
    }
    const double one = (low[axis] - a[axis]) / way;
    const double other = (low[axis] + 1.0 - a[axis]) / way;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return {from, to};
}

RC_GTEST_PROP(CellMarks, AreTheCellsThatTheRayClips, ()) {
  const auto place = [] { return 1e-3 * *rc::gen::inRange(-9000, 9000); };
  const Eigen::Vector2d from(place(), place());
  const Eigen::Vector2d to(place(), place());
  const double last = 1e-2 * *rc::gen::inRange(1, 101);
  RC_PRE(from != to);
  CellMarks marks({-10, -10}, {10, 10});
  const CellMarks::Ray ray{to, last};
  marks.mark_rays(from, {&ray, 1});
  for (int y = -10; y <= 10; ++y) {
    for (int x = -10; x <= 10; ++x) {
      const auto [begin, end] = share_within(from, to, x, y);
      const bool is_marked = marks.row(y)[x + 10] != 0;
      if (std::min(end, last) - begin > kTouch) RC_ASSERT(is_marked);
      if (is_marked) RC_ASSERT(end - begin > -kTouch && begin < last + kTouch);
    }
  }
}

TEST(CellMarks, ARayAlongARowMarksItAlone) {
  CellMarks marks({0, 0}, {5, 2});
  const CellMarks::Ray ray{{4.5, 1.5}, 1.0};
  marks.mark_rays({1.5, 1.5}, {&ray, 1});
  const std::string expected("\0\1\1\1\1\0", 6);
  EXPECT_EQ(std::string(marks.row(1), 6), expected);
  EXPECT_EQ(std::count(marks.marked.begin(), marks.marked.end(), 1), 4);
}

RC_GTEST_PROP(CellMarks, OfManyRaysAreThoseOfEachRay, ()) {
  const auto place = [] { return 1e-3 * *rc::gen::inRange(-9000, 9000); };
  const Eigen::Vector2d from(place(), place());
  std::vector<CellMarks::Ray> rays;
  for (int count = *rc::gen::inRange(1, 30); count > 0; --count) {
    rays.push_back({{place(), place()}, 1e-2 * *rc::gen::inRange(1, 101)});
  }
  CellMarks together({-10, -10}, {10, 10});
  together.mark_rays(from, rays);
  CellMarks each({-10, -10}, {10, 10});
  for (const CellMarks::Ray& ray : rays) each.mark_rays(from, {&ray, 1});
  RC_ASSERT(together.marked == each.marked);
}

}  // namespace
}  // namespace tagfield
