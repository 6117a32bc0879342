// SPDX-License-Identifier: Apache-2.0
/// @file
/// All paths from an antenna to a tag by the method of images. docs/propagation.md has the method
/// and where it departs from waves.
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
  int order = 0;              ///< Most bounces: 0 … kMostBounces.
  bool occlusion = true;      ///< Off: nothing stands in the way, and there are no crossings.
  bool keep_blocked = false;  ///< Paths through something opaque are kept, and marked so.
  double most_length_m = std::numeric_limits<double>::infinity();  ///< Longer paths are left out.
  /// An end that is inside a solid by no more than this counts as mounted on its surface, and is
  /// seen from outside.
  double mount_depth_m = 0.015;
  bool operator==(const TraceOptions&) const = default;
};

/// An antenna mirrored by a facet, or an image mirrored once more.
struct Image {
  Eigen::Vector3d p_W;       ///< [m]
  Eigen::Vector3d normal_W;  ///< Of the facet, to the side where the wave is before and after.
  double offset_m = 0.0;     ///< Of the facet's plane: normal_W · p.
  std::uint32_t facet = 0;   ///< Index into RadioScene::facets().
  std::int32_t parent = -1;  ///< Index of the image that is mirrored; -1 for the antenna.
  int order = 1;             ///< Number of mirrors.
};

/// Where kBeamLanes images can be seen, and a bit more, in single precision for a quick first look:
/// the places p, from the antenna [m], with normals[k]·p + offsets[k] ≥ 0 for each k. One image a
/// lane; the last block's spare lanes are seen from nowhere.
inline constexpr int kBeamLanes = 8;
struct BeamBlock {
  using Lanes = Eigen::Array<float, kBeamLanes, 1>;
  static constexpr std::size_t kPlanes = 5;
  std::array<std::array<Lanes, 3>, kPlanes> normals;
  std::array<Lanes, kPlanes> offsets;
};

/// All images of one antenna position, shared by all tags of an update.
struct ImageSet {
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();  ///< The antenna [m].
  std::vector<Image> images;                       ///< By rising order, each after its parent.
  std::vector<BeamBlock> beams;                    ///< kBeamLanes images each.
  std::vector<char> around{};                      ///< shells_around() the antenna.
};

/// What was in the way of one tag's paths when they were traced last: it is tried first the next
/// time, which makes that quicker, not different. At most kMostStops of them, 6 kB.
inline constexpr std::size_t kMostStops = 256;
struct LastStops {
  struct Stop {
    std::uint64_t way = 0;        ///< The path's mirrors in order.
    std::uint32_t collision = 0;  ///< What stops it there,
    std::uint32_t triangle = 0;   ///< by the numbers of SurfaceHit,
    int leg = 0;                  ///< on this leg.
  };
  std::vector<Stop> stops{};  ///< By rising `way`.
  std::vector<Stop> next{};   ///< Workspace.
};

/// The closed solids that a place is in: by shell (RadioScene::shells()) other than 0 where `p_W`
/// [m] is inside. Seen from two ends in the same solids, paths are the same: those of one end's
/// images to the other, turned round.
std::vector<char> shells_around(const RadioScene& scene, const Eigen::Vector3d& p_W);

/// The images of an antenna at `p_WA` [m, world] up to `options.order`, less those that no place
/// could see. None if `p_WA` is not finite or further than 1e9 m from the origin along an axis.
/// Throws Error if `options.order` is not 0 … kMostBounces or another option is out of range.
ImageSet images_of(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                   const TraceOptions& options);

/// All paths from the antenna of `images` to a tag at `p_WT` [m, world] with at most
/// `options.order` bounces (and at most those that `images` was made for): the direct one first,
/// then by rising number of bounces and facet indices. `paths` holds them and nothing else; its
/// memory is reused. None if an end is not finite or that far away, or if the ends coincide. Throws
/// as images_of().
void trace_paths(const RadioScene& scene, const ImageSet& images, const Eigen::Vector3d& p_WT,
                 const TraceOptions& options, std::vector<RadioPath>& paths);

/// Likewise, to the same bits, with what stopped this tag's paths before, in the same scene.
void trace_paths(const RadioScene& scene, const ImageSet& images, const Eigen::Vector3d& p_WT,
                 const TraceOptions& options, LastStops& last, std::vector<RadioPath>& paths);

/// Whether nothing opaque is on the straight way between two points [m, world]. True if one is no
/// place for an end (see trace_paths()).
bool is_unobstructed(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                     const Eigen::Vector3d& p_WT, const TraceOptions& options = {});

/// All solids that the straight way from `p_WA` to `p_WT` [m, world] goes through, opaque ones too,
/// in order. None if one is no place for an end.
std::vector<Crossing> straight_crossings(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                                         const Eigen::Vector3d& p_WT,
                                         const TraceOptions& options = {});

}  // namespace tagfield
