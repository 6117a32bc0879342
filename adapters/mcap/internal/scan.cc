// SPDX-License-Identifier: Apache-2.0
#include "adapters/mcap/internal/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "adapters/mcap/internal/compression.h"
#include "adapters/mcap/internal/definitions.h"
#include "adapters/mcap/internal/records.h"

namespace tagfield::mcap_internal {
namespace {

constexpr std::uint64_t kTailBytes = kHeadBytes + kFooterBytes + kMagic.size();
/// Incompressible data become slightly longer.
constexpr std::uint64_t kMaxRecordBytes = kMaxMcapChunkBytes + (1U << 20U);
/// Records outside of chunks are grouped up to this size.
constexpr std::uint64_t kRunBytes = 1U << 20U;
constexpr int kMaxWarnings = 20;

/// Warnings about one file, limited in number for badly damaged files.
class Complaints {
 public:
  Complaints(std::string path, Diagnostics& diagnostics)
      : path_(std::move(path)), diagnostics_(diagnostics) {}

  void say(const std::string& what) {
    if (left_ < 0) return;
    const bool is_last = left_-- == 0;
    diagnostics_.warn({path_, 0}, is_last ? "further faults are not listed" : what);
  }
  void say(std::uint64_t at, const std::string& what) { say(fmt::format("byte {}: {}", at, what)); }

 private:
  std::string path_;
  Diagnostics& diagnostics_;
  int left_ = kMaxWarnings;
};

/// Adds a channel to a piece's channels.
void note(McapChannelId channel, std::vector<McapChannelId>& channels) {
  const auto place = std::lower_bound(channels.begin(), channels.end(), channel);
  if (place == channels.end() || *place != channel) channels.insert(place, channel);
}

using Counts = std::map<McapChannelId, std::uint64_t>;

/// Scans a file record by record. All lengths and offsets in it are checked against its actual
/// contents.
class Scanner {
 public:
  Scanner(InputFile& file, Diagnostics& diagnostics)
      : file_(file), complaints_(file.path(), diagnostics), end_(file.size()) {}

  Contents scan();

 private:
  void read_header();
  void read_footer();
  void read_summary(std::uint64_t start, std::uint64_t footer, std::uint32_t crc);
  [[nodiscard]] std::uint64_t limit_after(std::uint64_t at) const;
  void walk();
  void take(Op op, std::uint64_t at, std::uint64_t length);
  void define(Op op, std::uint64_t at, std::string_view content);
  void take_chunk(std::uint64_t at, std::uint64_t length);
  void take_records_of_chunk(std::uint64_t at, Piece piece);
  void take_message(std::uint64_t at, std::uint64_t length);
  void take_data_end(std::uint64_t at, std::uint64_t length);
  void judge_footer();
  void judge_loose_messages();
  void resolve();

