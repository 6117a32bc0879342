// SPDX-License-Identifier: Apache-2.0
/// @file
/// One file of a ROS 2 recording: topics, and messages as bytes, independent of the file format.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

struct RecordedTopic {
  std::string name;
  std::string type;      ///< "tagfield_msgs/msg/TagReads"
  std::string encoding;  ///< Encoding of its messages: "cdr".
};

class RecordedFile {
 public:
  /// Called with a message of the topic with that index; `share` of the file has been read, 0 … 1.
  using Tell = std::function<void(std::size_t topic, std::string_view bytes, double share)>;

  RecordedFile() = default;
  virtual ~RecordedFile() = default;
  RecordedFile(const RecordedFile&) = delete;
  RecordedFile& operator=(const RecordedFile&) = delete;

  [[nodiscard]] virtual const std::vector<RecordedTopic>& topics() const = 0;
  /// Passes all intact messages of the topics for which `wanted` is not 0 to `tell`, in the order
  /// in which they were recorded; can be called repeatedly. Damaged parts are skipped, with a
  /// warning.
  virtual void read(const std::vector<char>& wanted, const Tell& tell,
                    Diagnostics& diagnostics) = 0;
};

/// Open an MCAP file (docs/mcap.md), or, whatever its name, a rosbag2 database: SQLite with the
/// tables topics (id, name, type, serialization_format) and messages (topic_id, data). Truncated or
/// damaged parts are skipped, with a warning. Throw Error if there is no such file, or this program
/// was built without support for its kind.
std::unique_ptr<RecordedFile> open_recorded_mcap(const std::string& path, Diagnostics& diagnostics);
std::unique_ptr<RecordedFile> open_recorded_database(const std::string& path,
                                                     Diagnostics& diagnostics);

}  // namespace tagfield
