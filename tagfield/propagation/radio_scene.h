// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world at rest as waves see it: flat mirrors, and what stands in the way.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tagfield/world/ray_scene.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// A flat piece of surface that mirrors waves: the points p with normal_W · p = offset_m in one of
/// its triangles, or all of them where it is unbounded.
struct Facet {
  Eigen::Vector3d normal_W;  ///< Unit vector; out of the solid where that is closed.
  double offset_m = 0.0;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles_W;  ///< [m]; empty where unbounded.
  std::uint32_t solid = 0;                                  ///< Index into Scene::collisions.
  /// The closed surface it is part of, for RadioScene; facets of open ones have none and mirror on
  /// both sides. One-sided facets mirror outside, or inside for an antenna within that surface.
  std::uint32_t shell = 0;
  bool two_sided = false;
  bool unbounded = false;
  double area_m2 = std::numeric_limits<double>::infinity();
  /// Its frame: `corner_W + u·axis_u + v·axis_v`, 0 ≤ u ≤ size[0], 0 ≤ v ≤ size[1], bounds it.
  Eigen::Vector3d corner_W;
  Eigen::Vector3d axis_u_W;
  Eigen::Vector3d axis_v_W;
  Eigen::Vector2d size_m;  ///< Infinite where unbounded.
  /// Fills that rectangle.
  bool rectangular = false;
};

struct RadioSceneOptions {
  /// Smaller flat pieces don't mirror: below about a squared wavelength they rather scatter.
  double least_facet_m2 = 0.1;
  /// By collision index: other than 0 where no wave passes (metal). May be empty: none.
  std::vector<char> opaque;
};

/// Flat pieces that were too small to become facets.
struct LeftOut {
  std::size_t count = 0;
  double area_m2 = 0.0;
};

/// A closed surface of triangles, or the half space below a plane, or an open sheet.
struct Shell {
  std::uint32_t solid = 0;  ///< Index into Scene::collisions.
  bool closed = false;
  bool inverted = false;  ///< Its triangles' normals point inwards.
};

/// Facets are triangles of one solid that are flat to 0.1 mm and joined by edges, so a box has six,
/// and a plane is one without bounds. The curved sides of cylinders and spheres don't mirror but
/// stand in the way as triangulate() has them; cylinders' caps mirror. May be used by several
/// threads at once.
class RadioScene {
 public:
  /// Keeps no reference to `scene`. Throws Error, naming the collision, where RayScene does, and
  /// if `opaque` is neither empty nor as long as the scene's collisions or `least_facet_m2` is not
  /// a number ≥ 0.
  explicit RadioScene(const Scene& scene, const RadioSceneOptions& options = {});

  [[nodiscard]] const std::vector<Facet>& facets() const { return facets_; }
  [[nodiscard]] const LeftOut& left_out() const { return left_out_; }
  [[nodiscard]] const std::vector<Shell>& shells() const { return shells_; }
  [[nodiscard]] bool is_opaque(std::uint32_t solid) const { return opaque_[solid] != 0; }
  /// By collision index.
  [[nodiscard]] const std::vector<char>& opaque() const { return opaque_; }
  [[nodiscard]] const RayScene& rays() const { return rays_; }
  /// The shell of a triangle of world_mesh(collision), or of a plane (triangle 0).
  [[nodiscard]] std::uint32_t shell_of(std::uint32_t collision, std::uint32_t triangle) const {
    return triangle_shells_[first_triangles_[collision] + triangle];
  }
  /// Whether facet `to` has points in front of (to the side of the normal), or behind, the plane of
  /// facet `from`: only then can a wave go there from that side of `from`.
  [[nodiscard]] bool reaches(std::size_t from, bool front, std::size_t to) const;

 private:
  void add_plane(const Collision& collision, std::uint32_t solid);
  void add_solid(const Collision& collision, std::uint32_t solid, double least_m2);

  RayScene rays_;
  std::vector<char> opaque_;
  std::vector<Facet> facets_;
  LeftOut left_out_;
  std::vector<Shell> shells_;
  std::vector<std::size_t> first_triangles_;
  std::vector<std::uint32_t> triangle_shells_;
  std::vector<char> sides_;  ///< By pair; empty where there are too many.
};

}  // namespace tagfield
