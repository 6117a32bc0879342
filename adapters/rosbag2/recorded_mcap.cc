// SPDX-License-Identifier: Apache-2.0
#include <map>

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
      messages_ += static_cast<double>(reader_.message_count(id));
    }
  }

  [[nodiscard]] const std::vector<RecordedTopic>& topics() const override { return topics_; }
  void read(const Tell& tell) override {
    double done = 0.0;
    reader_.read([&](const McapMessage& message) {
      tell(indexes_.at(message.channel), message.bytes, ++done / messages_);
    });
  }

 private:
  McapReader reader_;
  std::vector<RecordedTopic> topics_;
  std::map<McapChannelId, std::size_t> indexes_;
  double messages_ = 0.0;
};

}  // namespace

std::unique_ptr<RecordedFile> open_recorded_mcap(const std::string& path,
                                                 Diagnostics& diagnostics) {
  return std::make_unique<RecordedMcap>(path, diagnostics);
}

}  // namespace tagfield
