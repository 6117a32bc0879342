// SPDX-License-Identifier: Apache-2.0
/// @file
/// A static world for radio waves: flat reflecting facets, and obstructions.
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

/// A flat piece of surface that reflects waves: the points p with normal_W · p = offset_m in one of
/// its triangles, or all such points if it is unbounded.
struct Facet {
  Eigen::Vector3d normal_W;  ///< Unit vector; outwards if the surface is closed.
  double offset_m = 0.0;
  std::uint32_t solid = 0;  ///< Index into Scene::collisions.
  /// Index into RadioScene::shells(): the surface that the facet is part of. Facets of open
  /// surfaces reflect on both sides; those of closed ones on the outside, or on the inside for an
  /// antenna inside that surface.
  std::uint32_t shell = 0;
  bool two_sided = false;
  bool unbounded = false;
  double area_m2 = std::numeric_limits<double>::infinity();
  /// Its frame and bounding rectangle: corner_W + u·axis_u_W + v·axis_v_W, 0 ≤ u ≤ size_m[0], 0 ≤ v
  /// ≤ size_m[1].
  Eigen::Vector3d corner_W;
  Eigen::Vector3d axis_u_W;
  Eigen::Vector3d axis_v_W;
  Eigen::Vector2d size_m;  ///< Infinite if unbounded.
  /// Whether it fills that rectangle.
  bool rectangular = false;
  /// Corners (u, v) in that frame [m]; empty if unbounded.
  std::vector<std::array<Eigen::Vector2d, 3>> triangles;
};

/// Bounding spheres [m, world] and planes of facets in single precision, one facet per lane, for a
/// fast first test of what a beam meets. Unused lanes have a radius of −∞, unbounded facets of ∞.
inline constexpr std::size_t kFacetLanes = 16;
struct alignas(64) FacetBlock {
  using Lanes = std::array<float, kFacetLanes>;
  std::array<Lanes, 3> centres{};
  Lanes radii{};  ///< With what rounding may take.
  std::array<Lanes, 3> normals{};
  Lanes offsets{};
  Lanes slacks{};  ///< What rounding may take from a height above the plane [m].
};

struct RadioSceneOptions {
  /// Smaller flat pieces don't reflect: below about a squared wavelength they scatter instead.
  double min_facet_m2 = 0.1;
  /// By collision index: nonzero for solids that block waves (metal). Empty if there are none.
  std::vector<char> opaque;
};

/// Flat pieces that are too small to be facets.
struct LeftOut {
  std::size_t count = 0;
  double area_m2 = 0.0;
};

/// A closed surface of triangles, the half space below a plane, or an open sheet.
struct Shell {
  std::uint32_t solid = 0;  ///< Index into Scene::collisions.
  bool closed = false;
  bool inverted = false;  ///< Its triangles' normals point inwards.
};

/// A facet consists of triangles of one solid that are flat to 0.1 mm and joined by edges, so a box
/// has six facets; a plane is one unbounded facet. The curved surfaces of cylinders and spheres
/// don't reflect but obstruct, as triangulated by triangulate(); the caps of cylinders reflect. May
/// be used by several threads concurrently.
class RadioScene {
 public:
  /// Keeps no reference to `scene`. Throws Error, naming the collision, where RayScene does. Also
  /// throws Error if `opaque` is neither empty nor as long as the scene's collisions, or if
  /// `min_facet_m2` is not a number ≥ 0.
  explicit RadioScene(const Scene& scene, const RadioSceneOptions& options = {});

  [[nodiscard]] const std::vector<Facet>& facets() const { return facets_; }
  /// kFacetLanes facets each, in order.
  [[nodiscard]] const std::vector<FacetBlock>& facet_blocks() const { return facet_blocks_; }
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
  /// Whether facet `to` has points in front of the plane of facet `from` (on the side of the
  /// normal) or, if `front` is false, behind it. Only then can a wave travel from that side of
  /// `from` to `to`.
  [[nodiscard]] bool reaches(std::size_t from, bool front, std::size_t to) const;

 private:
  void add_plane(const Collision& collision, std::uint32_t solid);
  void add_solid(const Collision& collision, std::uint32_t solid, double min_m2);

  RayScene rays_;
  std::vector<char> opaque_;
  std::vector<Facet> facets_;
  std::vector<FacetBlock> facet_blocks_;
  LeftOut left_out_;
  std::vector<Shell> shells_;
  std::vector<std::size_t> first_triangles_;
  std::vector<std::uint32_t> triangle_shells_;
  std::vector<char> sides_;  ///< By pair of facets; empty if there are too many.
};

}  // namespace tagfield
