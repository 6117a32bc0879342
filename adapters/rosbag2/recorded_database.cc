// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>

#include "adapters/rosbag2/internal/database.h"
#include "adapters/rosbag2/recorded_file.h"

namespace tagfield {
namespace {

using rosbag2_internal::Database;
using rosbag2_internal::Rows;

class RecordedDatabase : public RecordedFile {
 public:
  RecordedDatabase(const std::string& path, Diagnostics& diagnostics)
      : path_(path), database_(path) {
    for (const char* table : {"topics", "messages"}) {
      if (!database_.has_table(table)) {
        fail({path_, 0},
             fmt::format("is not a database of rosbag2, or a broken one: no table '{}'", table));
      }
    }
    read_topics(diagnostics);
  }

  [[nodiscard]] const std::vector<RecordedTopic>& topics() const override { return topics_; }
  void read(const std::vector<char>& wanted, const Tell& tell, Diagnostics& diagnostics) override;

 private:
  void read_topics(Diagnostics& diagnostics);
  [[nodiscard]] bool is_too_much(std::uint64_t rows, std::uint64_t bytes,
                                 Diagnostics& diagnostics) const;

  std::string path_;
  Database database_;
  std::vector<RecordedTopic> topics_;
  std::map<std::int64_t, std::size_t> indexes_;  ///< By the topics' ids in the file.
};

void RecordedDatabase::read_topics(Diagnostics& diagnostics) {
  Rows rows = database_.rows("SELECT id, name, type, serialization_format FROM topics NOT INDEXED");
  while (rows.next()) {
    if (!indexes_.emplace(rows.number(0), topics_.size()).second) continue;
    topics_.push_back(
        {std::string(rows.bytes(1)), std::string(rows.bytes(2)), std::string(rows.bytes(3))});
  }
  if (!rows.is_broken()) return;
  diagnostics.warn({path_, 0}, fmt::format("its topics are broken ({})", database_.complaint()));
}

/// Pages that are referenced repeatedly could make a small file endless.
bool RecordedDatabase::is_too_much(std::uint64_t rows, std::uint64_t bytes,
                                   Diagnostics& diagnostics) const {
  if (rows <= database_.size() && bytes <= database_.size()) return false;
  diagnostics.warn({path_, 0},
                   "is broken: it has more messages than fit into it; the rest is left out");
  return true;
}

void RecordedDatabase::read(const std::vector<char>& wanted, const Tell& tell,
                            Diagnostics& diagnostics) {
  // In table order, which is the order of recording. An index may be corrupt independently of the
  // table.
  Rows rows = database_.rows("SELECT topic_id, data FROM messages NOT INDEXED");
  std::uint64_t count = 0;
  std::uint64_t bytes = 0;
  while (rows.next()) {
    const std::string_view data = rows.bytes(1);
    bytes += data.size();
    if (is_too_much(++count, bytes, diagnostics)) return;
    const auto topic = indexes_.find(rows.number(0));
    if (topic == indexes_.end() || !rows.is_blob(1)) {
      diagnostics.warn({path_, 0},
                       "messages without bytes, or of a topic that is not there, are left out");
      continue;
    }
    if (wanted.at(topic->second) == 0) continue;
    tell(topic->second, data, static_cast<double>(bytes) / static_cast<double>(database_.size()));
  }
  if (!rows.is_broken()) return;
  diagnostics.warn({path_, 0},
                   fmt::format("is cut off or broken after {} messages ({}); those are used", count,
                               database_.complaint()));
}

}  // namespace

std::unique_ptr<RecordedFile> open_recorded_database(const std::string& path,
                                                     Diagnostics& diagnostics) {
  return std::make_unique<RecordedDatabase>(path, diagnostics);
}

}  // namespace tagfield
