// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros1/bag_transforms.h"

#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// As for poses in a table (docs/files.md): a straight line may bridge more time only where the
/// antenna stays in place.
constexpr Duration kMaxGap = std::chrono::milliseconds(500);
constexpr double kStillDistance_m = 0.01;

/// tf2 interprets stamp 0 as "the latest"; so all stamps are counted from a second before the
/// first.
class TransformClock {
 public:
  TransformClock(const std::vector<StampedTransform>& transforms,
                 const std::vector<RecordedUpdate>& updates) {
    Time first = Time::max();
    Time last = Time::min();
    const auto take = [&](Time stamp) {
      first = std::min(first, stamp);
      last = std::max(last, stamp);
    };
    for (const StampedTransform& transform : transforms) {
      if (!transform.is_static) take(transform.stamp);
    }
    for (const RecordedUpdate& update : updates) take(update.stamp);
    if (first > last) first = last = Time{};
    zero_ = first - std::chrono::seconds(1);
    span_s_ = std::chrono::duration_cast<std::chrono::seconds>(last - first).count();
  }

  [[nodiscard]] ros::Time operator()(Time stamp) const {
    ros::Time converted;
    converted.fromNSec(static_cast<std::uint64_t>((stamp - zero_).count()));
    return converted;
  }
  /// From the first stamp to the last, with a margin.
  [[nodiscard]] ros::Duration span() const {
    // A ros::Duration holds 68 years.
    if (span_s_ > 2'000'000'000) throw Error("stamps of transforms are over 60 years apart");
    return {static_cast<std::int32_t>(span_s_) + 10, 0};
  }

 private:
  Time zero_;
  std::int64_t span_s_ = 0;
};

geometry_msgs::TransformStamped to_message(const StampedTransform& transform,
                                           const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = transform.parent;
  message.child_frame_id = transform.child;
  message.transform.translation.x = transform.X_PC.translation.x();
  message.transform.translation.y = transform.X_PC.translation.y();
  message.transform.translation.z = transform.X_PC.translation.z();
  message.transform.rotation.x = transform.X_PC.rotation.x();
  message.transform.rotation.y = transform.X_PC.rotation.y();
  message.transform.rotation.z = transform.X_PC.rotation.z();
  message.transform.rotation.w = transform.X_PC.rotation.w();
  return message;
}

RigidTransform from_message(const geometry_msgs::Transform& transform) {
  const geometry_msgs::Quaternion& q = transform.rotation;
  const geometry_msgs::Vector3& p = transform.translation;
  return {Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized(), {p.x, p.y, p.z}};
}

/// The transforms of one frame to its parent, by stamp, and how many of them were passed to tf2.
struct Edge {
  std::vector<StampedTransform> transforms;
  std::size_t handed_over = 0;

