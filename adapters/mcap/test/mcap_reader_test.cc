// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/mcap_reader.h"

#include <gtest/gtest.h>
#include <lz4frame.h>
#include <sys/stat.h>
#include <zstd.h>

#include "adapters/mcap/test/mcap_bytes.h"
#include "adapters/mcap/test/sent_messages.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

// Files as other programs may have written them.
namespace tagfield {
namespace {

using namespace mcap_test;
using Texts = std::vector<std::string>;

const std::string kDefinitions = schema(1, "S", "x") + channel(1, 1, "/a") + channel(2, 0, "/b");

struct Read {
  Texts bytes;  ///< Of the messages, in the order received.
  Texts warnings;
};

Read read(const std::string& file) {
  Diagnostics diagnostics;
  Read found;
  for (const Sent& sent : read_all(folder_of_test().with("f", file), diagnostics)) {
    found.bytes.push_back(std::get<4>(sent));
  }
  found.warnings = diagnostics.warnings();
  return found;
}

/// The first warning, without the file's name.
std::string warning_of(const std::string& file) {
  const Texts warnings = read(file).warnings;
  return warnings.empty() ? "(none)" : warnings.front().substr(folder_of_test().file("f").size());
}

std::string zstd(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  return out;
}

std::string lz4(const std::string& bytes) {
  std::string out(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  return out;
}

TEST(McapReader, ReadsMessagesOutsideOfChunks) {
  const Read found = read(file_of(kDefinitions + message(1, 5, "later") + message(2, 3, "earlier") +
                                  message(1, 3, "of the same time")));
  EXPECT_EQ(found.bytes, (Texts{"earlier", "of the same time", "later"}));
  EXPECT_EQ(found.warnings, Texts{});
  Diagnostics diagnostics;
  const McapReader reader(folder_of_test().file("f"), diagnostics);
  EXPECT_EQ(reader.message_count(1), 2U);
  EXPECT_EQ(reader.message_count(2), 1U);
  EXPECT_EQ(reader.message_count(3), 0U);
}

TEST(McapReader, ReadsChunksThatOverlap) {
  const Read found =
      read(file_of(chunk(kDefinitions + message(1, 1, "1") + message(1, 9, "9")) +
                   chunk(message(2, 8, "8") + message(2, 2, "2")) + message(1, 5, "5") +
                   chunk(message(1, 9, "9 again") + message(1, 2, "2 again"))));
  EXPECT_EQ(found.bytes, (Texts{"1", "2", "2 again", "5", "8", "9", "9 again"}));
  EXPECT_EQ(found.warnings, Texts{});
}

TEST(McapReader, ReadsEachCompression) {
  const std::string records = kDefinitions + message(1, 1, std::string(1000, 'x'));
  const std::size_t middle = records.size() / 2;
  const std::string first = records.substr(0, middle);
  const std::string second = records.substr(middle);
  for (const std::string& one :
       {chunk("zstd", zstd(records), records.size(), crc(records)),
        chunk("zstd", zstd(first) + zstd(second), records.size(), 0),
        chunk("lz4", lz4(records), records.size(), crc(records)),
        chunk("lz4", lz4(first) + lz4(second), records.size(), 0), chunk(records)}) {
    const Read found = read(file_of(one));
    EXPECT_EQ(found.bytes, Texts{std::string(1000, 'x')});
    EXPECT_EQ(found.warnings, Texts{});
  }
}

TEST(McapReader, LeavesOutChunksThatAreWrong) {
  const std::string records = message(1, 1, "x");
  const std::size_t size = records.size();
  const std::uint32_t right = crc(records);
  const std::vector<std::pair<std::string, std::string>> cases = {
      {chunk("", records, size, right + 1), "its CRC is wrong"},
      {chunk("", records, size + 1, right), "its size is wrong"},
      {chunk("bz2", records, size, right), "its compression is unknown"},
      {chunk("zstd", records, size, right), "it is not Zstandard of the stated size"},
      {chunk("zstd", zstd(records), size - 1, right), "it is not Zstandard of the stated size"},
      {chunk("zstd", zstd(records), size + 1, right), "it does not decompress to its size"},
      {chunk("lz4", records, size, right), "it is not LZ4"},
      {chunk("lz4", lz4(records), size - 1, right), "it does not decompress to its size"},
      {chunk("lz4", lz4(records), size + 1, right), "it does not decompress to its size"},
      {chunk("lz4", lz4(records).substr(0, 20), size, right), "it does not decompress to its size"},
      {chunk("zstd", zstd(records), kMaxMcapChunkBytes + 1, right), "it is longer than 256 MB"},
      {chunk("zstd", zstd(records), ~std::uint64_t{0}, right), "it is longer than 256 MB"},
      {record(6, ""), "it goes beyond its end"},
  };
  const std::string before = chunk(kDefinitions + message(1, 0, "before"));
  for (const auto& [wrong, says] : cases) {
    const Read found = read(file_of(before + wrong + chunk(message(1, 2, "after"))));
    EXPECT_EQ(found.bytes, (Texts{"before", "after"})) << says;
    ASSERT_EQ(found.warnings.size(), 1U) << says;
    const auto at = kMagic.size() + 17 + before.size();
    EXPECT_TRUE(contains(found.warnings[0],
                         ": byte " + std::to_string(at) + ": a chunk is left out: " + says))
        << found.warnings[0];
  }
}

TEST(McapReader, TakesWhatLaterVersionsMayAdd) {
  const std::string longer =
      record(3, le(9, 2) + text("T") + text("") + text("") + "more fields") +
      record(4, le(9, 2) + le(9, 2) + text("/t") + text("cdr") + text("") + "more fields");
  const std::string unknown = record(0x10, "new") + record(0x7F, "") + record(0xFF, "of someone");
  const std::string attachment = record(9, le(0, 16) + text("a") + text("b") + le(3, 8) + "abc");
  const Read found =
      read(file_of(unknown + attachment + record(12, text("name") + text("")) +
                   chunk(unknown + longer + message(9, 1, "x")) + record(7, "index of no use")));
  EXPECT_EQ(found.bytes, Texts{"x"});
  EXPECT_EQ(found.warnings, Texts{});
}

TEST(McapReader, WarnsOfDefinitionsThatAreWrong) {
  const std::string good = kDefinitions + message(1, 1, "x");
  EXPECT_EQ(warning_of(file_of(good + schema(1, "T", "x"))),
            ": byte 149: it differs from an earlier schema of its id, and is left out");
  EXPECT_TRUE(
      contains(warning_of(file_of(good + channel(1, 1, "/c"))), "earlier channel of its id"));
  EXPECT_TRUE(contains(warning_of(file_of(good + schema(0, "T", "x"))), "a schema has the id 0"));
  EXPECT_TRUE(contains(warning_of(file_of(record(3, "?") + good)), "a schema is broken"));
  EXPECT_TRUE(
      contains(warning_of(file_of(record(4, le(1, 4) + le(99, 4)) + good)), "a channel is broken"));
  EXPECT_TRUE(contains(warning_of(file_of(good + record(5, "?"))), "a message is broken"));
  EXPECT_EQ(warning_of(file_of(good + channel(3, 7, "/c"))),
            ": channel 3 has a schema that the file lacks");
  const Read found = read(file_of(good + message(9, 2, "y") + message(9, 3, "z")));
  EXPECT_EQ(found.bytes, Texts{"x"});
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_TRUE(contains(found.warnings[0], "2 messages of channel 9, which the file lacks"));
}

TEST(McapReader, SaysOnlySoMuchOfOneFile) {
  std::string records;
  for (int i = 0; i < 1000; ++i) records += record(5, "?");
  const Read found = read(file_of(records));
  ASSERT_EQ(found.warnings.size(), 21U);
  EXPECT_TRUE(contains(found.warnings.back(), "further faults are not listed"));
}

TEST(McapReader, WarnsOfAWrongCrcOfTheData) {
  std::string file = file_of(kDefinitions + message(1, 1, "right"));
  file[file.find("right")] = 'l';
  Read found = read(file);
  EXPECT_EQ(found.bytes, Texts{"light"});
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_TRUE(contains(found.warnings[0], "the data's CRC is wrong"));
  // If there are chunks, it may be a remnant of one.
  file = file_of(chunk(kDefinitions + message(1, 1, "x")) + message(1, 1, "right"));
  file[file.find("right")] = 'l';
  found = read(file);
  EXPECT_EQ(found.bytes, Texts{"x"});
  EXPECT_EQ(found.warnings.size(), 2U);
}

// A chunk of zeros claims to be small, and a length claims to be huge.
TEST(McapReader, BelievesNoSizes) {
  const std::string bomb = zstd(std::string(300'000'000, '\0'));
  EXPECT_TRUE(contains(warning_of(file_of(chunk("zstd", bomb, 100, 0))),
                       "not Zstandard of the stated size"));
  EXPECT_TRUE(
      contains(warning_of(file_of(chunk("zstd", bomb, 300'000'000, 0))), "longer than 256 MB"));
  for (const std::uint64_t length : {std::uint64_t{1} << 20U, std::uint64_t{1} << 40U,
                                     ~std::uint64_t{0}, ~std::uint64_t{0} - 8}) {
    for (int op = 1; op < 17; ++op) {
      const std::string head = le(static_cast<std::uint64_t>(op), 1) + le(length, 8);
      EXPECT_TRUE(contains(warning_of(file_of(head)), "is cut off or broken here")) << op;
    }
  }
}

TEST(McapReader, RefusesMoreDefinitionsThanItCanHold) {
  std::string records;
  for (int id = 1; id <= 9; ++id) records += schema(id, "S", std::string(8'000'000, 'x'));
  const std::string path =
      folder_of_test().with("f", file_of(chunk("zstd", zstd(records), records.size(), 0)));
  Diagnostics diagnostics;
  EXPECT_TRUE(contains(error_of([&] { McapReader reader(path, diagnostics); }),
                       path + ": its schemas and channels take more than"));
}

TEST(McapReader, RefusesMoreOverlapThanItCanHold) {
  const std::string filler(100'000'000, 'x');
  const std::string records = channel(1, 0, "/a") + message(1, 1, filler) + message(1, 9, filler);
  const std::string one = chunk("zstd", zstd(records), records.size(), 0);
  const std::string path = folder_of_test().with("f", file_of(one + one + one));
  Diagnostics diagnostics;
  McapReader reader(path, diagnostics);
  EXPECT_EQ(reader.message_count(1), 6U);
  EXPECT_EQ(error_of([&] { reader.read([](const McapMessage&) {}); }),
            path + ": has chunks of more than 512 MB that overlap in time");
}

TEST(McapReader, RefusesWhatIsNoMcapFile) {
  const TemporaryFolder& folder = folder_of_test();
  const auto error = [&](const std::string& path) {
    Diagnostics diagnostics;
    return error_of([&] { McapReader reader(path, diagnostics); });
  };
  EXPECT_TRUE(contains(error(folder.file("no")), "no: no such file"));
  EXPECT_TRUE(contains(error(folder.path().string()), "is a folder"));
  EXPECT_TRUE(contains(error("/dev/zero"), "a device"));
  EXPECT_TRUE(contains(error(folder.with("empty", "")), "is not an MCAP file"));
  EXPECT_TRUE(contains(error(folder.with("bag", "#ROSBAG V2.0\n")), "is not an MCAP file"));
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(contains(error(pipe), "a pipe"));
}

TEST(McapReader, TellsTheMessagesThatAreWanted) {
  const TemporaryFolder& folder = folder_of_test();
  const std::string large(3'000'000, '8');  // More than is read in one go.
  const std::string unwanted = chunk(message(2, 2, "2") + message(2, 8, large));
  const std::string begin =
      chunk(kDefinitions + message(1, 1, "1") + message(2, 3, "3") + message(1, 9, "9"));
  const std::string end = chunk(message(1, 5, "5")) + message(2, 6, "6") + message(1, 7, "7");
  const std::string file = file_of(begin + unwanted + end);
  Diagnostics diagnostics;
  McapReader reader(folder.with("f", file), diagnostics);
  const auto texts_of = [&reader](const std::set<McapChannelId>& wanted) {
    Texts texts;
    reader.read(wanted, [&](const McapMessage& message) { texts.emplace_back(message.bytes); });
    return texts;
  };
  EXPECT_EQ(texts_of({1}), (Texts{"1", "5", "7", "9"}));
  EXPECT_EQ(texts_of({2}), (Texts{"2", "3", "6", large}));
  EXPECT_EQ(texts_of({1, 2}), (Texts{"1", "2", "3", "5", "6", "7", large, "9"}));
  EXPECT_EQ(texts_of({}), Texts{});
  EXPECT_EQ(texts_of({3}), Texts{});
  // A chunk without wanted messages is not read again.
  std::string changed = file;
  changed[changed.find(unwanted) + unwanted.size() - 1] ^= 1;
  (void)folder.with("f", changed);
  EXPECT_EQ(texts_of({1}), (Texts{"1", "5", "7", "9"}));
  EXPECT_TRUE(contains(error_of([&] { texts_of({2}); }), "changed"));
}

TEST(McapReader, NoticesThatTheFileWasChanged) {
  const TemporaryFolder& folder = folder_of_test();
  const std::string file = file_of(
      chunk(kDefinitions + message(1, 1, std::string(2'000'000, 'x'))) + chunk(message(1, 2, "y")));
  Diagnostics diagnostics;
  McapReader reader(folder.with("f", file), diagnostics);
  (void)folder.with("f", file.substr(0, 1000));
  EXPECT_TRUE(contains(error_of([&] { reader.read([](const McapMessage&) {}); }), "shorter"));
  (void)folder.with("f", std::string(file.size(), 'x'));
  EXPECT_TRUE(contains(error_of([&] { reader.read([](const McapMessage&) {}); }), "changed"));
}

}  // namespace
}  // namespace tagfield
