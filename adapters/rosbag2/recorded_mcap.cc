// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <set>

#include "adapters/mcap/mcap_reader.h"
#include "adapters/rosbag2/recorded_file.h"

namespace tagfield {
namespace {

class RecordedMcap : public RecordedFile {
 public:
  RecordedMcap(const std::string& path, Diagnostics& diagnostics) : reader_(path, diagnostics) {
    for (const auto& [id, channel] : reader_.channels()) {
      indexes_[id] = topics_.size();
      topics_.push_back(
          {channel.topic, channel.schema ? channel.schema->name : "", channel.message_encoding});
    }
  }

  [[nodiscard]] const std::vector<RecordedTopic>& topics() const override { return topics_; }
  void read(const std::vector<char>& wanted, const Tell& tell,
            Diagnostics& /*diagnostics*/) override {
    std::set<McapChannelId> channels;
    double messages = 0.0;
    for (const auto& [id, index] : indexes_) {
      if (wanted.at(index) == 0) continue;
      channels.insert(id);
      messages += static_cast<double>(reader_.message_count(id));
    }
    double done = 0.0;
    reader_.read(channels, [&](const McapMessage& message) {
      tell(indexes_.at(message.channel), message.bytes, ++done / messages);
    });
  }

 private:
  McapReader reader_;
  std::vector<RecordedTopic> topics_;
  std::map<McapChannelId, std::size_t> indexes_;
};

}  // namespace

std::unique_ptr<RecordedFile> open_recorded_mcap(const std::string& path,
                                                 Diagnostics& diagnostics) {
  return std::make_unique<RecordedMcap>(path, diagnostics);
}

}  // namespace tagfield
