// SPDX-License-Identifier: Apache-2.0
/// @file
/// A solid's triangles with the vertices that share a place made one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tagfield/world/scene.h"

namespace tagfield {

inline constexpr std::uint32_t kNoTriangle = ~0U;

/// Triangles without those that are no more than a line, and each only once however its corners
/// are ordered.
struct WeldedMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// By triangle of the mesh that it was made of: its index here, or kNoTriangle.
  std::vector<std::uint32_t> kept;
};

/// Vertices within one cell of 10 µm become one, as exporters write one for each triangle.
WeldedMesh weld(const TriangleMesh& mesh);

/// A triangle's side; `forward` if it goes from `low` to `high`.
struct Edge {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  bool forward = false;
};

/// All triangles' sides by (low, high).
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

/// Triangles that hang together by edges.
struct Piece {
  /// Each edge has as many triangles to one side as to the other, and there is room inside.
  bool closed = false;
  bool inverted = false;  ///< Closed, with its normals pointing inwards.
};

struct Pieces {
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> of_triangle;
};

Pieces find_pieces(const WeldedMesh& mesh, const std::vector<Edge>& edges);

}  // namespace tagfield
