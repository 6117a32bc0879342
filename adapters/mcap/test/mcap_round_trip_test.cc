// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "adapters/mcap/test/mcap_bytes.h"
#include "adapters/mcap/test/sent_messages.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

using namespace mcap_test;

/// What a test writes: channels, and messages in the order of writing.
struct Written {
  std::vector<McapChannel> channels;
  std::vector<Sent> messages;
};

rc::Gen<std::string> bytes(int most) {
  return rc::gen::mapcat(rc::gen::inRange(0, most), [](int size) {
    return rc::gen::container<std::string>(static_cast<std::size_t>(size),
                                           rc::gen::arbitrary<char>());
  });
}

/// Writes a random number of channels and messages; times are often equal, and in no order.
Written write_any(const std::string& path, const McapOptions& options) {
  Written written;
  McapWriter writer(path, options);
  std::vector<McapChannelId> ids;
  std::vector<std::uint32_t> sequences;
  const int steps = *rc::gen::inRange(0, 60);
  for (int step = 0; step < steps; ++step) {
    if (ids.empty() || *rc::gen::inRange(0, 8) == 0) {
      written.channels.push_back(channel_of("/" + std::to_string(ids.size())));
      written.channels.back().metadata[*bytes(9)] = *bytes(9);
      ids.push_back(writer.add_channel(written.channels.back()));
      sequences.push_back(0);
      continue;
    }
    const auto channel = *rc::gen::inRange<std::size_t>(0, ids.size());
    const auto time = *rc::gen::element<std::uint64_t>(0, 1, 2, 1'700'000'000'000'000'000,
                                                       std::numeric_limits<std::uint64_t>::max());
    const auto published = *rc::gen::arbitrary<std::uint64_t>();
    const std::string data = *bytes(300);
    writer.write(ids[channel], time, published, data);
    written.messages.emplace_back(written.channels[channel].topic, sequences[channel]++, time,
                                  published, data);
  }
  writer.finish();
  return written;
}

McapOptions any_options() {
  McapOptions options;
  options.compression =
      *rc::gen::element(McapCompression::kNone, McapCompression::kLz4, McapCompression::kZstd);
  options.chunk_bytes = *rc::gen::element<std::size_t>(1, 500, 2000, 1U << 20U);
  options.profile = *bytes(9);
  return options;
}

RC_GTEST_PROP(McapRoundTrip, GivesBackAllThatWasWritten, ()) {
  const TemporaryFolder folder;
  const McapOptions options = any_options();
  const Written written = write_any(folder.file("f"), options);
  Diagnostics diagnostics;
  RC_ASSERT(read_all(folder.file("f"), diagnostics) == in_order_of_time(written.messages));
  const McapReader reader(folder.file("f"), diagnostics);
  RC_ASSERT(diagnostics.warnings().empty());
  RC_ASSERT(reader.profile() == options.profile);
  RC_ASSERT(reader.channels().size() == written.channels.size());
  RC_ASSERT(reader.schemas().size() == written.channels.size());
  for (const auto& [id, channel] : reader.channels()) {
    const McapChannel& expected = written.channels.at(id - 1U);
    RC_ASSERT(channel.topic == expected.topic);
    RC_ASSERT(channel.message_encoding == expected.message_encoding);
    RC_ASSERT(channel.metadata == expected.metadata);
    RC_ASSERT(channel.schema->name == expected.schema->name);
    RC_ASSERT(channel.schema->encoding == expected.schema->encoding);
    RC_ASSERT(channel.schema->text == expected.schema->text);
    const auto count =
        std::count_if(written.messages.begin(), written.messages.end(),
                      [&](const Sent& m) { return std::get<0>(m) == expected.topic; });
    RC_ASSERT(reader.message_count(id) == static_cast<std::uint64_t>(count));
  }
}

RC_GTEST_PROP(McapRoundTrip, WhenChannelsAreAddedDoesNotMatter, ()) {
  const TemporaryFolder folder;
  const McapOptions options = any_options();
  const Written written = write_any(folder.file("f"), options);
  McapWriter writer(folder.file("g"), options);
  std::map<std::string, McapChannelId> ids;
  for (const McapChannel& channel : written.channels)
    ids[channel.topic] = writer.add_channel(channel);
  for (const auto& [topic, sequence, time, published, data] : written.messages) {
    writer.write(ids.at(topic), time, published, data);
  }
  writer.finish();
  Diagnostics diagnostics;
  RC_ASSERT(read_all(folder.file("g"), diagnostics) == read_all(folder.file("f"), diagnostics));
}

// --- The index against all records -----------------------------------------------------

struct Totals {
  std::uint64_t messages = 0;
  std::uint64_t chunks = 0;
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last = 0;
  std::map<std::uint64_t, std::uint64_t> of_channel;
};

