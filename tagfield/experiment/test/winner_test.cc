// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/winner.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

/// One run; a negative error stands for a tag that was not located.
BenchEntry entry_of(const std::string& name, const std::vector<double>& errors_m) {
  BenchEntry entry{"c", name, name, {}};
  MethodRun run;
  run.seed = 1;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    TagRecord tag;
    tag.tag = "tag" + std::to_string(i);
    if (errors_m[i] >= 0.0) {
      tag.verdict = Verdict::kLocated;
      tag.error = errors_m[i];
    }
    run.tags.push_back(tag);
  }
  entry.runs.push_back(run);
  return entry;
}

TEST(WinnerOf, IsTheLeastMeanErrorOfThoseThatLocateAsMany) {
  const BenchEntry all = entry_of("all", {0.01, 0.02, 0.01, 0.02});
  const BenchEntry few = entry_of("few", {0.001, 0.001, 0.001, -1.0});
  const BenchEntry worse = entry_of("worse", {0.11, 0.12, 0.11, 0.12});
  const auto winner = winner_of({&few, &worse, &all});
  ASSERT_TRUE(winner);
  EXPECT_EQ(winner->entry, &all);
  EXPECT_TRUE(winner->alike.empty());
}

TEST(WinnerOf, CountsTagsThatAreFarOffAsNotRight) {
  const BenchEntry wrong = entry_of("wrong", {0.001, 0.001, 0.001, 0.31});
  const BenchEntry right = entry_of("right", {0.2, 0.2, 0.2, 0.2});
  EXPECT_EQ(count_right(wrong), 3U);
  const auto winner = winner_of({&wrong, &right});
  ASSERT_TRUE(winner);
  EXPECT_EQ(winner->entry, &right);
}

TEST(WinnerOf, NamesThoseThatChanceMayHavePutBehindIt) {
  // Computed by hand: differences from `a` are ±2 mm and 0, with a mean of 0.5 mm and a standard
  // error of 0.96 mm, for `b`, and all 1 mm for `c`.
  const BenchEntry a = entry_of("a", {0.010, 0.010, 0.010, 0.010});
  const BenchEntry b = entry_of("b", {0.012, 0.008, 0.012, 0.010});
  const BenchEntry c = entry_of("c", {0.011, 0.011, 0.011, 0.011});
  const BenchEntry same = entry_of("same", {0.010, 0.010, 0.010, 0.010});
  const auto winner = winner_of({&a, &b, &c, &same});
  ASSERT_TRUE(winner);
  EXPECT_EQ(winner->entry, &a);
  EXPECT_EQ(winner->alike, (std::vector<const BenchEntry*>{&b, &same}));
}

TEST(WinnerOf, IsNobodyWhereNoTagIsRight) {
  const BenchEntry lost = entry_of("lost", {-1.0, -1.0});
  const BenchEntry wrong = entry_of("wrong", {1.0, 2.0});
  EXPECT_FALSE(winner_of({&lost, &wrong}));
}

}  // namespace
}  // namespace tagfield
