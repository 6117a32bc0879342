// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "adapters/mcap/test/mcap_bytes.h"
#include "adapters/mcap/test/sent_messages.h"
#include "tagfield/base/error.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

using namespace mcap_test;

/// A small file with three channels and several chunks, and its contents.
struct Whole {
  std::string file;
  std::vector<Sent> messages;         ///< In chronological order, in which they were written.
  std::vector<std::size_t> chunk_of;  ///< By message number.
  std::vector<std::size_t> chunk_ends;
};

Whole whole_file(McapCompression compression) {
  const TemporaryFolder folder;
  Whole whole;
  McapOptions options;
  options.compression = compression;
  options.chunk_bytes = 200;
  McapWriter writer(folder.file("f"), options);
  std::vector<McapChannelId> ids;
  for (const char* topic : {"/a", "/b", "/unused"})
    ids.push_back(writer.add_channel(channel_of(topic)));
  for (std::uint64_t i = 0; i < 16; ++i) {
    const std::string data = "message number " + std::to_string(i);
    writer.write(ids[i % 2], 10 * i, 10 * i + 1, data);
    const auto sequence = static_cast<std::uint32_t>(i / 2);
    whole.messages.emplace_back(i % 2 == 0 ? "/a" : "/b", sequence, 10 * i, 10 * i + 1, data);
  }
  writer.finish();
  whole.file = folder.text_of("f");
  for (const RecordThere& record : records_of_file(whole.file)) {
    if (record.op != 6) continue;
    const std::uint64_t last = number_at(record.content, 8, 8);
    while (whole.chunk_of.size() < whole.messages.size() &&
           std::get<2>(whole.messages[whole.chunk_of.size()]) <= last) {
      whole.chunk_of.push_back(whole.chunk_ends.size());
    }
    whole.chunk_ends.push_back(record.offset + record.length());
  }
  return whole;
}

struct Found {
  std::vector<Sent> messages;
  std::size_t warnings = 0;
  bool is_refused = false;
};

Found read_bytes(const std::string& bytes) {
  static const TemporaryFolder folder;
  Diagnostics diagnostics;
  Found found;
  try {
    found.messages = read_all(folder.with("f", bytes), diagnostics);
  } catch (const Error&) {
    found.is_refused = true;
  }
  found.warnings = diagnostics.warnings().size();
  return found;
}

class McapDamage : public testing::TestWithParam<McapCompression> {};

TEST_P(McapDamage, OfACutFileAllWholeChunksAreRead) {
  const Whole whole = whole_file(GetParam());
  ASSERT_GE(whole.chunk_ends.size(), 4U);
  ASSERT_EQ(whole.chunk_of.size(), whole.messages.size());
  for (std::size_t size = 0; size < whole.file.size(); ++size) {
    const Found found = read_bytes(whole.file.substr(0, size));
    std::vector<Sent> expected;
    for (std::size_t i = 0; i < whole.messages.size(); ++i) {
      if (whole.chunk_ends[whole.chunk_of[i]] <= size) expected.push_back(whole.messages[i]);
    }
    ASSERT_EQ(found.messages, expected) << size;
    ASSERT_EQ(found.is_refused, size < kMagic.size()) << size;
    ASSERT_TRUE(found.warnings > 0 || found.is_refused) << size;
  }
}

/// The chunks of messages in the file that were not found.
std::set<std::size_t> lost_chunks(const Whole& whole, const std::vector<Sent>& found) {
  std::set<std::size_t> lost;
  for (std::size_t i = 0; i < whole.messages.size(); ++i) {
    if (std::find(found.begin(), found.end(), whole.messages[i]) == found.end()) {
      lost.insert(whole.chunk_of[i]);
    }
  }
  return lost;
}

TEST_P(McapDamage, AWrongByteCostsOneChunkAtMostAndIsReported) {
  const Whole whole = whole_file(GetParam());
  for (std::size_t at = 0; at < whole.file.size(); ++at) {
    for (const unsigned flip : {0x01U, 0x05U, 0x80U, 0xFFU}) {
      std::string bytes = whole.file;
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ flip);
      const Found found = read_bytes(bytes);
      ASSERT_EQ(found.is_refused, at < kMagic.size()) << at << ' ' << flip;
      if (found.is_refused) continue;
      ASSERT_GT(found.warnings, 0U) << at << ' ' << flip;
      ASSERT_LE(lost_chunks(whole, found.messages).size(), 1U) << at << ' ' << flip;
      ASSERT_TRUE(std::includes(
          whole.messages.begin(), whole.messages.end(), found.messages.begin(),
          found.messages.end(),
          [](const Sent& one, const Sent& other) { return std::get<2>(one) < std::get<2>(other); }))
          << at << ' ' << flip;
      for (const Sent& message : found.messages) {
        ASSERT_NE(std::find(whole.messages.begin(), whole.messages.end(), message),
                  whole.messages.end())
            << at << ' ' << flip;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, McapDamage,
                         testing::Values(McapCompression::kNone, McapCompression::kLz4,
                                         McapCompression::kZstd));

RC_GTEST_PROP(McapReaderOfAnything, NeverCrashes, ()) {
  std::string bytes = whole_file(*rc::gen::element(McapCompression::kNone, McapCompression::kLz4,
                                                   McapCompression::kZstd))
                          .file;
  const int flips = *rc::gen::inRange(1, 40);
  for (int flip = 0; flip < flips; ++flip) {
    bytes[*rc::gen::inRange<std::size_t>(kMagic.size(), bytes.size())] =
        *rc::gen::arbitrary<char>();
  }
  bytes.erase(*rc::gen::inRange<std::size_t>(kMagic.size(), bytes.size()),
              *rc::gen::inRange<std::size_t>(0, 30));
  (void)read_bytes(bytes);
  // Records of any kind with any content.
  std::string records;
  const int count = *rc::gen::inRange(0, 20);
  for (int i = 0; i < count; ++i) {
    records += record(*rc::gen::inRange(0, 20), *rc::gen::arbitrary<std::string>());
  }
  RC_ASSERT(!read_bytes(file_of(records)).is_refused);
}

}  // namespace
}  // namespace tagfield
