// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/solids.h"

#include <algorithm>
#include <cstdint>

#include "tagfield/world/internal/revolution.h"

namespace tagfield {
namespace {

using Eigen::Vector2d;

struct Edge {
  Vector2d from;
  Vector2d to;
};

std::vector<Edge> edges_of(const Outline& outline) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& next = outline[(i + 1) % outline.size()];
    if (outline[i] != next) edges.push_back({outline[i], next});
  }
  return edges;
}

double x_at(const Edge& edge, double y) {
  if (y == edge.from.y()) return edge.from.x();
  if (y == edge.to.y()) return edge.to.x();
  const double share = (y - edge.from.y()) / (edge.to.y() - edge.from.y());
  return edge.from.x() + share * (edge.to.x() - edge.from.x());
}

bool reaches_over(const Edge& edge, double low, double high) {
  return std::min(edge.from.y(), edge.to.y()) <= low &&
         std::max(edge.from.y(), edge.to.y()) >= high;
}

/// Twice the signed area, positive for a counterclockwise outline.
double doubled_area(const std::vector<Edge>& edges) {
  double area = 0.0;
  for (const Edge& e : edges) area += e.from.x() * e.to.y() - e.from.y() * e.to.x();
  return area;
}

/// Whether `edges` enclose `p`: a ray from there along x crosses them an odd number of times.
bool encloses(const std::vector<Edge>& edges, const Vector2d& p) {
  bool inside = false;
  for (const Edge& e : edges) {
    if ((e.from.y() > p.y()) == (e.to.y() > p.y())) continue;
    if (x_at(e, p.y()) > p.x()) inside = !inside;
  }
  return inside;
}

class PrismMaker {
 public:
  PrismMaker(const std::vector<Outline>& outlines, double height) : height_(height) {
    for (const Outline& outline : outlines) outlines_.push_back(edges_of(outline));
  }

  TriangleMesh make() {
    for (const auto& edges : outlines_) add_walls(edges, has_inside_to_the_left(edges));
    add_floors();
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] bool has_inside_to_the_left(const std::vector<Edge>& edges) const {
    bool is_left = doubled_area(edges) > 0.0;
    if (edges.empty()) return is_left;
    const Vector2d middle = 0.5 * (edges.front().from + edges.front().to);
    for (const auto& others : outlines_) {
      if (&others != &edges && encloses(others, middle)) is_left = !is_left;
    }
    return is_left;
  }

  void add_walls(const std::vector<Edge>& edges, bool inside_is_left) {
    for (const Edge& edge : edges) {
      const Vector2d& a = inside_is_left ? edge.from : edge.to;
      const Vector2d& b = inside_is_left ? edge.to : edge.from;
      add(at(a, 0.0), at(b, 0.0), at(b, height_));
      add(at(a, 0.0), at(b, height_), at(a, height_));
    }
  }

  /// Trapezoids between consecutive y coordinates of vertices.
  void add_floors() {
    std::vector<double> ys;
    std::vector<Edge> all;
    for (const auto& edges : outlines_) {
      for (const Edge& edge : edges) ys.push_back(edge.from.y());
      all.insert(all.end(), edges.begin(), edges.end());
    }
    std::sort(ys.begin(), ys.end());
    ys.erase(std::unique(ys.begin(), ys.end()), ys.end());
    for (std::size_t i = 0; i + 1 < ys.size(); ++i) add_slab(all, ys[i], ys[i + 1]);
  }

  void add_slab(const std::vector<Edge>& edges, double low, double high) {
    std::vector<Edge> across;
    for (const Edge& edge : edges) {
      if (!reaches_over(edge, low, high)) continue;
      across.push_back({{x_at(edge, low), low}, {x_at(edge, high), high}});
    }
    std::sort(across.begin(), across.end(), [](const Edge& a, const Edge& b) {
      return a.from.x() + a.to.x() < b.from.x() + b.to.x();
    });
    for (std::size_t i = 0; i + 1 < across.size(); i += 2) {
      add_floor(across[i].from, across[i + 1].from, across[i + 1].to);
      add_floor(across[i].from, across[i + 1].to, across[i].to);
    }
  }

  /// Adds a triangle, counterclockwise seen from above, at the top, and its mirror image at the
  /// bottom.
  void add_floor(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    if (a == b || b == c || c == a) return;
    add(at(a, height_), at(b, height_), at(c, height_));
    add(at(a, 0.0), at(c, 0.0), at(b, 0.0));
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.push_back({a, b, c});
  }

  std::uint32_t at(const Vector2d& p, double z) {
    mesh_.vertices.emplace_back(p.x(), p.y(), z);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  std::vector<std::vector<Edge>> outlines_;
  double height_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh capsule_mesh(double radius, double length) {
  std::vector<Ring> rings;
  const double half = 0.5 * length;
  for (const Ring& ring : sphere_rings(radius)) {
    // The middle ring is used twice, once at each end of the cylinder.
    if (ring.z <= 1e-9 * radius) rings.push_back({ring.radius, ring.z - half});
    if (ring.z >= -1e-9 * radius) rings.push_back({ring.radius, ring.z + half});
  }
  return solid_of_revolution(-half - radius, half + radius, rings);
}

TriangleMesh cone_mesh(double radius, double length) {
  const double half = 0.5 * length;
  return solid_of_revolution(-half, half, {{radius, -half}});
}

TriangleMesh ellipsoid_mesh(const Eigen::Vector3d& radii) {
  TriangleMesh mesh = solid_of_revolution(-1.0, 1.0, sphere_rings(1.0));
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = vertex.cwiseProduct(radii);
  return mesh;
}

TriangleMesh prism_mesh(const std::vector<Outline>& outlines, double height) {
  double area = 0.0;
  for (const Outline& outline : outlines) area += std::abs(doubled_area(edges_of(outline)));
  if (!(area > 0.0)) return {};
  return PrismMaker(outlines, height).make();
}

}  // namespace tagfield
