// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/welded_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace tagfield {
namespace {

constexpr double kCell = 1e-5;  // [m]
/// Closed surfaces are thicker than this on average; thinner ones are sheets with two faces [m].
constexpr double kMinThickness = 1e-5;

using Cell = std::array<std::int64_t, 3>;

Cell cell_of(const Eigen::Vector3d& p) {
  return {std::llround(p.x() / kCell), std::llround(p.y() / kCell), std::llround(p.z() / kCell)};
}

/// For each vertex, the index of the one that represents it in `welded`.
std::vector<std::uint32_t> weld_vertices(const TriangleMesh& mesh, WeldedMesh& welded) {
  std::map<Cell, std::uint32_t> at;
  std::vector<std::uint32_t> one(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(welded.vertices.size());
    const auto [place, is_new] = at.emplace(cell_of(mesh.vertices[i]), next);
    if (is_new) welded.vertices.push_back(mesh.vertices[i]);
    one[i] = place->second;
  }
  return one;
}

std::uint32_t root(std::vector<std::uint32_t>& parents, std::uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

/// Twice the area of the triangles, and six times the signed volume between them and the first
/// vertex.
struct Bulk {
  double area = 0.0;
  double volume = 0.0;
};

void add(const WeldedMesh& mesh, const std::array<std::uint32_t, 3>& triangle, Bulk& bulk) {
  const Eigen::Vector3d& origin = mesh.vertices.front();
  const Eigen::Vector3d a = mesh.vertices[triangle[0]] - origin;
  const Eigen::Vector3d b = mesh.vertices[triangle[1]] - origin;
  const Eigen::Vector3d c = mesh.vertices[triangle[2]] - origin;
  bulk.area += (b - a).cross(c - a).norm();
  bulk.volume += a.dot(b.cross(c));
}

/// Numbers the sets of a union-find from 0, in order of their first triangle.
std::vector<std::uint32_t> numbered(std::vector<std::uint32_t>& parents, std::size_t& count) {
  std::vector<std::uint32_t> number_of_root(parents.size(), kNoTriangle);
  std::vector<std::uint32_t> numbers(parents.size());
  count = 0;
  for (std::uint32_t i = 0; i < parents.size(); ++i) {
    std::uint32_t& number = number_of_root[root(parents, i)];
    if (number == kNoTriangle) number = static_cast<std::uint32_t>(count++);
    numbers[i] = number;
  }
  return numbers;
}

}  // namespace

WeldedMesh weld(const TriangleMesh& mesh) {
  WeldedMesh welded;
  const std::vector<std::uint32_t> one = weld_vertices(mesh, welded);
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<std::uint32_t, 3> triangle{one[a], one[b], one[c]};
    std::array<std::uint32_t, 3> corners = triangle;
    std::sort(corners.begin(), corners.end());
    if (corners[0] == corners[1] || corners[1] == corners[2]) {
      welded.kept.push_back(kNoTriangle);
      continue;
    }
    const auto next = static_cast<std::uint32_t>(welded.triangles.size());
    const auto [place, is_new] = known.emplace(corners, next);
    if (is_new) welded.triangles.push_back(triangle);
    welded.kept.push_back(place->second);
  }
  return welded;
}

std::vector<Edge> sorted_edges(const WeldedMesh& mesh) {
  std::vector<Edge> edges;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.triangles[i][k];
      const std::uint32_t to = mesh.triangles[i][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), i, from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& one, const Edge& other) {
    return std::tie(one.low, one.high, one.triangle) <
           std::tie(other.low, other.high, other.triangle);
  });
  return edges;
}

Pieces find_pieces(const WeldedMesh& mesh, const std::vector<Edge>& edges) {
  std::vector<std::uint32_t> parents(mesh.triangles.size());
  std::iota(parents.begin(), parents.end(), 0U);
  for_each_run(edges, [&](const Edge* begin, const Edge* end) {
    for (const Edge* edge = begin + 1; edge != end; ++edge) {
      parents[root(parents, edge->triangle)] = root(parents, begin->triangle);
    }
  });
  std::size_t count = 0;
  Pieces pieces;
  pieces.of_triangle = numbered(parents, count);
  pieces.pieces.assign(count, {true, false});
  for_each_run(edges, [&](const Edge* begin, const Edge* end) {
    const auto forward = std::count_if(begin, end, [](const Edge& edge) { return edge.forward; });
    if (2 * forward != end - begin) pieces.pieces[pieces.of_triangle[begin->triangle]] = {};
  });
  std::vector<Bulk> bulks(count);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    add(mesh, mesh.triangles[i], bulks[pieces.of_triangle[i]]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    // Volume / (half the area) is a slab's thickness.
    if (!(std::abs(bulks[i].volume) / 6.0 > kMinThickness * bulks[i].area / 4.0)) {
      pieces.pieces[i].closed = false;
    }
    pieces.pieces[i].inverted = pieces.pieces[i].closed && bulks[i].volume < 0.0;
  }
  return pieces;
}

}  // namespace tagfield
