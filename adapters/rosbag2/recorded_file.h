// SPDX-License-Identifier: Apache-2.0
/// @file
/// One file of a recording of ROS 2: topics, and messages as bytes, whatever the file is made of.
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
  std::string encoding;  ///< Of its messages: "cdr".
};

class RecordedFile {
 public:
  /// Gets a message of the topic with that index; `share` of the file is done, 0 … 1.
  using Tell = std::function<void(std::size_t topic, std::string_view bytes, double share)>;

  RecordedFile() = default;
  virtual ~RecordedFile() = default;
  RecordedFile(const RecordedFile&) = delete;
  RecordedFile& operator=(const RecordedFile&) = delete;

  [[nodiscard]] virtual const std::vector<RecordedTopic>& topics() const = 0;
  /// All messages of the topics for which `wanted` is not 0 that are whole, in the order in which
  /// they were recorded; can be called again. What is broken is left out, with a warning.
  virtual void read(const std::vector<char>& wanted, const Tell& tell,
                    Diagnostics& diagnostics) = 0;
};

/// An MCAP file (docs/mcap.md), or, whatever its name, a database of rosbag2: SQLite with the
/// tables topics (id, name, type, serialization_format) and messages (topic_id, data). What is cut
/// off or broken is left out, with a warning. Throws Error where there is no such file, or this
/// program was built without its kind.
std::unique_ptr<RecordedFile> open_recorded_mcap(const std::string& path, Diagnostics& diagnostics);
std::unique_ptr<RecordedFile> open_recorded_database(const std::string& path,
                                                     Diagnostics& diagnostics);

}  // namespace tagfield
