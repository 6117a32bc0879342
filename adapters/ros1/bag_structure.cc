#include "adapters/ros1/bag_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
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
  kConnection = 7
};
constexpr std::size_t kIndexEntry = 12;  ///< A time and an offset.

/// What is wrong, without the file.
struct Damage {
  std::string what;
};

/// A number as the file has it: little-endian.
template <typename Number>
Number number_in(std::string_view bytes) {
  if (bytes.size() != sizeof(Number)) throw Damage{"a field has a wrong size"};
  Number number = 0;
  std::memcpy(&number, bytes.data(), sizeof(Number));
  return number;
}

/// Takes `size` bytes from the front.
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

/// The field `name` of a record's header, "name=value" among others.
std::string_view field(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const std::string_view entry = cut_counted(header);
    const std::size_t equals = entry.find('=');
    if (equals != std::string_view::npos && entry.substr(0, equals) == name) {
      return entry.substr(equals + 1);
    }
  }
  throw Damage{fmt::format("a record has no field '{}'", name)};
}

/// The chunk that the next index records are about.
struct Chunk {
  std::uint32_t size = 0;                            ///< Without compression.
  std::optional<std::vector<std::uint32_t>> begins;  ///< Of its records, rising, if not compressed.
};

Chunk chunk_of(std::string_view header, std::string_view data) {
  Chunk chunk;
  chunk.size = number_in<std::uint32_t>(field(header, "size"));
  if (field(header, "compression") != "none") return chunk;
  if (data.size() != chunk.size) throw Damage{"a chunk has a wrong size"};
  chunk.begins.emplace();
  std::string_view rest = data;
  while (!rest.empty()) {
    const auto begin = static_cast<std::uint32_t>(data.size() - rest.size());
    const auto operation = number_in<std::uint8_t>(field(cut_counted(rest), "op"));
    cut_counted(rest);
    if (operation == kMessage) chunk.begins->push_back(begin);
    if (operation != kMessage && operation != kConnection) {
      throw Damage{"a chunk holds a record of another kind"};
    }
  }
  return chunk;
}

void check_index(std::string_view header, std::string_view data, const Chunk& chunk) {
  const auto count = number_in<std::uint32_t>(field(header, "count"));
  if (data.size() != count * kIndexEntry) throw Damage{"an index has a wrong size"};
  while (!data.empty()) {
    const auto offset = number_in<std::uint32_t>(cut(data, kIndexEntry).substr(8));
    const bool found = chunk.begins
                           ? std::binary_search(chunk.begins->begin(), chunk.begins->end(), offset)
                           : offset < chunk.size;
    if (!found) throw Damage{"the index points at no message"};
  }
}

/// One record after the other.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path)
      : file_(path, std::ios::binary), left_(std::filesystem::file_size(path)) {}

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

 private:
  std::ifstream file_;
  std::uint64_t left_;
};

/// Whether the bag was finished: an index position of 0 is there until the index is.
bool look_through(const std::string& path) {
  RecordFile file(path);
  (void)file.read(kFirstLine.size());
  Chunk chunk;
  while (!file.at_end()) {
    const std::string header = file.read_counted();
    const std::string data = file.read_counted();
    const auto operation = number_in<std::uint8_t>(field(header, "op"));
    if (operation == kBagHeader && number_in<std::uint64_t>(field(header, "index_pos")) == 0) {
      return false;
    }
    if (operation == kChunk) chunk = chunk_of(header, data);
    if (operation == kIndex) check_index(header, data, chunk);
  }
  return true;
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
    fail({path, 0}, "is no rosbag of ROS 1: it does not begin with '#ROSBAG V2.0'");
  }
}

}  // namespace

void require_whole_bag(const std::string& path) {
  require_bag(path);
  bool finished = false;
  try {
    finished = look_through(path);
  } catch (const Damage& damage) {
    fail({path, 0}, fmt::format("is torn or damaged ({}); 'rosbag reindex' may save what is whole",
                                damage.what));
  }
  if (!finished) {
    fail({path, 0}, "has no index, as a recording that was cut off: 'rosbag reindex' makes one");
  }
}

}  // namespace tagfield
