// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_index.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
using Slots = std::vector<std::uint32_t>;

Slots within(const TagIndex& index, const Eigen::Vector3d& center, double radius) {
  Slots slots = {99};  // Must be cleared.
  index.within(center, radius, slots);
  return slots;
}

/// Same, checking every tag.
class PlainList {
 public:
  void place(std::uint32_t slot, const Eigen::Vector3d& p_WT) { tags_[slot] = p_WT; }
  void remove(std::uint32_t slot) { tags_.erase(slot); }
  [[nodiscard]] Slots within(const Eigen::Vector3d& center, double radius) const {
    Slots slots;
    for (const auto& [slot, p_WT] : tags_) {
      const double x = p_WT.x() - center.x();
      const double y = p_WT.y() - center.y();
      const double z = p_WT.z() - center.z();
      if (x * x + y * y + z * z <= radius * radius) slots.push_back(slot);
    }
    return slots;
  }
  [[nodiscard]] const std::map<std::uint32_t, Eigen::Vector3d>& tags() const { return tags_; }

 private:
  std::map<std::uint32_t, Eigen::Vector3d> tags_;
};

/// Multiples of half a metre around 0, so that tags are on cells' edges and at distances equal to
/// the radius; now and then far away.
Eigen::Vector3d any_position(std::mt19937_64& random) {
  std::uniform_int_distribution<int> halves(-40, 40);
  Eigen::Vector3d position(0.5 * halves(random), 0.5 * halves(random), 0.25 * halves(random));
  const int far = halves(random);
  if (far == 40) position.x() += 1e12;
  if (far == -40) position.y() -= 1e12;
  return position;
}

class TagIndexAgainstPlainList : public testing::TestWithParam<double> {};

TEST_P(TagIndexAgainstPlainList, AgreesThroughInsertsMovesAndRemovals) {
  std::mt19937_64 random(17);
  TagIndex index(GetParam());
  PlainList list;
  const std::vector<double> radii = {0.0, 0.5, 2.0, 7.0, 1000.0, 1e13, kInfinite};
  std::size_t found = 0;
  for (int step = 0; step < 5000; ++step) {
    const auto slot = static_cast<std::uint32_t>(random() % 150);
    if (random() % 3 == 0) {
      index.remove(slot);
      list.remove(slot);
    } else {
      const Eigen::Vector3d position = any_position(random);
      index.place(slot, position);
      list.place(slot, position);
    }
    const Eigen::Vector3d center = any_position(random);
    const double radius = radii[random() % radii.size()];
    const Slots expected = list.within(center, radius);
    ASSERT_EQ(within(index, center, radius), expected) << "step " << step << ", radius " << radius;
    found += expected.size();
  }
  EXPECT_GT(found, 10'000u);
  for (const auto& [slot, position] : list.tags()) EXPECT_EQ(index.position(slot), position);
}

INSTANTIATE_TEST_SUITE_P(Cells, TagIndexAgainstPlainList,
                         testing::Values(1e-6, 0.3, 1.0, 3.5, 100.0, 1e15));

TEST(TagIndex, FindsNothingWhenEmpty) {
  EXPECT_EQ(within(TagIndex(1.0), {0, 0, 0}, kInfinite), Slots{});
}

TEST(TagIndex, TakesTheRadiusItself) {
  TagIndex index(3.5);
  index.place(4, {-7.0, 0.0, 0.0});
  EXPECT_EQ(within(index, {0, 0, 0}, 7.0), Slots{4});
  EXPECT_EQ(within(index, {0, 0, 0}, std::nextafter(7.0, 0.0)), Slots{});
  EXPECT_EQ(within(index, {-7, 0, 0}, 0.0), Slots{4});
}

TEST(TagIndex, CountsHeight) {
  TagIndex index(1.0);
  index.place(0, {0.0, 0.0, 5.0});
  EXPECT_EQ(within(index, {0, 0, 0}, 4.9), Slots{});
  EXPECT_EQ(within(index, {0, 0, 0}, 5.1), Slots{0});
}

TEST(TagIndex, LeavesAloneWhatIsNotIn) {
  TagIndex index(1.0);
  index.remove(3);
  index.place(5, {0, 0, 0});
  index.remove(3);
  index.remove(5);
  index.remove(5);
  EXPECT_EQ(within(index, {0, 0, 0}, kInfinite), Slots{});
}

TEST(TagIndex, RefusesPositionsThatAreNone) {
  TagIndex index(1.0);
  index.place(0, {1, 2, 3});
  for (const double bad : {kNan, kInfinite, -kInfinite}) {
    EXPECT_THROW(index.place(0, {bad, 0, 0}), Error);
    EXPECT_THROW(index.place(1, {0, bad, 0}), Error);
    EXPECT_THROW(index.place(1, {0, 0, bad}), Error);
  }
  EXPECT_EQ(within(index, {1, 2, 3}, 0.0), Slots{0});
  EXPECT_EQ(within(index, {0, 0, 0}, 1e6), Slots{0});
}

TEST(TagIndex, FindsNothingAroundNoPlaceOrWithNoRadius) {
  TagIndex index(1.0);
  index.place(0, {0, 0, 0});
  EXPECT_EQ(within(index, {kNan, 0, 0}, 1.0), Slots{});
  EXPECT_EQ(within(index, {0, 0, 0}, kNan), Slots{});
  EXPECT_EQ(within(index, {0, 0, 0}, -1.0), Slots{});
}

TEST(TagIndex, RefusesCellsWithoutSize) {
  for (const double bad : {0.0, -1.0, kNan, kInfinite}) EXPECT_THROW(TagIndex{bad}, Error);
}

}  // namespace
}  // namespace tagfield
