// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_transforms.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "tagfield/poses/trajectory.h"

namespace tagfield {
namespace {

/// As for poses in a table (docs/files.md): a straight line may bridge more time only where the
/// antenna stays in place.
constexpr Duration kMaxGap = std::chrono::milliseconds(500);
constexpr double kStillDistance_m = 0.01;

/// A frame as seen from another one.
struct Seen {
  std::string from;
  RigidTransform X;  ///< The pose of the frame in `from`.
};

/// The transforms of one frame to its parent, by stamp. If all are static, the last one counts.
struct Edge {
  std::vector<StampedTransform> transforms;
  bool is_static = true;

  [[nodiscard]] auto first_from(Time stamp) const {
    return std::lower_bound(
        transforms.begin(), transforms.end(), stamp,
        [](const StampedTransform& transform, Time time) { return transform.stamp < time; });
  }

  /// As tf2 does it: interpolated, but never before the first stamp or after the last. Where the
  /// parent changes in between, the earlier transform counts.
  [[nodiscard]] std::optional<Seen> at(Time stamp) const {
    if (is_static) return Seen{transforms.back().parent, transforms.back().X_PC};
    const auto after = first_from(stamp);
    if (after == transforms.end()) return std::nullopt;
    if (after->stamp == stamp) return Seen{after->parent, after->X_PC};
    if (after == transforms.begin()) return std::nullopt;
    const auto before = std::prev(after);
    if (before->parent != after->parent) return Seen{before->parent, before->X_PC};
    const double share =
        to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
    return Seen{before->parent, interpolate(before->X_PC, after->X_PC, share)};
  }

  /// The transforms before and after `stamp` if they are too far apart in time.
  [[nodiscard]] std::optional<std::pair<RigidTransform, RigidTransform>> gap_at(Time stamp) const {
    if (is_static) return std::nullopt;
    const auto after = first_from(stamp);
    if (after == transforms.begin() || after == transforms.end() || after->stamp == stamp) {
      return std::nullopt;
    }
    const auto before = std::prev(after);
    if (after->stamp - before->stamp <= kMaxGap) return std::nullopt;
    return std::pair(before->X_PC, after->X_PC);
  }
};

/// All transforms of a recording.
class TransformTree {
 public:
  explicit TransformTree(std::vector<StampedTransform> transforms) {
    for (StampedTransform& transform : transforms) {
      parents_[transform.child] = transform.parent;
      frames_.insert({transform.child, transform.parent});
      Edge& edge = edges_[transform.child];
      if (edge.is_static && !transform.is_static) edge = {{}, false};
      if (edge.is_static == transform.is_static) edge.transforms.push_back(std::move(transform));
    }
    for (auto& [child, edge] : edges_) {
      if (edge.is_static) continue;
      std::stable_sort(edge.transforms.begin(), edge.transforms.end(),
                       [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
    }
  }

  [[nodiscard]] bool knows(const std::string& frame) const { return frames_.count(frame) > 0; }
  [[nodiscard]] const std::map<std::string, std::string>& parents() const { return parents_; }

  /// Whether the pose of frame B in frame F would be a straight line across a gap of a transform on
  /// the way from B to F, in which that moved B.
  [[nodiscard]] bool bridges_gap(const std::string& F, const std::string& B, Time stamp) const {
    std::string frame = B;
    // Terminates even for a loop.
    for (std::size_t i = 0; i < parents_.size() && frame != F; ++i) {
      const auto parent = parents_.find(frame);
      if (parent == parents_.end()) return false;
      const auto edge = edges_.find(frame);
      if (edge != edges_.end() && moves_in_gap(edge->second, frame, B, stamp)) return true;
      frame = parent->second;
    }
    return false;
  }

  /// X_FB of frame B in frame F, by way of their nearest common ancestor.
  [[nodiscard]] std::optional<RigidTransform> find(const std::string& F, const std::string& B,
                                                   Time stamp) const {
    const std::vector<Seen> above_B = seen_from_above(B, stamp);
    for (const Seen& of_F : seen_from_above(F, stamp)) {
      for (const Seen& of_B : above_B) {
        if (of_B.from == of_F.from) return of_F.X.inverse() * of_B.X;
      }
    }
    return std::nullopt;
  }

 private:
  /// From itself and, as far as their transforms are known at `stamp`, from all its ancestors. Of a
  /// loop, which tf has no poses in, only from itself.
  [[nodiscard]] std::vector<Seen> seen_from_above(const std::string& frame, Time stamp) const {
    std::vector<Seen> seen = {{frame, {}}};
    for (auto edge = edges_.find(frame); edge != edges_.end();
         edge = edges_.find(seen.back().from)) {
      const std::optional<Seen> next = edge->second.at(stamp);
      if (!next) break;
      seen.push_back({next->from, next->X * seen.back().X});
      if (seen.size() > edges_.size() + 1) return {{frame, {}}};
    }
    return seen;
  }

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

  std::map<std::string, Edge> edges_;  ///< By child frame.
  std::map<std::string, std::string> parents_;
  std::set<std::string> frames_;
};

/// Whether an antenna's pose in `fixed` is based on odometry only, or on a map as well.
std::string source_of(const TransformTree& tree, const std::string& fixed, std::string frame) {
  bool odometry = false;
  // Terminates even for a loop.
  for (std::size_t i = 0; i <= tree.parents().size(); ++i) {
    if (frame == "map") return "tf";
    odometry = odometry || frame == "odom";
    const auto parent = tree.parents().find(frame);
    if (frame == fixed || parent == tree.parents().end()) break;
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
  const TransformTree tree(std::move(transforms));
  std::vector<TransformedPoses> in_frames;
  for (const std::string& frame : frames) {
    if (tree.knows(frame)) in_frames.push_back({frame, "tf", {}});
  }
  Counts counts;
  for (const RecordedUpdate& update : updates) {
    if (!tree.knows(update.frame)) continue;
    ++counts[update.antenna];
    for (TransformedPoses& in_frame : in_frames) {
      const auto X_FA = tree.find(in_frame.frame, update.frame, update.stamp);
      if (!X_FA || tree.bridges_gap(in_frame.frame, update.frame, update.stamp)) continue;
      if (source_of(tree, in_frame.frame, update.frame) == "odometry") {
        in_frame.source = "odometry";
      }
      in_frame.poses.push_back({update.stamp, update.antenna, *X_FA});
    }
  }
  return chosen(std::move(in_frames), counts);
}

}  // namespace tagfield
