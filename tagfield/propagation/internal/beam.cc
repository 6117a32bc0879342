// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/beam.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "tagfield/propagation/internal/on_facet.h"

namespace tagfield {
namespace {

/// Beams and windows are enlarged by this on each side, so that rounding excludes nothing that the
/// exact test would accept [m].
constexpr double kMargin = 1e-6;

/// A convex polygon: a rectangle cut by up to five planes, each of which adds at most one corner.
class Polygon {
 public:
  void add(const Eigen::Vector3d& p) { corners_[count_++] = p; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] const Eigen::Vector3d& operator[](std::size_t i) const { return corners_[i]; }

 private:
  std::array<Eigen::Vector3d, 16> corners_;
  std::size_t count_ = 0;
};

double height(const Eigen::Vector4d& plane, const Eigen::Vector3d& p) {
  return plane.head<3>().dot(p) + plane.w();
}

/// The part with n·p + w ≥ −kMargin (Sutherland and Hodgman).
Polygon cut(const Polygon& polygon, const Eigen::Vector4d& plane) {
  Polygon rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& p = polygon[i];
    const Eigen::Vector3d& q = polygon[(i + 1) % polygon.size()];
    const double of_p = height(plane, p) + kMargin;
    const double of_q = height(plane, q) + kMargin;
    if (of_p >= 0.0) rest.add(p);
    if ((of_p >= 0.0) != (of_q >= 0.0)) rest.add(p + of_p / (of_p - of_q) * (q - p));
  }
  return rest;
}

Eigen::Vector3d point_of(const Facet& facet, double u, double v) {
  return facet.corner_W + u * facet.axis_u_W + v * facet.axis_v_W;
}

Polygon outline(const Facet& facet, const Window& window) {
  Polygon polygon;
  polygon.add(point_of(facet, window.low.x(), window.low.y()));
  polygon.add(point_of(facet, window.high.x(), window.low.y()));
  polygon.add(point_of(facet, window.high.x(), window.high.y()));
  polygon.add(point_of(facet, window.low.x(), window.high.y()));
  return polygon;
}

/// Whether the facet's bounding circle is behind one of the planes.
bool misses(const BeamSides& beam, const Facet& facet) {
  const Eigen::Vector3d centre = point_of(facet, 0.5 * facet.size_m.x(), 0.5 * facet.size_m.y());
  const double least = -0.5 * facet.size_m.norm() - kMargin;
  for (int i = 0; i < 4; ++i) {
    if (height(beam.row(i), centre) < least) return true;
  }
  return false;
}

}  // namespace

Window whole_window(const Facet& facet) { return {Eigen::Vector2d::Zero(), facet.size_m}; }

std::optional<Window> window_in(const BeamSides& beam, const Image& image, const Facet& facet) {
  if (misses(beam, facet)) return std::nullopt;
  Polygon polygon = outline(facet, whole_window(facet));
  Eigen::Vector4d mirror;
  mirror << image.normal_W, -image.offset_m;
  polygon = cut(polygon, mirror);
  for (int i = 0; i < 4 && polygon.size() > 0; ++i) polygon = cut(polygon, beam.row(i));
  if (polygon.size() == 0) return std::nullopt;
  Window window{in_frame(facet, polygon[0]), in_frame(facet, polygon[0])};
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const Eigen::Vector2d uv = in_frame(facet, polygon[i]);
    window.low = window.low.cwiseMin(uv);
    window.high = window.high.cwiseMax(uv);
  }
  return window;
}

BeamSides beam_through(const Window& window, const Image& image, const Facet& facet) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin);
  const Polygon polygon = outline(facet, {window.low - margin, window.high + margin});
  const Eigen::Vector3d across = polygon[2] - image.p_W;
  BeamSides beam;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d edge = polygon[(i + 1) % 4] - polygon[i];
    Eigen::Vector3d normal = edge.cross(polygon[i] - image.p_W).normalized();
    // The normal points inwards: the opposite corner is inside.
    const Eigen::Vector3d inside = i < 2 ? Eigen::Vector3d(polygon[i + 2] - image.p_W)
                                         : Eigen::Vector3d(polygon[i - 2] - image.p_W);
    if (normal.dot(inside) < 0.0) normal = -normal;
    beam.row(static_cast<int>(i)) << normal.transpose(), -normal.dot(image.p_W);
  }
  // Rounding may put an image into the plane of its window's edge.
  return across.allFinite() && beam.allFinite() ? beam : open_beam();
}

BeamSides mirrored_beam(const BeamSides& beam, const Image& image) {
  BeamSides mirrored = beam;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d n = beam.row(i).head<3>();
    const double along = 2.0 * n.dot(image.normal_W);
    mirrored.row(i).head<3>() = n - along * image.normal_W;
    mirrored(i, 3) = beam(i, 3) + along * image.offset_m;
  }
  return mirrored;
}

BeamSides open_beam() {
  BeamSides beam = BeamSides::Zero();
  beam.col(3).setOnes();
  return beam;
}

double distance_to(const Window& window, const Facet& facet, const Eigen::Vector3d& p) {
  const Eigen::Vector2d uv = in_frame(facet, p).cwiseMax(window.low).cwiseMin(window.high);
  return (point_of(facet, uv.x(), uv.y()) - p).norm();
}

}  // namespace tagfield
