// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/flat_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tagfield/propagation/internal/on_facet.h"

namespace tagfield {
namespace {

constexpr double kFlatPiece = 1e-4;   // [m]
constexpr double kSameNormal = 0.99;  // Cosine between normals; those of small triangles are noisy.
constexpr double kRectangle = 1e-9;   // Relative to the area.
/// The edges of at most this many triangles are tried as directions of the bounding rectangle.
constexpr std::size_t kMaxDirections = 64;

using Corners = std::array<Eigen::Vector3d, 3>;

/// Twice the area, along the normal.
Eigen::Vector3d vector_area(const Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

/// Grows facets from the largest triangles.
class Grower {
 public:
  Grower(const WeldedMesh& mesh, const std::vector<Edge>& edges, const Pieces& pieces,
         const std::vector<char>& mirrors)
      : mesh_(mesh), pieces_(pieces), free_(mirrors), neighbours_(mesh.triangles.size()) {
    for_each_run(edges, [&](const Edge* begin, const Edge* end) {
      for (const Edge* one = begin; one != end; ++one) {
        for (const Edge* other = begin; other != end; ++other) {
          if (one != other) neighbours_[one->triangle].push_back(other->triangle);
        }
      }
    });
  }

  std::vector<std::vector<std::uint32_t>> grow() {
    std::vector<std::vector<std::uint32_t>> regions;
    for (const std::uint32_t seed : by_area()) {
      if (free_[seed] != 0) regions.push_back(grow_from(seed));
    }
    return regions;
  }

  [[nodiscard]] Corners corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
  }

 private:
  [[nodiscard]] std::vector<std::uint32_t> by_area() const {
    std::vector<double> areas;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      areas.push_back(vector_area(corners(i)).norm());
    }
    std::vector<std::uint32_t> order(areas.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return areas[i] > areas[j]; });
    return order;
  }

  /// Whether the triangle is in the seed's plane. In open sheets, triangles may face either side,
  /// as their orientation is unreliable there.
  [[nodiscard]] bool is_flat_with(std::uint32_t triangle, const Eigen::Vector3d& p,
                                  const Eigen::Vector3d& normal) const {
    const Corners abc = corners(triangle);
    const double same = vector_area(abc).normalized().dot(normal);
    const bool closed = pieces_.pieces[pieces_.of_triangle[triangle]].closed;
    if ((closed ? same : std::abs(same)) < kSameNormal) return false;
    return std::all_of(abc.begin(), abc.end(), [&](const Eigen::Vector3d& q) {
      return std::abs(normal.dot(q - p)) < kFlatPiece;
    });
  }

  std::vector<std::uint32_t> grow_from(std::uint32_t seed) {
    const Corners abc = corners(seed);
    const Eigen::Vector3d normal = vector_area(abc).normalized();
    std::vector<std::uint32_t> region{seed};
    free_[seed] = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
      for (const std::uint32_t next : neighbours_[region[i]]) {
        if (free_[next] == 0 || !is_flat_with(next, abc[0], normal)) continue;
        free_[next] = 0;
        region.push_back(next);
      }
    }
    return region;
  }

  const WeldedMesh& mesh_;
  const Pieces& pieces_;
  std::vector<char> free_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
};

/// Approximately the best-fit plane: through the centroid, with the mean normal.
void set_plane(const std::vector<Corners>& triangles, Facet& facet) {
  const Eigen::Vector3d first = vector_area(triangles.front());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const Corners& abc : triangles) {
    const Eigen::Vector3d part = vector_area(abc);
    sum += part.dot(first) < 0.0 ? -part : part;
    centroid += part.norm() * (abc[0] + abc[1] + abc[2]) / 3.0;
    area += part.norm();
  }
  facet.normal_W = sum.normalized();
  facet.offset_m = facet.normal_W.dot(centroid) / area;
  facet.area_m2 = 0.5 * area;
}

struct Rectangle {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
};

Rectangle rectangle_along(const std::vector<Corners>& triangles, const Facet& plane,
                          const Eigen::Vector3d& direction) {
  Rectangle found;
  const Eigen::Vector3d& n = plane.normal_W;
  found.u = (direction - n.dot(direction) * n).normalized();
  found.v = n.cross(found.u);
  Eigen::Vector2d low = found.size;
  Eigen::Vector2d high = -found.size;
  for (const Corners& abc : triangles) {
    for (const Eigen::Vector3d& p : abc) {
      const Eigen::Vector2d uv(found.u.dot(p), found.v.dot(p));
      low = low.cwiseMin(uv);
      high = high.cwiseMax(uv);
    }
  }
  found.corner = low.x() * found.u + low.y() * found.v + plane.offset_m * n;
  found.size = high - low;
  return found;
}

/// The smallest bounding rectangle along one of the triangles' edges.
void set_rectangle(const std::vector<Corners>& triangles, Facet& facet) {
  Rectangle least;
  for (std::size_t i = 0; i < std::min(triangles.size(), kMaxDirections); ++i) {
    const Corners& abc = triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const Rectangle found = rectangle_along(triangles, facet, abc[(k + 1) % 3] - abc[k]);
      if (found.size.prod() < least.size.prod()) least = found;
    }
  }
  facet.corner_W = least.corner;
  facet.axis_u_W = least.u;
  facet.axis_v_W = least.v;
  facet.size_m = least.size;
  facet.rectangular = facet.area_m2 > (1.0 - kRectangle) * least.size.prod();
}

Facet facet_of(const Grower& grower, const std::vector<std::uint32_t>& region,
               const Pieces& pieces) {
  std::vector<Corners> triangles;
  triangles.reserve(region.size());
  for (const std::uint32_t triangle : region) triangles.push_back(grower.corners(triangle));
  Facet facet;
  facet.shell = pieces.of_triangle[region.front()];
  const Piece& piece = pieces.pieces[facet.shell];
  facet.two_sided = !piece.closed;
  set_plane(triangles, facet);
  set_rectangle(triangles, facet);
  facet.triangles.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    facet.triangles.push_back({in_frame(facet, a), in_frame(facet, b), in_frame(facet, c)});
  }
  if (piece.inverted) {
    facet.normal_W = -facet.normal_W;
    facet.offset_m = -facet.offset_m;
  }
  return facet;
}

}  // namespace

std::vector<Facet> flat_pieces(const WeldedMesh& mesh, const std::vector<Edge>& edges,
                               const Pieces& pieces, const std::vector<char>& mirrors) {
  Grower grower(mesh, edges, pieces, mirrors);
  std::vector<Facet> facets;
  for (const std::vector<std::uint32_t>& region : grower.grow()) {
    facets.push_back(facet_of(grower, region, pieces));
  }
  return facets;
}

Facet endless_facet(const Eigen::Vector3d& normal_W, double offset_m) {
  Facet facet;
  facet.normal_W = normal_W;
  facet.offset_m = offset_m;
  facet.unbounded = true;
  facet.corner_W = offset_m * normal_W;
  facet.axis_u_W = normal_W.unitOrthogonal();
  facet.axis_v_W = normal_W.cross(facet.axis_u_W);
  facet.size_m.setConstant(std::numeric_limits<double>::infinity());
  return facet;
}

}  // namespace tagfield
