// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/spelling.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace tagfield {
namespace {

/// The definition of the distance, evaluated recursively without a table.
std::size_t by_definition(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  const std::string_view a1 = a.substr(1);
  const std::string_view b1 = b.substr(1);
  std::size_t least = std::min(by_definition(a1, b), by_definition(a, b1)) + 1;
  least = std::min(least, by_definition(a1, b1) + (a[0] == b[0] ? 0 : 1));
  if (!a1.empty() && !b1.empty() && a[0] == b[1] && a[1] == b[0]) {
    least = std::min(least, by_definition(a.substr(2), b.substr(2)) + 1);
  }
  return least;
}

std::string short_word() {
  const auto size = *rc::gen::inRange<std::size_t>(0, 7);
  return *rc::gen::container<std::string>(size, rc::gen::inRange('a', 'd'));
}

TEST(EditDistance, OfKnownPairs) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("saturday", "sunday"), 3u);
  EXPECT_EQ(edit_distance("frequency", "frequnecy"), 1u);
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);  // 2 by the unrestricted distance.
  EXPECT_EQ(edit_distance("", "abc"), 3u);
}

RC_GTEST_PROP(EditDistance, IsThatOfTheDefinition, ()) {
  const std::string a = short_word();
  const std::string b = short_word();
  RC_ASSERT(edit_distance(a, b) == by_definition(a, b));
}

RC_GTEST_PROP(EditDistance, IsSymmetricBoundedAndZeroOnlyForEquals, ()) {
  const auto a = *rc::gen::arbitrary<std::string>();
  const auto b = *rc::gen::arbitrary<std::string>();
  const std::size_t distance = edit_distance(a, b);
  RC_ASSERT(distance == edit_distance(b, a));
  RC_ASSERT((distance == 0) == (a == b));
  RC_ASSERT(distance <= std::max(a.size(), b.size()));
  RC_ASSERT(distance >= std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
  RC_ASSERT(edit_distance(a, a) == 0u);
}

TEST(NearestWord, IsTheNearest) {
  const std::vector<std::string> known = {"range", "rate", "frequency"};
  EXPECT_EQ(nearest_word("frequnecy", known), "frequency");
  EXPECT_EQ(nearest_word("rnage", known), "range");
  EXPECT_EQ(nearest_word("rate", known), "rate");
}

TEST(NearestWord, IsNoneWhereOverHalfDiffers) {
  EXPECT_EQ(nearest_word("abcd", {"abxy"}), "abxy");
  EXPECT_EQ(nearest_word("abcd", {"axyz"}), "");
  EXPECT_EQ(nearest_word("x", {"frequency"}), "");
  EXPECT_EQ(nearest_word("x", {}), "");
}

TEST(Suggestion, NamesTheNearestOrAll) {
  EXPECT_EQ(suggestion("frequnecy", {"range", "frequency"}), " (did you mean 'frequency'?)");
  EXPECT_EQ(suggestion("zzz", {"range", "frequency"}), " (known: range, frequency)");
  EXPECT_EQ(suggestion("zzz", {}), "");
}

}  // namespace
}  // namespace tagfield
