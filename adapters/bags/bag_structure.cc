// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_structure.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <roslz4/lz4s.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

// http://wiki.ros.org/Bags/Format/2.0
constexpr std::string_view kFirstLine = "#ROSBAG V2.0\n";
enum Operation : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};
constexpr std::size_t kIndexEntry = 12;  ///< A time and an offset.
constexpr std::size_t kInfoEntry = 8;    ///< A connection and a count.
/// Limit of an uncompressed chunk. rosbag's have 768 KiB, or one message.
constexpr std::uint32_t kMaxChunk = 1U << 28U;

/// A description of damage, without the file name.
struct Damage {
  std::string what;
};

/// A number in the file's encoding, little-endian.
template <typename Number>
Number number_in(std::string_view bytes) {
  if (bytes.size() != sizeof(Number)) throw Damage{"a field has a wrong size"};
  Number number = 0;
  std::memcpy(&number, bytes.data(), sizeof(Number));
  return number;
}

/// Removes `size` bytes from the front and returns them.
std::string_view cut(std::string_view& bytes, std::size_t size) {
  if (size > bytes.size()) throw Damage{"a record goes beyond its end"};
  const std::string_view front = bytes.substr(0, size);
  bytes.remove_prefix(size);
  return front;
}

std::string_view cut_counted(std::string_view& bytes) {
  const auto size = number_in<std::uint32_t>(cut(bytes, sizeof(std::uint32_t)));
  return cut(bytes, size);
}

/// The header of a record, "name=value" fields, each preceded by its size. All of them are checked:
/// rosbag reads beyond the end of a header whose last field is longer than the remaining bytes.
class Header {
 public:
  explicit Header(std::string_view bytes) : bytes_(bytes) {
    while (!bytes.empty()) {
      if (cut_counted(bytes).find('=') == std::string_view::npos) {
        throw Damage{"a field of a record has no value"};
      }
    }
  }
  [[nodiscard]] std::string_view text(std::string_view name) const {
    std::string_view rest = bytes_;
    while (!rest.empty()) {
      const std::string_view entry = cut_counted(rest);
      const std::size_t equals = entry.find('=');
      if (entry.substr(0, equals) == name) return entry.substr(equals + 1);
    }
    throw Damage{fmt::format("a record has no field '{}'", name)};
  }
  template <typename Number>
  [[nodiscard]] Number number(std::string_view name) const {
    return number_in<Number>(text(name));
  }
  [[nodiscard]] std::uint8_t operation() const { return number<std::uint8_t>("op"); }

 private:
  std::string_view bytes_;
};

/// A chunk's uncompressed records, stored in `unpacked` if they were compressed.
std::string_view records_of(const Header& header, std::string_view data, std::string& unpacked) {
  const auto size = header.number<std::uint32_t>("size");
  const std::string_view compression = header.text("compression");
  if (size > kMaxChunk) throw Damage{"a chunk has over 256 MiB"};
  if (compression == "none") {
    if (data.size() != size) throw Damage{"a chunk has a wrong size"};
    return data;
  }
  unpacked.resize(size);
  std::string packed(data);  // Neither library guarantees not to modify its input.
  auto unpacked_size = size;
  const auto packed_size = static_cast<unsigned>(packed.size());
  const bool whole = compression == "bz2"
                         ? BZ2_bzBuffToBuffDecompress(unpacked.data(), &unpacked_size,
                                                      packed.data(), packed_size, 0, 0) == BZ_OK
                         : compression == "lz4" && roslz4_buffToBuffDecompress(
                                                       packed.data(), packed_size, unpacked.data(),
                                                       &unpacked_size) == ROSLZ4_OK;
  if (!whole || unpacked_size != size) throw Damage{"a chunk can't be decompressed"};
  return unpacked;
}

/// rosbag leaks what it has read of a bag when a field is missing.
void check_connection(const Header& header, std::string_view data) {
  (void)header.number<std::uint32_t>("conn");
  (void)header.text("topic");
  const Header description(data);
  for (const char* name : {"type", "md5sum", "message_definition"}) (void)description.text(name);
}

/// Offsets of a chunk's messages, ascending.
std::vector<std::uint32_t> message_begins(std::string_view records) {
  std::vector<std::uint32_t> begins;
  std::string_view rest = records;
  while (!rest.empty()) {
    const auto begin = static_cast<std::uint32_t>(records.size() - rest.size());
    const Header header(cut_counted(rest));
    const std::string_view data = cut_counted(rest);
    if (header.operation() == kMessage) {
      (void)header.number<std::uint32_t>("conn");
      (void)header.number<std::uint64_t>("time");
      begins.push_back(begin);
    } else if (header.operation() == kConnection) {
      check_connection(header, data);
    } else {
      throw Damage{"a chunk holds a record of another kind"};
    }
  }
  return begins;
}

void require_version_1(const Header& header) {
  if (header.number<std::uint32_t>("ver") != 1) throw Damage{"a record is of another version"};
}

/// Returns how many of its messages were received at time 0.
std::size_t check_index(const Header& header, std::string_view data,
                        const std::vector<std::uint32_t>& begins) {
  require_version_1(header);
  (void)header.number<std::uint32_t>("conn");
  const auto count = header.number<std::uint32_t>("count");
  if (data.size() != std::uint64_t{count} * kIndexEntry) throw Damage{"an index has a wrong size"};
  std::size_t at_zero = 0;
  while (!data.empty()) {
    const std::string_view entry = cut(data, kIndexEntry);
    if (!std::binary_search(begins.begin(), begins.end(),
                            number_in<std::uint32_t>(entry.substr(8)))) {
      throw Damage{"the index points at no message"};
    }
    if (number_in<std::uint64_t>(entry.substr(0, 8)) == 0) ++at_zero;
  }
  return at_zero;
}