/// Checks an uncompressed chunk, the records after it, and its entry in the summary.
void check_chunk(const std::vector<RecordThere>& all, std::size_t at, const RecordThere& index,
                 Totals& totals) {
  const RecordThere& chunk = all[at];
  const std::string records = chunk.content.substr(40);
  RC_ASSERT(number_at(chunk.content, 24, 4) == crc(records));
  RC_ASSERT(number_at(chunk.content, 16, 8) == records.size());
  std::map<std::uint64_t, std::string> entries;  // by channel
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last = 0;
  for (const RecordThere& inner : records_in(records)) {
    if (inner.op != 5) continue;
    const std::uint64_t time = number_at(inner.content, 6, 8);
    first = std::min(first, time);
    last = std::max(last, time);
    const std::uint64_t channel = number_at(inner.content, 0, 2);
    entries[channel] += le(time, 8) + le(inner.offset, 8);
    ++totals.messages;
    ++totals.of_channel[channel];
  }
  ++totals.chunks;
  totals.first = std::min(totals.first, first);
  totals.last = std::max(totals.last, last);
  std::string places;
  std::uint64_t length = 0;
  for (const auto& [channel, expected] : entries) {
    const RecordThere& of_messages = all.at(++at);
    RC_ASSERT(of_messages.op == 7);
    RC_ASSERT(of_messages.content == le(channel, 2) + text(expected));
    places += le(channel, 2) + le(of_messages.offset, 8);
    length += of_messages.length();
  }
  RC_ASSERT(chunk.content.substr(0, 16) == le(first, 8) + le(last, 8));
  RC_ASSERT(index.content == le(first, 8) + le(last, 8) + le(chunk.offset, 8) +
                                 le(chunk.length(), 8) + text(places) + le(length, 8) + text("") +
                                 le(records.size(), 8) + le(records.size(), 8));
}

std::vector<RecordThere> of_op(const std::vector<RecordThere>& records, int op) {
  std::vector<RecordThere> found;
  std::copy_if(records.begin(), records.end(), std::back_inserter(found),
               [&](const RecordThere& record) { return record.op == op; });
  return found;
}

/// Each sequence of records of one kind in the summary has its offset.
void check_offsets(const std::vector<RecordThere>& summary, const std::vector<RecordThere>& all) {
  std::vector<std::string> expected;
  for (std::size_t at = 0; at < summary.size();) {
    std::uint64_t length = 0;
    const RecordThere& first = summary[at];
    for (; at < summary.size() && summary[at].op == first.op; ++at) length += summary[at].length();
    expected.push_back(le(static_cast<std::uint64_t>(first.op), 1) + le(first.offset, 8) +
                       le(length, 8));
  }
  std::vector<std::string> found;
  for (const RecordThere& record : of_op(all, 14)) found.push_back(record.content);
  RC_ASSERT(found == expected);
}

RC_GTEST_PROP(McapIndex, IsWhatAScanOfAllRecordsFinds, ()) {
  const TemporaryFolder folder;
  McapOptions options = any_options();
  options.compression = McapCompression::kNone;
  const Written written = write_any(folder.file("f"), options);
  const std::string file = folder.text_of("f");
  const std::vector<RecordThere> all = records_of_file(file);
  const std::vector<RecordThere> indexes = of_op(all, 8);
  Totals totals;
  std::size_t data_end = 0;
  for (std::size_t at = 0; at < all.size(); ++at) {
    if (all[at].op == 6) check_chunk(all, at, indexes.at(totals.chunks), totals);
    if (all[at].op == 15) data_end = at;
  }
  RC_ASSERT(indexes.size() == totals.chunks);
  RC_ASSERT(totals.messages == written.messages.size());
  const std::uint64_t end = all.at(data_end).offset;
  RC_ASSERT(number_at(all[data_end].content, 0, 4) == crc(std::string_view(file).substr(0, end)));

  const auto offsets =
      std::find_if(all.begin(), all.end(), [](const RecordThere& r) { return r.op == 14; });
  check_offsets({all.begin() + static_cast<std::ptrdiff_t>(data_end) + 1, offsets}, all);
  std::string counts;
  for (std::size_t id = 1; id <= written.channels.size(); ++id) {
    counts += le(id, 2) + le(totals.of_channel[id], 8);
  }
  if (totals.messages == 0) totals.first = 0;
  RC_ASSERT(of_op(all, 11).at(0).content ==
            le(totals.messages, 8) + le(written.channels.size(), 2) +
                le(written.channels.size(), 4) + le(0, 8) + le(totals.chunks, 4) +
                le(totals.first, 8) + le(totals.last, 8) + text(counts));
  const std::uint64_t start = all.at(data_end + 1).offset;
  const RecordThere& footer = all.back();
  RC_ASSERT(footer.op == 2);
  RC_ASSERT(footer.content.substr(0, 16) == le(start, 8) + le(offsets->offset, 8));
  const std::string_view summary = std::string_view(file).substr(start, footer.offset + 25 - start);
  RC_ASSERT(number_at(footer.content, 16, 4) == crc(summary));
}

}  // namespace
}  // namespace tagfield
