// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/read_store.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>

#include "no_more_files.h"
#include "odd_names.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/files/reads_csv.h"

namespace tagfield {
namespace {

using ByTag = std::map<std::string, std::vector<TagRead>>;

std::vector<TagRead> any_reads() {
  const auto tags = *rc::gen::nonEmpty(
      rc::gen::container<std::vector<std::string>>(rc::gen::exec([] { return odd_name(); })));
  const auto count = *rc::gen::inRange(0, 4000);
  std::vector<TagRead> reads;
  for (int i = 0; i < count; ++i) {
    TagRead read;
    read.stamp = Time(Duration(std::int64_t{1'000'000} * i));
    read.reader = i % 3 == 0 ? "" : "reader";
    read.antenna = i % 2 == 0 ? "left" : "right";
    read.tag = tags[static_cast<std::size_t>(i * i + i / 7) % tags.size()];
    read.frequency_hz = 865.7e6 + 6e5 * (i % 4);
    read.phase_rad = 1e-9 * i;
    read.rssi_dbm = -0.01 * i;
    if (i % 5 == 0) read.doppler_hz = 0.5 * i;
    reads.push_back(std::move(read));
  }
  return reads;
}

ByTag by_tag(const std::vector<TagRead>& reads) {
  ByTag tags;
  for (const TagRead& read : reads) tags[read.tag].push_back(read);
  return tags;
}

std::string text_of(const std::vector<TagRead>& reads) { return reads_to_csv(reads); }

TEST(ReadOverview, CountsWhatThereIs) {
  std::vector<TagRead> reads(3);
  reads[0].tag = reads[2].tag = "b";
  reads[1].tag = "a";
  reads[0].antenna = reads[1].antenna = reads[2].antenna = "x";
  reads[0].stamp = reads[2].stamp = Time(Duration(5));
  reads[1].stamp = Time(Duration(9));
  reads[0].frequency_hz = reads[1].frequency_hz = 1.0;
  reads[2].frequency_hz = 2.0;
  const ReadOverview overview = overview_of(reads);
  EXPECT_EQ(overview.count, 3U);
  EXPECT_EQ(overview.backwards, 1U);
  EXPECT_EQ(overview.tags, (std::vector<std::string>{"b", "a"}));
  EXPECT_EQ(overview.count_by_tag.at("b"), 2U);
  EXPECT_EQ(overview.carriers_hz.size(), 2U);
  EXPECT_EQ(overview.first, Time(Duration(5)));
  EXPECT_EQ(overview.last, Time(Duration(9)));
}

RC_GTEST_PROP(ReadStore, GivesBackEachTagsReadsInOnePart, ()) {
  const std::vector<TagRead> reads = any_reads();
  const std::size_t of_part = *rc::gen::inRange<std::size_t>(1, 2000);
  std::set<std::string> everywhere;
  if (!reads.empty() && *rc::gen::arbitrary<bool>()) everywhere.insert(reads.front().tag);
  const TemporaryFolder folder;
  ReadStore store(folder.path(), plan_parts(overview_of(reads), of_part, everywhere));
  for (const TagRead& read : reads) store.add(read);
  RC_ASSERT(std::filesystem::is_empty(folder.path()));
  const ByTag expected = by_tag(reads);
  std::map<std::string, std::size_t> found;
  for (std::size_t i = 0; i < store.parts(); ++i) {
    const ByTag part = by_tag(store.part(i, reads.size() + 1));
    std::size_t counted = 0;
    for (const auto& [tag, of_tag] : part) {
      ++found[tag];
      RC_ASSERT(text_of(of_tag) == text_of(expected.at(tag)));
      if (everywhere.count(tag) == 0) counted += of_tag.size();
    }
    // A part is no larger than requested, except for a single tag or if there would be too many
    // parts.
    const std::size_t most = std::max(of_part, reads.size() / kMaxParts + 1);
    RC_ASSERT(counted <= most || part.size() - everywhere.size() == 1U ||
              store.parts() == kMaxParts);
  }
  RC_ASSERT(found.size() == expected.size());
  for (const auto& [tag, parts] : found) {
    RC_ASSERT(parts == (everywhere.count(tag) > 0 ? store.parts() : 1U));
  }
}

TEST(ReadStore, ThinsTagsWithTooManyReads) {
  const TemporaryFolder folder;
  std::vector<TagRead> reads;
  for (int i = 0; i < 10'000; ++i) {
    TagRead read;
    read.tag = i % 10 == 0 ? "few" : "many";
    read.rssi_dbm = i;
    reads.push_back(read);
  }
  ReadStore store(folder.path(), plan_parts(overview_of(reads), 100'000, {}));
  for (const TagRead& read : reads) store.add(read);
  const ByTag part = by_tag(store.part(0, 3000));
  EXPECT_EQ(part.at("few").size(), 1000U);
  ASSERT_EQ(part.at("many").size(), 3000U);
  EXPECT_EQ(part.at("many")[0].rssi_dbm, 1.0);
  EXPECT_EQ(part.at("many")[1].rssi_dbm, 4.0);
}

TEST(ReadStore, SaysWhereItCannotKeepReads) {
  const std::string missing = (folder_of_test().path() / "missing").string();
  EXPECT_NE(error_of([&] { ReadStore(missing, {}); }).find(missing + ": reads that don't fit"),
            std::string::npos);
  const NoMoreFiles none;
  EXPECT_NE(error_of([&] { ReadStore(folder_of_test().path(), {}); }).find("can't be kept there"),
            std::string::npos);
}

}  // namespace
}  // namespace tagfield
