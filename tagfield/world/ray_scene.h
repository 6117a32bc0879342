// SPDX-License-Identifier: Apache-2.0
/// @file
/// Ray casting in a static world, by Embree.
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
  float max_m = 0.0F;         ///< Its length.
};

/// A segment of a line: the points origin + s·direction with from_m ≤ s ≤ to_m.
struct RaySegment {
  Eigen::Vector3d origin;     ///< [m, world]
  Eigen::Vector3d direction;  ///< Unit vector.
  double from_m = 0.0;
  double to_m = 0.0;
  /// The search may end at a hit with stop_from_m < s < stop_to_m on a stopping collision.
  double stop_from_m = -std::numeric_limits<double>::infinity();
  double stop_to_m = std::numeric_limits<double>::infinity();
};

/// The intersection of a line with a surface.
struct SurfaceHit {
  double distance_m = 0.0;      ///< s, from the line's origin.
  double slope = 0.0;           ///< Direction · normal: negative at a front face.
  std::uint32_t collision = 0;  ///< Index into Scene::collisions.
  std::uint32_t triangle = 0;   ///< Index into world_mesh(); 0 for a plane.
  Eigen::Vector3d normal;       ///< Unit vector [world]; right-handed for a triangle.
};

/// All collisions of a scene, prepared for ray casting. Boxes, meshes, cylinders and spheres are
/// the triangles of triangulate(); a plane is infinite and analytic. No ray passes through an edge
/// or a corner shared by triangles. Thread-safe for concurrent use.
class RayScene {
 public:
  /// Keeps no reference to `scene`. Throws Error, naming the collision, if a vertex is not finite
  /// or over 1e9 m from the world's origin, if a triangle's vertex index is out of range, or if a
  /// plane's normal is zero or not finite.
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Distance to the first surface, front or back [m], or +infinity if there is none within max_m.
  /// The ray is used exactly as given in floats; the result is accurate to 1e-6 of the distance. A
  /// ray that starts on a surface may hit it at 0 or miss it; a ray with a component that is not
  /// finite, or with a negative `max_m`, hits nothing.
  [[nodiscard]] float distance(const Ray& ray) const;
  /// Same for many rays, by Embree's packets, which is faster; `distances` is resized to match
  /// `rays`. May differ from distance() by rounding errors, and where a ray just grazes the edge of
  /// something.
  void distances(const std::vector<Ray>& rays, std::vector<float>& distances) const;

  /// All surfaces hit by a segment of a line, in no particular order: `hits` is cleared first. A
  /// line through an edge may hit both triangles there, and in rare cases a triangle twice. False
  /// if the segment hit a collision for which `stops` (by index; may be empty) is not 0; `hits` may
  /// then be incomplete. Distances are computed in double precision. Whether a line hits a triangle
  /// is decided in single precision, so with a tolerance of about 1e-6 of the coordinates at the
  /// triangle's edges, and no line passes through an edge shared by triangles, unless the segment
  /// is much longer than the scene (reach_from()). A segment that is not finite hits nothing.
  bool surfaces(const RaySegment& segment, const std::vector<char>& stops,
                std::vector<SurfaceHit>& hits) const;
  /// Upper bound on the distance from `p` to any triangle [m]; 0 without triangles.
  [[nodiscard]] double reach_from(const Eigen::Vector3d& p) const;
  /// Whether this triangle of world_mesh(collision) clearly stops a segment, well inside the
  /// triangle's edges, if the collision is a stopping one: surfaces() then returns false. Never
  /// true of a plane.
  [[nodiscard]] bool clearly_stops(std::uint32_t collision, std::uint32_t triangle,
                                   const RaySegment& segment) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
