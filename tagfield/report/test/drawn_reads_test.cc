// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/drawn_reads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/files/reads_csv.h"

namespace tagfield {
namespace {

/// Two antennas: "moving" reads tag 7 in every second row, others rarely; "fixed" reads tag 3.
std::vector<TagRead> many_reads(int count) {
  std::vector<TagRead> reads;
  for (int i = 0; i < count; ++i) {
    TagRead read;
    read.stamp = Time(Duration(std::int64_t{1'000'000} * i));
    read.antenna = i % 10 == 9 ? "fixed" : "moving";
    read.tag = i % 10 == 9 ? "3" : (i % 2 == 0 ? "7" : std::to_string(i % 13));
    read.frequency_hz = 865.7e6;
    read.rssi_dbm = -50.0;
    reads.push_back(std::move(read));
  }
  return reads;
}

std::size_t count_of(const std::vector<TagRead>& reads, const std::string& antenna,
                     const std::string& tag) {
  return static_cast<std::size_t>(std::count_if(
      reads.begin(), reads.end(),
      [&](const TagRead& read) { return read.antenna == antenna && read.tag == tag; }));
}

TEST(DrawnReads, AreAllWhereTheyFit) {
  const std::vector<TagRead> reads = many_reads(5000);
  const std::string file = folder_of_test().with("reads.csv", reads_to_csv(reads));
  for (const std::size_t most : {std::size_t{5000}, std::size_t{1'000'000}}) {
    const DrawnReads drawn = read_drawn(file, most);
    EXPECT_EQ(drawn.of, 5000U);
    EXPECT_EQ(reads_to_csv(drawn.reads), reads_to_csv(reads));
  }
}

TEST(DrawnReads, AreTheBusiestTagsAllTagsEndsAndAShareOfTheOthers) {
  const std::vector<TagRead> reads = many_reads(30'000);
  const std::string file = folder_of_test().with("reads.csv", reads_to_csv(reads));
  const std::size_t most = 29'999;
  const std::size_t of_7 = count_of(reads, "moving", "7");
  ASSERT_GT(of_7, most / 2);  // Too many to keep together with the fixed one's.
  const DrawnReads drawn = read_drawn(file, most);
  EXPECT_EQ(drawn.of, 30'000U);
  EXPECT_LE(drawn.reads.size(), most);
  EXPECT_GT(drawn.reads.size(), most / 2);
  std::map<std::string, Time> first;
  std::map<std::string, Time> last;
  for (const TagRead& read : reads) {
    first.try_emplace(read.tag, read.stamp);
    last[read.tag] = read.stamp;
  }
  for (const auto& [tag, stamp] : first) {
    const auto of_tag = [&](Time at) {
      return std::any_of(drawn.reads.begin(), drawn.reads.end(), [&, name = tag](const auto& read) {
        return read.tag == name && read.stamp == at;
      });
    };
    EXPECT_TRUE(of_tag(stamp)) << tag;
    EXPECT_TRUE(of_tag(last[tag])) << tag;
  }
}

TEST(DrawnReads, HaveTheBusiestTagsWithoutAGap) {
  std::vector<TagRead> reads = many_reads(30'000);
  for (std::size_t i = 0; i < reads.size(); ++i) {
    if (reads[i].tag == "7" && i % 8 != 0) reads[i].tag = "many" + std::to_string(i % 1009);
  }
  const std::string file = folder_of_test().with("reads.csv", reads_to_csv(reads));
  const DrawnReads drawn = read_drawn(file, 20'000);
  EXPECT_LE(drawn.reads.size(), 20'000U);
  EXPECT_EQ(count_of(drawn.reads, "moving", "7"), count_of(reads, "moving", "7"));
  EXPECT_EQ(count_of(drawn.reads, "fixed", "3"), count_of(reads, "fixed", "3"));
  EXPECT_TRUE(std::is_sorted(drawn.reads.begin(), drawn.reads.end(),
                             [](const auto& a, const auto& b) { return a.stamp < b.stamp; }));
}

}  // namespace
}  // namespace tagfield