  /// The transforms before and after `stamp` if they are too far apart in time.
  [[nodiscard]] std::optional<std::pair<RigidTransform, RigidTransform>> gap_at(Time stamp) const {
    const auto after = std::lower_bound(
        transforms.begin(), transforms.end(), stamp,
        [](const StampedTransform& transform, Time time) { return transform.stamp < time; });
    if (after == transforms.begin() || after == transforms.end() || after->stamp == stamp) {
      return std::nullopt;
    }
    const auto before = std::prev(after);
    if (after->stamp - before->stamp <= kMaxGap) return std::nullopt;
    return std::pair(before->X_PC, after->X_PC);
  }
};

/// tf2's buffer, filled only up to the requested stamp: it searches the neighbours of a stamp from
/// the newest on, which over a whole bag would take time quadratic in its length.
class RisingBuffer {
 public:
  RisingBuffer(std::vector<StampedTransform> transforms, const TransformClock& clock)
      : clock_(clock), buffer_(clock.span()) {
    for (StampedTransform& transform : transforms) {
      parents_[transform.child] = transform.parent;
      frames_.insert({transform.child, transform.parent});
      if (transform.is_static) {
        buffer_.setTransform(to_message(transform, ros::Time(1)), "bag", true);
      } else {
        edges_[transform.child].transforms.push_back(std::move(transform));
      }
    }
    for (auto& [child, edge] : edges_) {
      std::stable_sort(edge.transforms.begin(), edge.transforms.end(),
                       [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
    }
  }

  [[nodiscard]] bool knows(const std::string& frame) const { return frames_.count(frame) > 0; }
  [[nodiscard]] const std::map<std::string, std::string>& parents() const { return parents_; }

  /// Passes on all transforms up to `stamp`, and for each frame the first one that is not before
  /// it.
  void go_to(Time stamp) {
    for (auto& [child, edge] : edges_) {
      std::size_t& next = edge.handed_over;
      while (next < edge.transforms.size() &&
             (next == 0 || edge.transforms[next - 1].stamp < stamp)) {
        hand_over(edge.transforms[next]);
        ++next;
      }
    }
  }

  /// Whether the pose of frame B in frame F would be a straight line across a gap of a transform on
  /// the way from B to F, in which that moved B.
  [[nodiscard]] bool bridges_gap(const std::string& F, const std::string& B, Time stamp) const {
    std::string frame = B;
    // Terminates even for a loop, which tf2 refuses.
    for (std::size_t i = 0; i < parents_.size() && frame != F; ++i) {
      const auto parent = parents_.find(frame);
      if (parent == parents_.end()) return false;
      const auto edge = edges_.find(frame);
      if (edge != edges_.end() && moves_in_gap(edge->second, frame, B, stamp)) return true;
      frame = parent->second;
    }
    return false;
  }

  /// X_FB of frame B in frame F.
  [[nodiscard]] std::optional<RigidTransform> find(const std::string& F, const std::string& B,
                                                   Time stamp) const {
    try {
      return from_message(buffer_.lookupTransform(F, B, clock_(stamp)).transform);
    } catch (const tf2::TransformException&) {
      return std::nullopt;
    }
  }

 private:
  /// Whether an edge to child frame C moves the origin of B across a gap.
  [[nodiscard]] bool moves_in_gap(const Edge& edge, const std::string& C, const std::string& B,
                                  Time stamp) const {
    const auto gap = edge.gap_at(stamp);
    if (!gap) return false;
    const auto X_CB = find(C, B, stamp);
    if (!X_CB) return false;
    const Eigen::Vector3d& p_CB = X_CB->translation;
    return (gap->second * p_CB - gap->first * p_CB).norm() > kStillDistance_m;
  }

  void hand_over(const StampedTransform& transform) {
    buffer_.setTransform(to_message(transform, clock_(transform.stamp)), "bag");
  }

  const TransformClock& clock_;
  tf2::BufferCore buffer_;
  std::map<std::string, Edge> edges_;  ///< By child frame.
  std::map<std::string, std::string> parents_;
  std::set<std::string> frames_;
};

/// Whether an antenna's pose in `fixed` is based on odometry only, or on a map as well.
std::string source_of(const RisingBuffer& buffer, const std::string& fixed, std::string frame) {
  bool odometry = false;
  // Terminates even for a loop, which tf2 refuses.
  for (std::size_t i = 0; i <= buffer.parents().size(); ++i) {
    if (frame == "map") return "tf";
    odometry = odometry || frame == "odom";
    const auto parent = buffer.parents().find(frame);
    if (frame == fixed || parent == buffer.parents().end()) break;
    frame = parent->second;
  }
  return odometry ? "odometry" : "tf";
}

using Counts = std::map<std::string, std::size_t>;

/// Whether every antenna has a pose in at least half of its updates.
bool suffices(const std::vector<AntennaPose>& poses, const Counts& updates) {
  Counts found;
  for (const AntennaPose& pose : poses) ++found[pose.antenna];
  return std::all_of(updates.begin(), updates.end(),
                     [&](const auto& entry) { return 2 * found[entry.first] >= entry.second; });
}

TransformedPoses chosen(std::vector<TransformedPoses> in_frames, const Counts& updates) {
  TransformedPoses* best = nullptr;
  for (TransformedPoses& in_frame : in_frames) {
    if (!in_frame.poses.empty() && suffices(in_frame.poses, updates)) return in_frame;
    if (best == nullptr || in_frame.poses.size() > best->poses.size()) best = &in_frame;
  }
  if (best == nullptr || best->poses.empty()) return {};
  return std::move(*best);
}

}  // namespace

TransformedPoses poses_from_transforms(std::vector<StampedTransform> transforms,
                                       const std::vector<RecordedUpdate>& updates,
                                       const std::vector<std::string>& frames) {
  const TransformClock clock(transforms, updates);
  RisingBuffer buffer(std::move(transforms), clock);
  std::vector<TransformedPoses> in_frames;
  for (const std::string& frame : frames) {
    if (buffer.knows(frame)) in_frames.push_back({frame, "tf", {}});
  }
  Counts counts;
  for (const RecordedUpdate& update : updates) {
    if (!buffer.knows(update.frame)) continue;
    buffer.go_to(update.stamp);
    ++counts[update.antenna];
    for (TransformedPoses& in_frame : in_frames) {
      const auto X_FA = buffer.find(in_frame.frame, update.frame, update.stamp);
      if (!X_FA || buffer.bridges_gap(in_frame.frame, update.frame, update.stamp)) continue;
      if (source_of(buffer, in_frame.frame, update.frame) == "odometry") {
        in_frame.source = "odometry";
      }
      in_frame.poses.push_back({update.stamp, update.antenna, *X_FA});
    }
  }
  return chosen(std::move(in_frames), counts);
}

}  // namespace tagfield
