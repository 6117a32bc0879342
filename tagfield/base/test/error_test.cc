#include "tagfield/base/error.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

using Lines = std::vector<std::string>;

TEST(Location, IsFileAndLineAsFarAsKnown) {
  EXPECT_EQ(to_string(Location{"a.csv", 3}), "a.csv:3");
  EXPECT_EQ(to_string(Location{"a.csv", 0}), "a.csv");
  EXPECT_EQ(to_string(Location{"a.csv", -1}), "a.csv");
  EXPECT_EQ(to_string(Location{"", 3}), "");
}

TEST(Fail, PutsThePlaceFirst) {
  EXPECT_EQ(error_of([] { fail({"a.csv", 3}, "is odd"); }), "a.csv:3: is odd");
  EXPECT_EQ(error_of([] { fail({"a.csv", 0}, "is odd"); }), "a.csv: is odd");
  EXPECT_EQ(error_of([] { fail({}, "is odd"); }), "is odd");
}

TEST(Diagnostics, BeginEmpty) { EXPECT_TRUE(Diagnostics().warnings().empty()); }

TEST(Diagnostics, KeepTheOrderAndEachOnce) {
  Diagnostics diagnostics;
  diagnostics.warn("b");
  diagnostics.warn("a");
  diagnostics.warn("b");
  EXPECT_EQ(diagnostics.warnings(), (Lines{"b", "a"}));
}

TEST(Diagnostics, TellPlacesApart) {
  Diagnostics diagnostics;
  diagnostics.warn({"w.sdf", 1}, "odd");
  diagnostics.warn({"w.sdf", 2}, "odd");
  diagnostics.warn({"w.sdf", 1}, "odd");
  EXPECT_EQ(diagnostics.warnings(), (Lines{"w.sdf:1: odd", "w.sdf:2: odd"}));
}

}  // namespace
}  // namespace tagfield
