// SPDX-License-Identifier: Apache-2.0
/// @file
/// A solid's triangles with coincident vertices merged.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

inline constexpr std::uint32_t kNoTriangle = ~0U;

/// Triangles without those of which two corners coincide, and each only once whatever the order of
/// its corners.
struct WeldedMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// By triangle of the original mesh: its index here, or kNoTriangle.
  std::vector<std::uint32_t> kept;
};

/// Merges vertices within one cell of 10 µm, as exporters write separate ones for each triangle.
WeldedMesh weld(const TriangleMesh& mesh);

/// A triangle's side; `forward` if it goes from `low` to `high`.
struct Edge {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  bool forward = false;
};

/// All triangles' sides, sorted by (low, high).
std::vector<Edge> sorted_edges(const WeldedMesh& mesh);

/// Calls `body(begin, end)` for each run of edges with the same ends.
template <class Body>
void for_each_run(const std::vector<Edge>& edges, const Body& body) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    body(&edges[i], &edges[i] + (j - i));
    i = j;
  }
}

/// Triangles that are connected by edges.
struct Piece {
  /// Each edge has as many triangles on one side as on the other, and the piece encloses a volume.
  bool closed = false;
  bool inverted = false;  ///< Closed, with its normals pointing inwards.
};

struct Pieces {
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> of_triangle;
};

Pieces find_pieces(const WeldedMesh& mesh, const std::vector<Edge>& edges);

}  // namespace tagfield