/// Sequential access to records.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path)
      : file_(path, std::ios::binary), size_(std::filesystem::file_size(path)), left_(size_) {}

  [[nodiscard]] std::string read(std::uint64_t size) {
    if (size > left_) throw Damage{"a record goes beyond its end"};
    std::string bytes(size, '\0');
    file_.read(bytes.data(), static_cast<std::streamsize>(size));
    if (!file_) throw Damage{"it can't be read to its end"};
    left_ -= size;
    return bytes;
  }
  [[nodiscard]] std::string read_counted() {
    return read(number_in<std::uint32_t>(read(sizeof(std::uint32_t))));
  }
  [[nodiscard]] bool at_end() const { return left_ == 0; }
  [[nodiscard]] std::uint64_t position() const { return size_ - left_; }

 private:
  std::ifstream file_;
  std::uint64_t size_;
  std::uint64_t left_;
};

/// Traverses a bag's records and checks that everything they refer to exists, as rosbag follows any
/// offset.
class Walk {
 public:
  /// Whether the bag was finished: the index position is 0 until the index is written.
  bool through(RecordFile& file) {
    while (!file.at_end()) {
      const std::uint64_t position = file.position();
      const std::string header_bytes = file.read_counted();
      const std::string data = file.read_counted();
      const Header header(header_bytes);
      if (header.operation() == kBagHeader) {
        index_position_ = header.number<std::uint64_t>("index_pos");
        if (index_position_ == 0) return false;
        said_connections_ = header.number<std::uint32_t>("conn_count");
        said_chunks_ = header.number<std::uint32_t>("chunk_count");
      }
      take(header, data, position);
    }
    if (index_position_ != file.position() && starts_.count(index_position_) == 0) {
      throw Damage{"the index is not at its stated position"};
    }
    if (connections_ != said_connections_ || infos_ != said_chunks_) {
      throw Damage{"the index does not have its stated number of records"};
    }
    return true;
  }
  /// Number of messages received at time 0.
  [[nodiscard]] std::size_t at_zero() const { return at_zero_; }

 private:
  void check_chunk_info(const Header& header, std::string_view data) const {
    require_version_1(header);
    for (const char* name : {"start_time", "end_time"}) (void)header.number<std::uint64_t>(name);
    if (data.size() != std::uint64_t{header.number<std::uint32_t>("count")} * kInfoEntry) {
      throw Damage{"the info record of a chunk has a wrong size"};
    }
    if (chunks_.count(header.number<std::uint64_t>("chunk_pos")) == 0) {
      throw Damage{"a chunk is not at its stated position"};
    }
  }
  void take(const Header& header, std::string_view data, std::uint64_t position) {
    starts_.insert(position);
    switch (header.operation()) {
      case kChunk:
        chunks_.insert(position);
        begins_ = message_begins(records_of(header, data, unpacked_));
        break;
      case kIndex:
        at_zero_ += check_index(header, data, begins_);
        break;
      case kConnection:
        ++connections_;
        check_connection(header, data);
        break;
      case kChunkInfo:
        ++infos_;
        check_chunk_info(header, data);
        break;
      default:
        break;
    }
  }

  std::size_t at_zero_ = 0;
  std::uint64_t index_position_ = 1;  ///< Not known yet; matches no record.
  std::uint64_t said_connections_ = 0;
  std::uint64_t said_chunks_ = 0;
  std::uint64_t connections_ = 0;  ///< Outside of chunks, in the index.
  std::uint64_t infos_ = 0;
  std::set<std::uint64_t> starts_;  ///< Of all records.
  std::set<std::uint64_t> chunks_;
  std::vector<std::uint32_t> begins_;  ///< Of the messages of the latest chunk.
  std::string unpacked_;
};

bool look_through(const std::string& path, Diagnostics& diagnostics) {
  RecordFile file(path);
  (void)file.read(kFirstLine.size());
  Walk walk;
  const bool finished = walk.through(file);
  if (walk.at_zero() > 0) {
    diagnostics.warn({path, 0},
                     fmt::format("{} of its messages were received at time 0 and are left out, as "
                                 "rosbag takes that for no time: expected 1 ns or later",
                                 walk.at_zero()));
  }
  return finished;
}

void require_bag(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail({path, 0}, "no such file");
  if (!fs::is_regular_file(status)) fail({path, 0}, "is a folder or no file, expected a rosbag");
  std::ifstream file(path, std::ios::binary);
  if (!file.is_open()) fail({path, 0}, "can't be read");
  std::string begin(kFirstLine.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (file.gcount() == 0) fail({path, 0}, "is empty, expected a rosbag");
  if (begin != kFirstLine) {
    fail({path, 0}, "is not a rosbag of ROS 1: it does not begin with '#ROSBAG V2.0'");
  }
}

}  // namespace

void require_whole_bag(const std::string& path, Diagnostics& diagnostics) {
  require_bag(path);
  bool finished = false;
  try {
    finished = look_through(path, diagnostics);
  } catch (const Damage& damage) {
    fail({path, 0},
         fmt::format("is cut off or damaged ({}); 'rosbag reindex' may recover the intact part",
                     damage.what));
  }
  if (!finished) {
    fail({path, 0}, "has no index, like a recording that was cut off: 'rosbag reindex' makes one");
  }
}

}  // namespace tagfield
