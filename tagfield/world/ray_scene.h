// SPDX-License-Identifier: Apache-2.0
/// @file
/// Rays through a world at rest, by Embree.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

struct Ray {
  Eigen::Vector3f origin;     ///< [m, world]
  Eigen::Vector3f direction;  ///< Unit vector.
  float most_m = 0.0F;        ///< How far it goes.
};

/// The points origin + s·direction with from_m ≤ s ≤ to_m.
struct Stretch {
  Eigen::Vector3d origin;     ///< [m, world]
  Eigen::Vector3d direction;  ///< Unit vector.
  double from_m = 0.0;
  double to_m = 0.0;
  /// The search may end at a hit with stop_from_m < s < stop_to_m on a stopping collision.
  double stop_from_m = -std::numeric_limits<double>::infinity();
  double stop_to_m = std::numeric_limits<double>::infinity();
};

/// Where a line meets a surface.
struct SurfaceHit {
  double distance_m = 0.0;      ///< s, from the line's origin.
  double slope = 0.0;           ///< Direction · normal: below 0 where it meets the front.
  std::uint32_t collision = 0;  ///< Index into Scene::collisions.
  std::uint32_t triangle = 0;   ///< Of world_mesh(); 0 for a plane.
  Eigen::Vector3d normal;       ///< Unit vector [world]; of a triangle by its right-hand rule.
};

/// All collisions of a scene, ready for rays. Boxes, meshes, cylinders and spheres are the
/// triangles of triangulate(); a plane is endless in its own way (analytic). No ray slips through
/// an edge or a corner that triangles share. May be used by several threads at once.
class RayScene {
 public:
  /// Keeps no reference to `scene`. Throws Error, naming the collision, if a vertex is not finite
  /// or further than 1e9 m from the world's origin, if a triangle names a vertex that is not there,
  /// or if a plane's normal has no direction.
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Distance to the first surface from either side [m], or +infinity where nothing is within
  /// most_m. The ray is taken as its floats say, and all else is to 1e-6 of the distance. A ray
  /// that begins on a surface may meet it at 0 or miss it; one with a component that is not finite,
  /// or a `most_m` below 0, meets nothing.
  [[nodiscard]] float distance(const Ray& ray) const;
  /// Likewise for many rays, by Embree's packets, which is quicker; `distances` becomes as long as
  /// `rays`. May differ from distance() by its rounding errors, and where a ray just meets the rim
  /// of something.
  void distances(const std::vector<Ray>& rays, std::vector<float>& distances) const;

  /// All surfaces that a stretch of a line meets, in no order: `hits` holds them and nothing else.
  /// A line through an edge may meet both triangles there, and in rare cases a triangle twice.
  /// False if it met a collision for which `stops` (by index; may be empty) is not 0; `hits` may
  /// then lack others. Distances are computed in double precision; a line is decided to meet a
  /// triangle in single precision, so to about 1e-6 of the coordinates at the triangle's rim, and
  /// no line slips through an edge that triangles share, if the stretch is not much longer than the
  /// scene (reach_from()). A stretch that is not finite meets nothing.
  bool surfaces(const Stretch& stretch, const std::vector<char>& stops,
                std::vector<SurfaceHit>& hits) const;
  /// No triangle is further from `p` than this [m]; 0 without triangles.
  [[nodiscard]] double reach_from(const Eigen::Vector3d& p) const;
  /// Whether a stretch clearly ends at this triangle of world_mesh(collision), away from its rim,
  /// if the collision stops it: surfaces() is then false. Never of a plane.
  [[nodiscard]] bool clearly_stops(std::uint32_t collision, std::uint32_t triangle,
                                   const Stretch& stretch) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