  InputFile& file_;
  Complaints complaints_;
  Contents found_;
  Definitions definitions_;
  std::set<std::uint64_t> chunk_starts_;  ///< According to the summary.
  std::uint64_t end_;                     ///< End of the records to be scanned.
  bool has_footer_ = false;
  bool is_over_ = false;
  bool is_cut_ = false;  ///< Before its end.
  bool has_chunks_ = false;
  bool is_data_right_ = false;  ///< According to its CRC.
  Counts loose_counts_;         ///< Messages outside of chunks.
  std::string records_;
};

/// The summary is optional, and so is its CRC; without a CRC it is not relied on.
void Scanner::read_summary(std::uint64_t start, std::uint64_t footer, std::uint32_t crc) {
  const std::uint64_t checked = footer + kHeadBytes + kFooterBytes - sizeof(crc);
  if (start < kMagic.size() || start > footer || footer - start > kMaxRecordBytes) {
    return complaints_.say(footer, "the footer says that the summary is where it can't be");
  }
  if (crc == 0) return;
  if (file_.crc(start, checked - start) != crc) {
    return complaints_.say(start, "the summary's CRC is wrong, so it is not used");
  }
  end_ = start;
  std::string_view summary = file_.view(start, footer - start);
  while (const auto record = take_record(summary)) {
    if (record->op == Op::kSchema || record->op == Op::kChannel) {
      define(record->op, start, record->content);
    }
    if (record->op == Op::kChunkIndex) {
      Fields fields(record->content);
      (void)fields.bytes(2 * sizeof(std::uint64_t));  // times
      chunk_starts_.insert(fields.number<std::uint64_t>());
    }
  }
}

void Scanner::read_footer() {
  if (file_.size() < kMagic.size() + kTailBytes) return;  // So it is cut off.
  const std::uint64_t footer = file_.size() - kTailBytes;
  Fields fields(file_.view(footer, kTailBytes));
  const bool is_footer = fields.number<std::uint8_t>() == static_cast<std::uint8_t>(Op::kFooter) &&
                         fields.number<std::uint64_t>() == kFooterBytes;
  const auto start = fields.number<std::uint64_t>();
  (void)fields.number<std::uint64_t>();  // start of the summary offsets
  const auto crc = fields.number<std::uint32_t>();
  has_footer_ = is_footer && fields.rest() == kMagic;
  if (!has_footer_) return;
  if (start != 0) read_summary(start, footer, crc);
}

/// Upper bound for the end of a record that begins at `at`.
std::uint64_t Scanner::limit_after(std::uint64_t at) const {
  const auto next = chunk_starts_.upper_bound(at);
  return next == chunk_starts_.end() ? end_ : std::min(end_, *next);
}

void Scanner::walk() {
  std::uint64_t at = kMagic.size();
  while (at < end_ && !is_over_) {
    const std::uint64_t limit = limit_after(at);
    Fields head(file_.view(at, std::min<std::uint64_t>(kHeadBytes, limit - at)));
    const auto op = head.number<std::uint8_t>();
    const auto length = head.number<std::uint64_t>();
    if (head.is_whole() && op != 0 && length <= limit - at - kHeadBytes) {
      take(static_cast<Op>(op), at, length);
      at += kHeadBytes + length;
      continue;
    }
    is_over_ = is_cut_ = limit == end_;
    complaints_.say(at, is_over_ ? "the file is cut off or broken here, and the rest is left out"
                                 : fmt::format("the file is broken from here to byte {}", limit));
    at = limit;
  }
  if (!is_over_ && has_footer_) {
    complaints_.say(at, "the file ends without a DataEnd record");
  } else if (!is_over_) {
    complaints_.say(at, "the file is cut off or broken here: it ends without its last records");
  }
}

void Scanner::take(Op op, std::uint64_t at, std::uint64_t length) {
  const bool is_wanted = op == Op::kSchema || op == Op::kChannel || op == Op::kMessage ||
                         op == Op::kChunk || op == Op::kDataEnd;
  if (op == Op::kFooter && at + kTailBytes == file_.size()) is_over_ = true;
  if (!is_wanted) return;  // Indexes, attachments, and records of later versions.
  if (length > kMaxRecordBytes) {
    return complaints_.say(at, fmt::format("a record of {} bytes is left out, the limit is {}",
                                           length, kMaxRecordBytes));
  }
  if (op == Op::kChunk) return take_chunk(at, length);
  if (op == Op::kMessage) return take_message(at, length);
  if (op == Op::kDataEnd) return take_data_end(at, length);
  define(op, at, file_.view(at + kHeadBytes, length));
}

void Scanner::define(Op op, std::uint64_t at, std::string_view content) {
  if (const char* const fault = definitions_.add(op, content)) complaints_.say(at, fault);
}

void Scanner::take_chunk(std::uint64_t at, std::uint64_t length) {
  has_chunks_ = true;
  const Piece piece{at + kHeadBytes, length, true, 0, {}};
  const char* const fault = open_chunk(file_.view(piece.offset, length), records_);
  if (fault != nullptr) {
    return complaints_.say(at, fmt::format("a chunk is left out: {}", fault));
  }
  take_records_of_chunk(at, piece);
}

void Scanner::take_records_of_chunk(std::uint64_t at, Piece piece) {
  std::string_view rest = records_;
  bool has_messages = false;
  while (const auto record = take_record(rest)) {
    if (record->op == Op::kSchema || record->op == Op::kChannel) {
      define(record->op, at, record->content);
    }
    const auto message = record->op == Op::kMessage ? message_in(record->content) : std::nullopt;
    if (!message) continue;
    ++found_.counts[message->channel];
    note(message->channel, piece.channels);
    piece.first_ns =
        has_messages ? std::min(piece.first_ns, message->log_time_ns) : message->log_time_ns;
    has_messages = true;
  }
  if (!rest.empty()) complaints_.say(at, "the chunk does not end with a whole record");
  if (has_messages) found_.pieces.push_back(std::move(piece));
}

void Scanner::take_message(std::uint64_t at, std::uint64_t length) {
  const auto message = message_in(file_.view(at + kHeadBytes, length));
  if (!message) return complaints_.say(at, "a message is broken, and left out");
  ++loose_counts_[message->channel];
  auto& pieces = found_.pieces;
  const std::uint64_t size = kHeadBytes + length;
  const bool goes_on = !pieces.empty() && !pieces.back().is_chunk &&
                       pieces.back().offset + pieces.back().length == at &&
                       pieces.back().length + size <= kRunBytes;
  if (!goes_on) pieces.push_back({at, 0, false, message->log_time_ns, {}});
  note(message->channel, pieces.back().channels);
  pieces.back().length += size;
  pieces.back().first_ns = std::min(pieces.back().first_ns, message->log_time_ns);
}

void Scanner::take_data_end(std::uint64_t at, std::uint64_t length) {
  is_over_ = true;
  Fields fields(file_.view(at + kHeadBytes, length));
  const auto crc = fields.number<std::uint32_t>();
  is_data_right_ = fields.is_whole() && (crc == 0 || file_.crc(0, at) == crc);
  if (!is_data_right_) {
    complaints_.say(at, "the data's CRC is wrong: something before it is broken");
  }
}

/// A footer that is missing is worth a warning only if the records before it are there.
void Scanner::judge_footer() {
  if (has_footer_ || is_cut_ || !is_over_) return;
  complaints_.say(file_.size(), "the file is cut off or broken here: there is no footer");
}

/// If there are chunks, messages should be in them. One outside may be a remnant of a damaged
/// chunk, and only the CRC of all data can exclude that.
void Scanner::judge_loose_messages() {
  if (loose_counts_.empty()) return;
  if ((has_chunks_ || !chunk_starts_.empty()) && !is_data_right_) {
    complaints_.say("messages outside of chunks are left out, as no CRC covers them");
    auto& pieces = found_.pieces;
    pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                                [](const Piece& piece) { return !piece.is_chunk; }),
                 pieces.end());
    return;
  }
  for (const auto& [channel, count] : loose_counts_) found_.counts[channel] += count;
}

