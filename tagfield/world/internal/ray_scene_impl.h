// SPDX-License-Identifier: Apache-2.0
/// @file
/// What RayScene keeps, for its sources.
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

/// Those of all collisions but planes, one collision after the other.
struct Triangles {
  std::vector<Eigen::Vector3d> vertices;  ///< [m, world]
  std::vector<std::array<std::uint32_t, 3>> indices;
  std::vector<Eigen::Vector3d> normals;   ///< Unit vectors; zero where there is no area.
  std::vector<std::uint32_t> collisions;  ///< Of each triangle.
  std::vector<std::uint32_t> firsts;      ///< By collision: its first triangle.
};

struct RayScene::Impl {
  // One thread: Embree would start its own to build, and nothing else here does unasked.
  Impl();
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// `ray` and what the triangles answered, with the planes before it.
  [[nodiscard]] float with_planes(const Ray& ray, float distance) const;
  /// Up to 16 rays at once.
  void intersect(const Ray* rays, std::size_t count, float* distances) const;

  RTCDevice device;
  RTCScene scene = nullptr;
  Triangles triangles;
  std::vector<WorldPlane> planes;
};

/// Embree asks this of each hit of RayScene::surfaces().
void gather_surfaces(const RTCFilterFunctionNArguments* hits);

}  // namespace tagfield
