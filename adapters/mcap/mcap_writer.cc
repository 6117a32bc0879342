// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/mcap_writer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "adapters/mcap/internal/open_chunk.h"
#include "adapters/mcap/internal/records.h"
#include "tagfield/base/error.h"
#include "tagfield/files/staged_folder.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

/// A message of at least this fraction of a chunk gets a chunk of its own, so that readers that
/// don't need it can skip it.
constexpr std::size_t kLargeShare = 4;

using mcap_internal::ClosedChunk;
using mcap_internal::crc_of;
using mcap_internal::kHeadBytes;
using mcap_internal::Op;
using mcap_internal::OpenChunk;
using mcap_internal::put;
using mcap_internal::put_record;
using mcap_internal::put_text;
using mcap_internal::TimeRange;

constexpr std::size_t kMaxIds = 65535;

/// The target of a symbolic link. Throws Error if the path exists but is not a file.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    fail({path.string(), 0}, "is a folder or a device, expected a file or nothing");
  }
  const fs::path target = fs::is_symlink(path, error) ? fs::canonical(path, error) : path;
  return error ? path : target;
}

struct KnownSchema {
  std::uint16_t id = 0;
  std::shared_ptr<const McapSchema> schema;
};

struct Counted {
  std::uint32_t next_sequence = 0;
  std::uint64_t messages = 0;
};

}  // namespace

struct McapWriter::State {
  McapOptions options;
  fs::path target;
  fs::path partial;
  std::unique_ptr<GrowingFile> file;  ///< Null once finished or abandoned.
  std::uint64_t offset = 0;           ///< Bytes appended to the file.
  std::uint32_t crc = 0;              ///< Of them.

  OpenChunk chunk;
  std::string definitions;  ///< Records that may have to precede the next message.
  std::map<std::string, KnownSchema> schemas;
  std::vector<Counted> channels;
  TimeRange times;
  std::uint32_t chunks = 0;
  std::string schema_records, channel_records, chunk_indexes;  ///< For the summary.

