// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/short_names.h"

#include <gtest/gtest.h>

#include <set>

#include "tagfield/report/text.h"

namespace tagfield {
namespace {

using Names = std::vector<std::string>;

TEST(ShortNames, StayDifferent) {
  EXPECT_EQ(distinct_names({"a", "left_low"}, 18), (Names{"a", "left_low"}));
  // They differ only in the middle, which is what is left out.
  const Names gates = {"dock_north_gate_one_upper_antenna", "dock_north_gate_two_upper_antenna"};
  EXPECT_EQ(shortened(gates[0], 18), shortened(gates[1], 18));
  EXPECT_EQ(distinct_names(gates, 18), (Names{"…one_upper_antenna", "…two_upper_antenna"}));
  // Also far behind what they have in common, in letters of several bytes, and in what is alike.
  for (const std::string& middle : {std::string(40, 'x'), std::string("ÄÖÜäöüÄÖÜäöüÄÖÜäöü")}) {
    Names names;
    for (const char* one : {"é", "è", "one", "two"}) {
      for (const char* other : {"1", "2"}) {
        names.push_back("gate_" + middle + one + middle + other + middle);
      }
    }
    for (const std::size_t most : {12U, 18U, 28U}) {
      const Names shown = distinct_names(names, most);
      EXPECT_EQ(std::set<std::string>(shown.begin(), shown.end()).size(), names.size());
      for (const std::string& name : shown) EXPECT_LE(length_of(name), most) << name;
    }
  }
}

TEST(ShortNames, HaveTheWholeNameAsTooltip) {
  Svg svg;
  add_short_name(svg, {0, 0}, "a…z", "a<b>z", Anchor::kEnd);
  EXPECT_NE(svg.body.find("<title>a&lt;b&gt;z</title>"), std::string::npos);
  EXPECT_NE(svg.body.find(">a…z</text>"), std::string::npos);
  Svg whole;
  add_short_name(whole, {0, 0}, "az", "az", Anchor::kEnd);
  EXPECT_EQ(whole.body.find("<title>"), std::string::npos);
}

}  // namespace
}  // namespace tagfield
