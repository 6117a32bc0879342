/// @file
/// Rays through a world at rest, by Embree.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

struct Ray {
  Eigen::Vector3f origin;     ///< [m, world]
  Eigen::Vector3f direction;  ///< Unit vector.
  float most_m = 0.0F;        ///< How far it goes.
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

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
