// SPDX-License-Identifier: Apache-2.0
/// @file
/// All paths from an antenna to a tag by the method of images. docs/propagation.md describes the
/// method and where it departs from real waves.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tagfield/propagation/radio_path.h"
#include "tagfield/propagation/radio_scene.h"

namespace tagfield {

struct TraceOptions {
  int order = 0;              ///< Maximum number of bounces: 0 … kMaxBounces.
  bool occlusion = true;      ///< If false, nothing obstructs and there are no crossings.
  bool keep_blocked = false;  ///< Keep paths through opaque solids, marked as blocked.
  double max_length_m = std::numeric_limits<double>::infinity();  ///< Longer paths are omitted.
  /// An end inside a solid by up to this depth [m] counts as mounted on its surface, and is visible
  /// from outside.
  double mount_depth_m = 0.015;
  bool operator==(const TraceOptions&) const = default;
};

/// An antenna mirrored by a facet, or an image mirrored again.
struct Image {
  Eigen::Vector3d p_W;       ///< [m]
  Eigen::Vector3d normal_W;  ///< Of the facet, towards the side of the incident and reflected wave.
  double offset_m = 0.0;     ///< Of the facet's plane: normal_W · p.
  std::uint32_t facet = 0;   ///< Index into RadioScene::facets().
  std::int32_t parent = -1;  ///< Index of the image that is mirrored; -1 for the antenna.
  int order = 1;             ///< Number of reflections.
};

/// Regions from which kBeamLanes images are visible, slightly enlarged, in single precision for a
/// fast first test: the points p relative to the antenna [m] with normals[k]·p + offsets[k] ≥ 0 for
/// all k. One image per lane; unused lanes of the last block are visible from nowhere.
inline constexpr std::size_t kBeamLanes = 16;
struct alignas(64) BeamBlock {
  using Lanes = std::array<float, kBeamLanes>;
  static constexpr std::size_t kPlanes = 5;
  std::array<std::array<Lanes, 3>, kPlanes> normals{};
  std::array<Lanes, kPlanes> offsets{};
};

/// All images of one antenna position, shared by all tags of an update.
struct ImageSet {
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();  ///< The antenna [m].
  std::vector<Image> images;     ///< In ascending order of Image::order, each after its parent.
  std::vector<BeamBlock> beams;  ///< kBeamLanes images each.
  std::vector<char> around{};    ///< shells_around() the antenna.
};

/// What blocked the paths of one tag when they were last traced. These triangles are tested first
/// the next time, which is faster and doesn't change the results. At most kMaxStops of them, 6 kB.
inline constexpr std::size_t kMaxStops = 256;
struct LastStops {
  struct Stop {
    std::uint64_t way = 0;        ///< The path's facets in order.
    std::uint32_t collision = 0;  ///< What blocks it,
    std::uint32_t triangle = 0;   ///< with the indices of SurfaceHit,
    int leg = 0;                  ///< on this leg.
  };
  std::vector<Stop> stops{};  ///< In ascending order of `way`.
  std::vector<Stop> next{};   ///< Workspace.
};

/// The closed surfaces around a point: by index into RadioScene::shells(), nonzero if `p_W` [m] is
/// inside. If both ends of a link are inside the same ones, tracing is reciprocal: swapping the
/// ends reverses the paths.
std::vector<char> shells_around(const RadioScene& scene, const Eigen::Vector3d& p_W);

/// The images of an antenna at `p_WA` [m, world] up to `options.order`, without those that are
/// visible from nowhere. No images if `p_WA` is not finite or more than 1e9 m from the origin along
/// an axis. Throws Error if `options.order` is not 0 … kMaxBounces or another option is out of
/// range.
ImageSet images_of(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                   const TraceOptions& options);

/// All paths from the antenna of `images` to a tag at `p_WT` [m, world] with at most
/// `options.order` bounces, and no more than `images` was made for: the direct one first, then in
/// ascending order of bounces and facet indices. Overwrites `paths`, reusing its memory. No paths
/// if an end is not finite or too far away (see images_of()), or if the ends coincide. Throws like
/// images_of().
void trace_paths(const RadioScene& scene, const ImageSet& images, const Eigen::Vector3d& p_WT,
                 const TraceOptions& options, std::vector<RadioPath>& paths);

/// Same, with bit-identical results, but faster: `last` holds what blocked this tag's paths in the
/// same scene before.
void trace_paths(const RadioScene& scene, const ImageSet& images, const Eigen::Vector3d& p_WT,
                 const TraceOptions& options, LastStops& last, std::vector<RadioPath>& paths);

/// Whether nothing opaque obstructs the line of sight between two points [m, world]. True if they
/// aren't valid ends (see trace_paths()).
bool is_unobstructed(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                     const Eigen::Vector3d& p_WT, const TraceOptions& options = {});

/// All solids that the line of sight from `p_WA` to `p_WT` [m, world] passes through, including
/// opaque ones, in order. None if these aren't valid ends (see trace_paths()).
std::vector<Crossing> straight_crossings(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                                         const Eigen::Vector3d& p_WT,
                                         const TraceOptions& options = {});

}  // namespace tagfield