  State(const std::string& path, McapOptions wanted);
  ~State() { give_up(); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void give_up();
  void append(std::string_view bytes);
  std::uint16_t schema_id(const std::shared_ptr<const McapSchema>& schema);
  void make_room(std::size_t size);
  void close();
  void append_record(Op op, std::string_view content);
  [[nodiscard]] std::string statistics() const;
  void append_summary();
  void move_to_place();

  /// Runs a writing step; if it fails, no others follow.
  template <class Step>
  void guarded(const Step& step) {
    if (!file) return;
    try {
      step();
    } catch (...) {
      give_up();
      throw;
    }
  }
};

McapWriter::State::State(const std::string& path, McapOptions wanted)
    : options(std::move(wanted)),
      target(target_of(path)),
      partial(fmt::format("{}.{}.partial", target.string(), getpid())),
      file(std::make_unique<GrowingFile>(partial, path)) {
  append(mcap_internal::kMagic);
  std::string header;
  put_text(header, options.profile);
  put_text(header, options.library);
  append_record(Op::kHeader, header);
}

void McapWriter::State::give_up() {
  if (!file) return;
  file.reset();
  std::error_code ignored;
  if (chunks == 0) fs::remove(partial, ignored);
}

void McapWriter::State::append(std::string_view bytes) {
  file->text() += bytes;
  offset += bytes.size();
  crc = crc_of(bytes, crc);
}

void McapWriter::State::append_record(Op op, std::string_view content) {
  std::string record;
  put_record(record, op, content);
  append(record);
}

std::uint16_t McapWriter::State::schema_id(const std::shared_ptr<const McapSchema>& schema) {
  if (schema == nullptr) return 0;
  const auto known = schemas.find(schema->name);
  if (known != schemas.end()) {
    const McapSchema& other = *known->second.schema;
    if (other.encoding == schema->encoding && other.text == schema->text) return known->second.id;
    throw Error(fmt::format("two schemas of an MCAP file have the name '{}'", schema->name));
  }
  return static_cast<std::uint16_t>(schemas.size() + 1);
}

void McapWriter::State::make_room(std::size_t size) {
  if (chunk.records.size() + definitions.size() + size > kMaxMcapChunkBytes) close();
}

/// A chunk is written only when it is full, so the program may be killed between any two writes.
void McapWriter::State::close() {
  if (chunk.records.empty()) return;
  const ClosedChunk closed = mcap_internal::close_chunk(chunk, options.compression, offset);
  append(closed.bytes);
  chunk = {};
  file->flush();
  chunk_indexes += closed.index;
  ++chunks;
}

std::string McapWriter::State::statistics() const {
  std::uint64_t messages = 0;
  std::string counts;
  for (std::size_t channel = 0; channel < channels.size(); ++channel) {
    messages += channels[channel].messages;
    put(counts, static_cast<McapChannelId>(channel + 1));
    put(counts, channels[channel].messages);
  }
  std::string content;
  put(content, messages);
  put(content, static_cast<std::uint16_t>(schemas.size()));
  put(content, static_cast<std::uint32_t>(channels.size()));
  put(content, std::uint32_t{0});  // attachments
  put(content, std::uint32_t{0});  // metadata records
  put(content, chunks);
  put(content, times.first_ns);
  put(content, times.last_ns);
  put_text(content, counts);
  std::string record;
  put_record(record, Op::kStatistics, content);
  return record;
}

void McapWriter::State::append_summary() {
  const std::uint64_t start = offset;
  crc = 0;
  const std::string of_statistics = statistics();
  std::string offsets;
  for (const auto& [op, records] : {std::pair<Op, std::string_view>{Op::kSchema, schema_records},
                                    {Op::kChannel, channel_records},
                                    {Op::kStatistics, of_statistics},
                                    {Op::kChunkIndex, chunk_indexes}}) {
    if (records.empty()) continue;
    std::string content;
    put(content, static_cast<std::uint8_t>(op));
    put(content, offset);
    put(content, std::uint64_t{records.size()});
    put_record(offsets, Op::kSummaryOffset, content);
    append(records);
  }
  const std::uint64_t offsets_start = offset;
  append(offsets);
  std::string footer;
  put(footer, static_cast<std::uint8_t>(Op::kFooter));
  put(footer, std::uint64_t{mcap_internal::kFooterBytes});
  put(footer, start);
  put(footer, offsets_start);
  append(footer);
  std::string end;
  put(end, crc);
  append(end + std::string(mcap_internal::kMagic));
}

void McapWriter::State::move_to_place() {
  file->finish();
  std::error_code error;
  fs::rename(partial, target, error);
  if (error) fail({target.string(), 0}, fmt::format("can't be replaced: {}", error.message()));
  file.reset();
}

McapWriter::McapWriter(const std::string& path, const McapOptions& options)
    : state_(std::make_unique<State>(path, options)) {}

McapWriter::~McapWriter() = default;

McapChannelId McapWriter::add_channel(const McapChannel& channel) {
  State& state = *state_;
  if (state.channels.size() == kMaxIds || state.schemas.size() == kMaxIds) {
    throw Error("an MCAP file can have 65535 channels and as many schemas at most");
  }
  const std::uint16_t schema = state.schema_id(channel.schema);
  const auto id = static_cast<McapChannelId>(state.channels.size() + 1);
  const bool is_new = schema > state.schemas.size();
  const std::string of_schema = is_new ? mcap_internal::schema_record(schema, *channel.schema) : "";
  const std::string of_channel = mcap_internal::channel_record(id, channel, schema);
  if (state.schema_records.size() + state.channel_records.size() + of_schema.size() +
          of_channel.size() >
      kMaxMcapDefinitionBytes) {
    throw Error(fmt::format("the schemas and channels of an MCAP file can take {} bytes at most",
                            kMaxMcapDefinitionBytes));
  }
  if (is_new) state.schemas[channel.schema->name] = {schema, channel.schema};
  state.channels.emplace_back();
  state.schema_records += of_schema;
  state.channel_records += of_channel;
  state.definitions += of_schema + of_channel;
  return id;
}

void McapWriter::write(McapChannelId channel, std::uint64_t log_time_ns,
                       std::uint64_t publish_time_ns, std::string_view bytes) {
  State& state = *state_;
  if (channel == 0 || channel > state.channels.size()) {
    throw Error(fmt::format("the MCAP file has no channel {}", channel));
  }
  if (bytes.size() > kMaxMcapMessageBytes) {
    throw Error(fmt::format("a message of an MCAP file has {} bytes, {} at most", bytes.size(),
                            kMaxMcapMessageBytes));
  }
  state.guarded([&] {
    const bool is_large = bytes.size() >= state.options.chunk_bytes / kLargeShare;
    if (is_large) state.close();
    state.make_room(kHeadBytes + mcap_internal::kMessageHeadBytes + bytes.size());
    state.chunk.records += std::exchange(state.definitions, {});
    Counted& counted = state.channels[channel - 1U];
    state.chunk.add({channel, counted.next_sequence++, log_time_ns, publish_time_ns, bytes});
    ++counted.messages;
    state.times.add(log_time_ns);
    if (is_large || state.chunk.records.size() >= state.options.chunk_bytes) state.close();
  });
}

void McapWriter::finish() {
  State& state = *state_;
  state.guarded([&] {
    state.close();
    // Channels without messages, which readers that use the index find in the summary. A chunk
    // without messages would be legal too, but has no index entries.
    state.append(std::exchange(state.definitions, {}));
    std::string end;
    put(end, state.crc);
    state.append_record(Op::kDataEnd, end);
    state.append_summary();
    state.move_to_place();
  });
}

}  // namespace tagfield
