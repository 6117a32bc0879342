// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/message_fields.h"

#include <map>
#include <utility>
#include <vector>

namespace tagfield::recorded {
namespace {

constexpr std::size_t kLongestName = 1000;  ///< Bytes.
constexpr Duration kReset = std::chrono::seconds(1);

/// Keeps each tag's last position, valid from `stamp` on: its message may have been sent only once.
void keep_last_places(std::vector<TagPosition>& positions, Time stamp) {
  std::map<std::string, TagPosition> last;
  for (const TagPosition& position : positions) last[position.tag] = position;
  positions.clear();
  for (auto& [tag, position] : last) {
    position.stamp = stamp;
    positions.push_back(position);
  }
}

void forget(BagContent& content, Time stamp) {
  content.sink->on_reset();
  BagContent kept(*content.sink);
  kept.truth.tag_positions = std::move(content.truth.tag_positions);
  keep_last_places(kept.truth.tag_positions, stamp);
  for (StampedTransform& transform : content.transforms) {
    if (transform.is_static) kept.transforms.push_back(std::move(transform));
  }
  content = std::move(kept);
}

}  // namespace

std::string to_text(const FieldName& name) {
  return fmt::format("{}[{}]{}", name.list, name.index, name.field);
}

std::string fault_of_name(const std::string& name) {
  if (name.empty()) return "is empty, expected a name";
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (name.size() <= kLongestName && std::none_of(name.begin(), name.end(), is_control)) return "";
  return fmt::format("is not a valid name: {} bytes{}", name.size(),
                     name.size() > kLongestName ? "" : ", control characters among them");
}

std::string frame_of(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

std::string last_name(const std::string& topic) {
  const std::size_t slash = topic.find_last_of('/');
  return slash == std::string::npos ? topic : topic.substr(slash + 1);
}

std::string robot_of(const std::string& topic) {
  const std::size_t end = topic.find("ground_truth/odom");
  std::string name = end == std::string::npos ? topic : topic.substr(0, end);
  while (!name.empty() && name.back() == '/') name.pop_back();
  while (!name.empty() && name.front() == '/') name.erase(0, 1);
  return name.empty() ? "robot" : name;
}

void follow_clock(const std::string& stream, Time stamp, const MessageLocation& place,
                  BagContent& content, Diagnostics& diagnostics) {
  const auto latest = content.clock.find(stream);
  if (latest != content.clock.end() && stamp + kReset < latest->second) {
    diagnostics.warn(fmt::format(
        "{}: time goes back from {} s to {} s (was the simulation reset?); only what comes after "
        "counts",
        to_string(place), format_stamp(latest->second), format_stamp(stamp)));
    forget(content, stamp);
  }
  Time& entry = content.clock[stream];
  entry = std::max(entry, stamp);
}

}  // namespace tagfield::recorded
