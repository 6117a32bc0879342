// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/internal/revolution.h"

#include <cmath>
#include <cstdint>

#include "tagfield/base/units.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

constexpr std::uint32_t kEdges = kCircleEdges;

void add_circle(TriangleMesh& mesh, const Ring& ring) {
  for (std::uint32_t edge = 0; edge < kEdges; ++edge) {
    const double angle = kTwoPi * edge / kEdges;
    mesh.vertices.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle),
                               ring.z);
  }
}

/// The wall between two circles of vertices that start at `lower` and `upper`, facing outward.
void add_wall(TriangleMesh& mesh, std::uint32_t lower, std::uint32_t upper) {
  for (std::uint32_t edge = 0; edge < kEdges; ++edge) {
    const std::uint32_t next = (edge + 1) % kEdges;
    mesh.triangles.push_back({lower + edge, lower + next, upper + next});
    mesh.triangles.push_back({lower + edge, upper + next, upper + edge});
  }
}

/// A fan from `apex` to a circle of vertices, facing up or down.
void add_fan(TriangleMesh& mesh, std::uint32_t apex, std::uint32_t circle, bool from_above) {
  for (std::uint32_t edge = 0; edge < kEdges; ++edge) {
    const std::uint32_t first = circle + edge;
    const std::uint32_t second = circle + (edge + 1) % kEdges;
    if (from_above) {
      mesh.triangles.push_back({apex, first, second});
    } else {
      mesh.triangles.push_back({apex, second, first});
    }
  }
}

}  // namespace

TriangleMesh solid_of_revolution(double bottom, double top, const std::vector<Ring>& rings) {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, bottom}, {0.0, 0.0, top}};
  for (const Ring& ring : rings) add_circle(mesh, ring);
  std::uint32_t circle = 2;
  add_fan(mesh, 0, circle, false);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    add_wall(mesh, circle, circle + kEdges);
    circle += kEdges;
  }
  add_fan(mesh, 1, circle, true);
  return mesh;
}

std::vector<Ring> sphere_rings(double radius) {
  constexpr int kBands = kCircleEdges / 2;
  std::vector<Ring> rings;
  for (int band = 1; band < kBands; ++band) {
    const double polar = kPi * band / kBands;
    rings.push_back({radius * std::sin(polar), -radius * std::cos(polar)});
  }
  return rings;
}

}  // namespace tagfield