void Scanner::resolve() {
  for (const McapChannelId id : definitions_.resolve(found_)) {
    complaints_.say(fmt::format("channel {} has a schema that the file lacks", id));
  }
  for (auto entry = found_.counts.begin(); entry != found_.counts.end();) {
    if (found_.channels.count(entry->first) > 0) {
      ++entry;
      continue;
    }
    complaints_.say(fmt::format("{} messages of channel {}, which the file lacks, are left out",
                                entry->second, entry->first));
    entry = found_.counts.erase(entry);
  }
}

void Scanner::read_header() {
  if (file_.view(0, std::min<std::uint64_t>(kMagic.size(), file_.size())) != kMagic) {
    fail({file_.path(), 0}, "is not an MCAP file: it does not begin with MCAP's magic bytes");
  }
  const std::uint64_t most = std::min<std::uint64_t>(file_.size() - kMagic.size(), kRunBytes);
  std::string_view begin = file_.view(kMagic.size(), most);
  const auto header = take_record(begin);
  if (header && header->op == Op::kHeader) {
    found_.profile = Fields(header->content).text();
  } else {
    complaints_.say(kMagic.size(), "there is no header");
  }
}

Contents Scanner::scan() {
  try {
    read_header();
    read_footer();
    walk();
    judge_footer();
  } catch (const Error& error) {
    const std::string what = error.what();
    if (what.rfind(file_.path(), 0) == 0) throw;
    fail({file_.path(), 0}, what);
  }
  judge_loose_messages();
  resolve();
  return std::move(found_);
}

}  // namespace

const char* open_chunk(std::string_view content, std::string& records) {
  Fields fields(content);
  (void)fields.bytes(2 * sizeof(std::uint64_t));  // Times, which are taken from the messages.
  const auto size = fields.number<std::uint64_t>();
  const auto crc = fields.number<std::uint32_t>();
  const std::string_view compression = fields.text();
  const std::string_view bytes = fields.bytes(fields.number<std::uint64_t>());
  if (!fields.is_whole()) return "it goes beyond its end";
  if (size > kMaxMcapChunkBytes) return "it is longer than 256 MB before compression";
  if (const char* const fault = decompress(compression, bytes, size, records)) return fault;
  return crc != 0 && crc_of(records) != crc ? "its CRC is wrong" : nullptr;
}

Contents scan(InputFile& file, Diagnostics& diagnostics) {
  return Scanner(file, diagnostics).scan();
}

}  // namespace tagfield::mcap_internal
