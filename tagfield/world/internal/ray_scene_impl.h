// SPDX-License-Identifier: Apache-2.0
/// @file
/// The members of RayScene, for its sources.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tagfield/world/internal/embree.h"
#include "tagfield/world/ray_scene.h"

namespace tagfield {

/// The points p with normal · p = offset.
struct WorldPlane {
  Eigen::Vector3d normal;  ///< Unit vector [world].
  double offset = 0.0;     ///< [m]
  std::uint32_t collision = 0;
};

/// The triangles of all collisions except planes, grouped by collision.
struct Triangles {
  std::vector<Eigen::Vector3d> vertices;  ///< [m, world]
  std::vector<std::array<std::uint32_t, 3>> indices;
  std::vector<Eigen::Vector3d> normals;   ///< Unit vectors; zero for degenerate triangles.
  std::vector<Eigen::Vector3d> areas;     ///< The same, as long as twice the triangle's area [m²].
  std::vector<std::uint32_t> collisions;  ///< The collision of each triangle.
  std::vector<std::uint32_t> firsts;      ///< The first triangle of each collision.
};

struct RayScene::Impl {
  // Single-threaded: Embree would start its own threads for building, and nothing else here starts
  // any on its own.
  Impl();
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// The nearest hit of `ray`, given the `distance` to the triangles and adding the planes.
  [[nodiscard]] float with_planes(const Ray& ray, float distance) const;
  /// Up to 16 rays in one call.
  void intersect(const Ray* rays, std::size_t count, float* distances) const;

  RTCDevice device;
  RTCScene scene = nullptr;
  Triangles triangles;
  std::vector<WorldPlane> planes;
};

/// Filter that Embree calls for each hit of RayScene::surfaces().
void gather_surfaces(const RTCFilterFunctionNArguments* hits);

}  // namespace tagfield
