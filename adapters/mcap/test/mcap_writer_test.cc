// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/mcap_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "adapters/mcap/test/mcap_bytes.h"
#include "adapters/mcap/test/sent_messages.h"
#include "tagfield/base/error.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;
using namespace mcap_test;
using Names = std::set<std::string>;

const McapOptions kPlain{"p", "l", McapCompression::kNone, 1U << 20U};

std::string partial_of(const std::string& path) {
  return path + "." + std::to_string(getpid()) + ".partial";
}

/// Chunks of one message each.
McapOptions small_chunks() {
  McapOptions options;
  options.chunk_bytes = 1;
  return options;
}

TEST(CrcOfTheTests, IsThatOfTheBooks) { EXPECT_EQ(crc("123456789"), 0xCBF43926U); }

// Every byte of a file with one message, assembled by hand from the tables of the specification.
TEST(McapWriter, WritesTheBytesOfTheSpecification) {
  const TemporaryFolder folder;
  McapWriter writer(folder.file("f"), kPlain);
  const auto schema = std::make_shared<const McapSchema>(McapSchema{"S", "e", "x"});
  writer.write(writer.add_channel({"/t", schema, "m", {{"k", "v"}}}), 5, 4, "ab");
  writer.finish();

  const std::string of_schema = le(3, 1) + le(17, 8) + le(1, 2) + text("S") + text("e") + text("x");
  const std::string of_channel = le(4, 1) + le(29, 8) + le(1, 2) + le(1, 2) + text("/t") +
                                 text("m") + le(10, 4) + text("k") + text("v");
  const std::string records = of_schema + of_channel + le(5, 1) + le(24, 8) + le(1, 2) + le(0, 4) +
                              le(5, 8) + le(4, 8) + "ab";
  ASSERT_EQ(records.size(), 97U);
  const std::string data = kMagic + le(1, 1) + le(10, 8) + text("p") + text("l") +  //
                           le(6, 1) + le(137, 8) + le(5, 8) + le(5, 8) + le(97, 8) +
                           le(crc(records), 4) + text("") + le(97, 8) + records +  //
                           le(7, 1) + le(22, 8) + le(1, 2) + le(16, 4) + le(5, 8) + le(64, 8);
  ASSERT_EQ(data.size(), 204U);
  const std::string statistics = le(11, 1) + le(56, 8) + le(1, 8) + le(1, 2) + le(1, 4) + le(0, 4) +
                                 le(0, 4) + le(1, 4) + le(5, 8) + le(5, 8) + le(10, 4) + le(1, 2) +
                                 le(1, 8);
  const std::string chunk_index = le(8, 1) + le(74, 8) + le(5, 8) + le(5, 8) + le(27, 8) +
                                  le(146, 8) + le(10, 4) + le(1, 2) + le(173, 8) + le(31, 8) +
                                  text("") + le(97, 8) + le(97, 8);
  std::string offsets;
  for (const auto& [op, start, length] : {std::tuple{3U, 217U, 26U}, std::tuple{4U, 243U, 38U},
                                          std::tuple{11U, 281U, 65U}, std::tuple{8U, 346U, 83U}}) {
    offsets += le(14, 1) + le(17, 8) + le(op, 1) + le(start, 8) + le(length, 8);
  }
  const std::string summary = of_schema + of_channel + statistics + chunk_index + offsets +
                              le(2, 1) + le(20, 8) + le(217, 8) + le(429, 8);
  EXPECT_EQ(folder.text_of("f"), data + le(15, 1) + le(4, 8) + le(crc(data), 4) + summary +
                                     le(crc(summary), 4) + kMagic);
}

