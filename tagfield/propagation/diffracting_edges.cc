// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/propagation/diffraction.h"
#include "tagfield/propagation/internal/creases.h"
#include "tagfield/propagation/internal/on_facet.h"
#include "tagfield/world/world_mesh.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

/// Shorter edges, below about a wavelength, don't diffract waves as in the theory [m].
constexpr double kMinLength = 0.3;
/// Plates up to this thickness, about a tenth of a wavelength, count as sheets [m].
constexpr double kThinPlate = 0.03;
constexpr double kParallel = 0.9999;  ///< Cosine.
/// Distance from the surface at which covering solids are searched for [m],
constexpr double kAbove = 2e-3;
/// and spacing of these samples along an edge [m].
constexpr double kSampling = 0.1;
constexpr std::size_t kMaxSamples = 64;

/// Points of a facet are closer than this to its plane [m].
constexpr double kFlat = 1e-3;

void set_mirrors(const RadioScene& waves, std::uint32_t solid, DiffractingEdge& edge) {
  const Vector3d middle = edge.from_W + 0.5 * edge.length_m * edge.axis_W;
  for (WedgeFace& face : edge.faces) {
    const Vector3d p = middle + kAbove * face.into_W;
    face.mirrors =
        std::any_of(waves.facets().begin(), waves.facets().end(), [&](const Facet& facet) {
          const double same = facet.normal_W.dot(face.normal_W);
          return facet.solid == solid && (facet.two_sided ? std::abs(same) : same) > kParallel &&
                 std::abs(facet.normal_W.dot(p) - facet.offset_m) < kFlat && is_on(facet, p);
        });
  }
}

/// Sets `plate` to one edge midway between the two of a thin plate; false if they aren't such
/// edges.
bool as_plate(const DiffractingEdge& one, const DiffractingEdge& other, DiffractingEdge& plate) {
  const Vector3d across = other.from_W - one.from_W;
  const double thickness = across.norm();
  if (thickness > kThinPlate || one.axis_W.dot(other.axis_W) < kParallel) return false;
  if (std::abs(one.length_m - other.length_m) > 2.0 * thickness) return false;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      const WedgeFace& rim = one.faces[i];
      const WedgeFace& front = one.faces[1 - i];
      const WedgeFace& back = other.faces[1 - j];
      if (rim.normal_W.dot(other.faces[j].normal_W) < kParallel) continue;
      if (rim.into_W.dot(other.faces[j].into_W) > -kParallel) continue;
      if (front.normal_W.dot(back.normal_W) > -kParallel) continue;
      plate = one;
      plate.from_W = 0.5 * (one.from_W + other.from_W);
      plate.length_m = 0.5 * (one.length_m + other.length_m);
      plate.faces[1 - i] = front;
      plate.faces[i] = back;
      plate.exterior_rad = kTwoPi;
      plate.thickness_m = thickness;
      return true;
    }
  }
  return false;
}

/// `edges` are sorted by from_W.x().
std::vector<DiffractingEdge> with_plates(std::vector<DiffractingEdge> edges) {
  std::vector<DiffractingEdge> all;
  std::vector<char> used(edges.size(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (used[i] != 0) continue;
    DiffractingEdge found = edges[i];
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (edges[j].from_W.x() - edges[i].from_W.x() > kThinPlate) break;
      if (used[j] != 0 || !as_plate(edges[i], edges[j], found)) continue;
      used[j] = 1;
      break;
    }
    all.push_back(found);
  }
  return all;
}

/// Whether the space in front of both faces and between them is one region at `p_W`: no other solid
/// covers part of it. (An edge inside another solid, as in a room that is one box, is free too.)
bool is_free(const RadioScene& waves, const DiffractingEdge& edge, const Vector3d& p_W) {
  const double above = kAbove + 0.5 * edge.thickness_m;
  Vector3d out = Vector3d::Zero();
  for (const WedgeFace& face : edge.faces) out += face.normal_W - face.into_W;
  const std::vector<char> around = shells_around(waves, p_W + above * out.normalized());
  return std::all_of(edge.faces.begin(), edge.faces.end(), [&](const WedgeFace& face) {
    const std::vector<char> there =
        shells_around(waves, p_W + kAbove * face.into_W + above * face.normal_W);
    for (std::size_t shell = 0; shell < around.size(); ++shell) {
      const bool is_own = waves.shells()[shell].solid == edge.solid;
      if (!is_own && there[shell] != around[shell]) return false;
    }
    return true;
  });
}

/// Adds the free parts of `edge`, as determined by sampling.
void add_free_parts(const RadioScene& waves, const DiffractingEdge& edge,
                    std::vector<DiffractingEdge>& edges) {
  const auto wanted = static_cast<std::size_t>(std::ceil(edge.length_m / kSampling));
  const std::size_t count = std::clamp(wanted, std::size_t{3}, kMaxSamples);
  const double step = edge.length_m / static_cast<double>(count);
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const Vector3d p = edge.from_W + (static_cast<double>(i) + 0.5) * step * edge.axis_W;
    if (i < count && is_free(waves, edge, p)) continue;
    DiffractingEdge part = edge;
    part.from_W += static_cast<double>(begin) * step * edge.axis_W;
    part.length_m = static_cast<double>(i - begin) * step;
    if (part.length_m >= kMinLength) edges.push_back(part);
    begin = i + 1;
  }
}

}  // namespace

std::vector<DiffractingEdge> diffracting_edges(const Scene& scene, const RadioScene& waves) {
  std::vector<DiffractingEdge> all;
  for (std::uint32_t solid = 0; solid < scene.collisions.size(); ++solid) {
    const Collision& collision = scene.collisions[solid];
    if (std::holds_alternative<Plane>(collision.shape)) continue;
    std::vector<DiffractingEdge> edges = creases(weld(world_mesh(collision)));
    edges.erase(std::remove_if(edges.begin(), edges.end(),
                               [](const auto& edge) { return edge.length_m < kMinLength; }),
                edges.end());
    for (DiffractingEdge& edge : edges) {
      edge.solid = solid;
      set_mirrors(waves, solid, edge);
    }
    for (const DiffractingEdge& edge : with_plates(std::move(edges))) {
      add_free_parts(waves, edge, all);
    }
  }
  return all;
}

}  // namespace tagfield
