// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include "adapters/ros1/navigation/scan_source.h"

#include <limits>

#include "adapters/ros1/navigation/navigation_messages.h"
#include "tagfield/laser/deskew.h"

namespace tagfield {
namespace {

/// Queue of a busy node: it keeps the newest scans.
constexpr std::uint32_t kScanQueue = 5;
/// Time for which scans wait for tf [s].
constexpr double kPatience = 1.0;
constexpr double kSaySeldom = 5.0;

Time last_beam(const LaserScan& scan) {
  const auto beams = static_cast<std::int64_t>(scan.ranges_m.size());
  return scan.stamp + (beams > 1 ? (beams - 1) * scan.beam_interval : Duration{});
}

}  // namespace

ScanSource::ScanSource(ros::NodeHandle& node, const FrameListener& frames, FrameNames names,
                       bool straighten, std::function<void(const LocatedScan&)> on_scan)
    : frames_(frames),
      names_(std::move(names)),
      straighten_(straighten),
      on_scan_(std::move(on_scan)) {
  using Message = sensor_msgs::LaserScan;
  const auto hear = [this](const boost::shared_ptr<const Message>& message) { take(*message); };
  subscriber_ = node.subscribe<Message>("scan", kScanQueue, hear);
}

void ScanSource::forget() {
  waiting_.clear();
  last_ = Time{};
}

void ScanSource::take(const sensor_msgs::LaserScan& message) {
  try {
    Waiting waiting{scan_of(message), frame_of_message(message.header.frame_id)};
    const Time newest = waiting_.empty() ? last_ : waiting_.back().scan.stamp;
    if (waiting.scan.stamp <= newest) {
      ROS_WARN_THROTTLE(kSaySeldom, "a scan that is not newer than the last is dropped");
      return;
    }
    waiting_.push_back(std::move(waiting));
  } catch (const Error& error) {
    ROS_ERROR_THROTTLE(kSaySeldom, "%s; dropped", error.what());
    return;
  }
  try_again();
}

std::optional<LocatedScan> ScanSource::located(const Waiting& waiting) const {
  const std::optional<RigidTransform> X_RL = frames_.newest(names_.base, waiting.frame);
  if (!X_RL) return std::nullopt;
  const Time end = straighten_ ? last_beam(waiting.scan) : waiting.scan.stamp;
  const std::optional<RigidTransform> X_OR = frames_.find(names_.odom, names_.base, end);
  if (!X_OR) return std::nullopt;
  LocatedScan found{waiting.scan, to_planar(*X_OR), *X_RL};
  if (!straighten_ || waiting.scan.beam_interval == Duration{}) return found;
  const auto odometry_at = [this](Time time) -> PlanarPose {
    constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
    const std::optional<RigidTransform> X = frames_.find(names_.odom, names_.base, time);
    return X ? to_planar(*X) : PlanarPose{kNever, kNever, kNever};
  };
  found.scan = deskewed(waiting.scan, odometry_at, *X_RL);
  return found;
}

void ScanSource::drop_old() {
  while (!waiting_.empty() &&
         to_seconds(waiting_.back().scan.stamp - waiting_.front().scan.stamp) > kPatience) {
    const std::string& laser = waiting_.front().frame;
    std::string why = frames_.trouble(names_.base, laser);
    if (why.empty()) why = frames_.trouble(names_.odom, names_.base);
    if (why.empty()) why = "tf does not reach back to it";
    ROS_WARN_THROTTLE(kSaySeldom, "a scan is dropped: no '%s' in '%s' at its stamp: %s",
                      laser.c_str(), names_.odom.c_str(), why.c_str());
    waiting_.pop_front();
  }
}

void ScanSource::try_again() {
  while (!waiting_.empty()) {
    const std::optional<LocatedScan> found = located(waiting_.front());
    if (!found) break;
    last_ = waiting_.front().scan.stamp;
    waiting_.pop_front();
    on_scan_(*found);
  }
  drop_old();
}

}  // namespace tagfield