TEST(McapWriter, GivesLargeMessagesChunksOfTheirOwn) {
  McapOptions options = kPlain;
  options.chunk_bytes = 400;
  const TemporaryFolder folder;
  McapWriter writer(folder.file("f"), options);
  const McapChannelId small = writer.add_channel(channel_of("/small"));
  const McapChannelId large = writer.add_channel(channel_of("/large"));
  writer.write(small, 1, 1, "a");
  writer.write(large, 2, 2, std::string(99, 'b'));  // Not yet large.
  writer.write(large, 3, 3, std::string(100, 'c'));
  writer.write(large, 4, 4, std::string(3000, 'd'));
  writer.write(small, 5, 5, "e");
  writer.write(small, 6, 6, "f");
  writer.finish();
  // Times of each chunk, as stated at its beginning.
  const std::string file = folder.text_of("f");
  std::vector<std::pair<int, int>> times;
  for (int first = 1; first <= 6; ++first) {
    for (int last = first; last <= 6; ++last) {
      const std::string head =
          le(static_cast<std::uint64_t>(first), 8) + le(static_cast<std::uint64_t>(last), 8);
      for (std::size_t at = 0; (at = file.find(head, at)) != std::string::npos; ++at) {
        if (at >= 9 && file[at - 9] == 6) times.emplace_back(first, last);
      }
    }
  }
  EXPECT_EQ(times, (std::vector<std::pair<int, int>>{{1, 2}, {3, 3}, {4, 4}, {5, 6}}));
  Diagnostics diagnostics;
  EXPECT_EQ(read_all(folder.file("f"), diagnostics).size(), 6U);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(McapWriter, AFileWithoutMessagesIsWholeToo) {
  const TemporaryFolder folder;
  McapWriter writer(folder.file("f"));
  (void)writer.add_channel(channel_of("/a"));
  writer.finish();
  Diagnostics diagnostics;
  McapReader reader(folder.file("f"), diagnostics);
  EXPECT_EQ(reader.channels().at(1).topic, "/a");
  EXPECT_EQ(reader.profile(), "ros2");
  EXPECT_EQ(reader.message_count(1), 0U);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(McapWriter, SchemasOfOneNameAreOne) {
  const TemporaryFolder folder;
  McapWriter writer(folder.file("f"), kPlain);
  McapChannel channel = channel_of("/a");
  (void)writer.add_channel(channel);
  channel.topic = "/b";
  channel.schema = std::make_shared<const McapSchema>(*channel.schema);
  (void)writer.add_channel(channel);
  McapSchema other = *channel.schema;
  other.text += "uint8 more\n";
  channel.schema = std::make_shared<const McapSchema>(other);
  EXPECT_EQ(error_of([&] { (void)writer.add_channel(channel); }),
            "two schemas of an MCAP file have the name 'pkg/msg/a'");
  channel.schema = nullptr;
  (void)writer.add_channel(channel);
  writer.finish();
  Diagnostics diagnostics;
  const McapReader reader(folder.file("f"), diagnostics);
  EXPECT_EQ(reader.schemas().size(), 1U);
  EXPECT_EQ(reader.channels().size(), 3U);
  EXPECT_EQ(reader.channels().at(1).schema, reader.channels().at(2).schema);
  EXPECT_EQ(reader.channels().at(3).schema, nullptr);
}

TEST(McapWriter, RefusesWhatItCouldNotReadAgain) {
  const TemporaryFolder folder;
  McapWriter writer(folder.file("f"));
  const McapChannelId a = writer.add_channel(channel_of("/a"));
  EXPECT_EQ(error_of([&] { writer.write(2, 0, 0, ""); }), "the MCAP file has no channel 2");
  EXPECT_THROW(writer.write(0, 0, 0, ""), Error);
  const std::string long_text(kMaxMcapMessageBytes + 1, 'x');
  EXPECT_THROW(writer.write(a, 0, 0, long_text), Error);
  McapChannel channel = channel_of("/b");
  channel.metadata["long"] = long_text;
  EXPECT_THROW((void)writer.add_channel(channel), Error);
  // The file can still be written after these errors.
  writer.write(a, 1, 1, "x");
  writer.finish();
  Diagnostics diagnostics;
  EXPECT_EQ(read_all(folder.file("f"), diagnostics), (std::vector<Sent>{{"/a", 0, 1, 1, "x"}}));
}

TEST(McapWriter, TheLongestMessagesFitTheirChunks) {
  const TemporaryFolder folder;
  McapWriter writer(folder.file("f"));
  const McapChannelId a = writer.add_channel(channel_of("/a"));
  const std::string longest(kMaxMcapMessageBytes, 'x');
  writer.write(a, 1, 1, "short");
  writer.write(a, 2, 2, longest);
  writer.write(a, 3, 3, longest);
  writer.finish();
  Diagnostics diagnostics;
  const auto found = read_all(folder.file("f"), diagnostics);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_TRUE(std::get<4>(found[2]) == longest);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(McapWriter, WithoutFinishAnEmptyFileVanishes) {
  const TemporaryFolder folder;
  {
    McapWriter writer(folder.file("f"));
    writer.write(writer.add_channel(channel_of("/a")), 1, 1, "x");
    EXPECT_EQ(folder.names(), Names{fs::path(partial_of("f"))});
  }
  EXPECT_EQ(folder.names(), Names{});
}

TEST(McapWriter, WithoutFinishWholeChunksStay) {
  const TemporaryFolder folder;
  const std::string path = folder.with("f", "old");
  {
    McapWriter writer(path, small_chunks());
    const McapChannelId a = writer.add_channel(channel_of("/a"));
    writer.write(a, 1, 1, "x");
    writer.write(a, 2, 2, "y");
    // As left by a program that is killed now.
    fs::copy(partial_of(path), folder.path() / "killed");
  }
  EXPECT_EQ(folder.text_of("f"), "old");
  EXPECT_EQ(folder.names(), (Names{"f", "killed", partial_of("f")}));
  for (const std::string& left : {partial_of(path), folder.file("killed")}) {
    Diagnostics diagnostics;
    EXPECT_EQ(read_all(left, diagnostics),
              (std::vector<Sent>{{"/a", 0, 1, 1, "x"}, {"/a", 1, 2, 2, "y"}}));
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    EXPECT_TRUE(contains(diagnostics.warnings()[0], "the file is cut off or broken here"));
  }
}

TEST(McapWriter, ReplacesWhatALinkPointsTo) {
  const TemporaryFolder folder;
  (void)folder.with("target", "old");
  fs::create_symlink("target", folder.path() / "link");
  McapWriter(folder.file("link")).finish();
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(folder.text_of("target").substr(0, 8), kMagic);
  EXPECT_EQ(folder.names(), Names{"target"});  // and the link to it, but nothing half-written
}

TEST(McapWriter, SaysAtOnceWhereNoFileCanBe) {
  const TemporaryFolder folder;
  const std::string inside = folder.file("missing/f");
  EXPECT_TRUE(
      contains(error_of([&] { McapWriter writer(inside); }), inside + ": can't be written"));
  const std::string own = folder.path().string();
  EXPECT_TRUE(contains(error_of([&] { McapWriter writer(own); }), own + ": is a folder"));
  EXPECT_TRUE(contains(error_of([] { McapWriter writer("/dev/null"); }), "or a device"));
}

TEST(McapWriter, SaysOnceThatTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const TemporaryFolder folder;
  const std::string path = folder.file("f");
  fs::create_symlink("/dev/full", partial_of(path));
  {
    McapWriter writer(path, small_chunks());
    const McapChannelId a = writer.add_channel(channel_of("/a"));
    EXPECT_TRUE(contains(error_of([&] { writer.write(a, 1, 1, "x"); }),
                         path + ": can't be written: No space left on device"));
    EXPECT_NO_THROW(writer.write(a, 2, 2, "y"));
    EXPECT_NO_THROW(writer.finish());
  }
  EXPECT_EQ(folder.names(), Names{});
}

TEST(McapWriter, SaysThatTheDiskIsFullAtTheEnd) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const TemporaryFolder folder;
  const std::string path = folder.file("f");
  fs::create_symlink("/dev/full", partial_of(path));
  McapWriter writer(path);
  writer.write(writer.add_channel(channel_of("/a")), 1, 1, "x");
  EXPECT_TRUE(contains(error_of([&] { writer.finish(); }), path + ": can't be written"));
  EXPECT_EQ(folder.names(), Names{});
}

}  // namespace
}  // namespace tagfield
