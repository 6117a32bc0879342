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
/// triangles of triangulate(); a plane is endless in its own way (analytic). May be used by several
/// threads at once.
class RayScene {
 public:
  /// Keeps no reference to `scene`.
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Distance to the first surface from either side [m], or +infinity where nothing is within
  /// most_m.
  [[nodiscard]] float distance(const Ray& ray) const;
  /// Likewise for many rays, by Embree's packets; `distances` has one for each ray.
  void distances(const std::vector<Ray>& rays, std::vector<float>& distances) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
