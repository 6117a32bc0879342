// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/radio_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/range_check.h"
#include "tagfield/propagation/internal/facet_blocks.h"
#include "tagfield/propagation/internal/flat_pieces.h"
#include "tagfield/propagation/internal/welded_mesh.h"
#include "tagfield/world/triangulate.h"
#include "tagfield/world/world_mesh.h"

namespace tagfield {
namespace {

/// Far above rounding errors [m].
constexpr double kHeight = 1e-6;
/// With more facets, pairs are not tabulated: the table would take more than 16 MB.
constexpr std::size_t kMaxTabulated = 4096;
constexpr char kInFront = 1;
constexpr char kBehind = 2;

/// By triangle of `mesh`, which was made from `collision`: whether it is part of a flat side.
std::vector<char> flat_triangles(const Collision& collision, const WeldedMesh& mesh) {
  const bool sphere = std::holds_alternative<Sphere>(collision.shape);
  std::vector<char> flat(mesh.triangles.size(), sphere ? 0 : 1);
  if (std::holds_alternative<Cylinder>(collision.shape)) {
    // A fan for one cap, twice as many triangles for the side, and a fan for the other cap.
    for (std::size_t i = kCircleEdges; i < 3 * std::size_t{kCircleEdges}; ++i) {
      if (mesh.kept[i] != kNoTriangle) flat[mesh.kept[i]] = 0;
    }
  }
  return flat;
}

Eigen::Vector3d corner(const Facet& facet, int i) {
  return facet.corner_W + (i & 1 ? facet.size_m.x() : 0.0) * facet.axis_u_W +
         (i & 2 ? facet.size_m.y() : 0.0) * facet.axis_v_W;
}

/// On which sides of `plane` the unbounded facet `other` has points.
char sides_of_endless(const Facet& plane, const Facet& other) {
  if (plane.normal_W.cross(other.normal_W).norm() > 1e-9) return kInFront | kBehind;
  const double height = plane.normal_W.dot(other.offset_m * other.normal_W) - plane.offset_m;
  if (std::abs(height) < kHeight) return 0;
  return height > 0.0 ? kInFront : kBehind;
}

/// On which sides of the plane of `plane` facet `other` has points.
char sides(const Facet& plane, const Facet& other) {
  if (other.unbounded) return sides_of_endless(plane, other);
  char found = 0;
  for (int i = 0; i < 4; ++i) {
    const double height = plane.normal_W.dot(corner(other, i)) - plane.offset_m;
    if (height > kHeight) found |= kInFront;
    if (height < -kHeight) found |= kBehind;
  }
  return found;
}

std::vector<char> table_of_sides(const std::vector<Facet>& facets) {
  std::vector<char> table;
  if (facets.size() > kMaxTabulated) return table;
  table.reserve(facets.size() * facets.size());
  for (const Facet& plane : facets) {
    for (const Facet& other : facets) table.push_back(sides(plane, other));
  }
  return table;
}

std::vector<char> checked(const RadioSceneOptions& options, std::size_t collisions) {
  require(options.min_facet_m2 >= 0.0, "min_facet_m2", "at least 0", options.min_facet_m2);
  if (options.opaque.empty()) return std::vector<char>(collisions, 0);
  if (options.opaque.size() != collisions) {
    throw Error(fmt::format("opaque must be empty or say it of each of {} collisions, has {}",
                            collisions, options.opaque.size()));
  }
  return options.opaque;
}

}  // namespace

RadioScene::RadioScene(const Scene& scene, const RadioSceneOptions& options)
    : rays_(scene), opaque_(checked(options, scene.collisions.size())) {
  for (std::uint32_t solid = 0; solid < scene.collisions.size(); ++solid) {
    first_triangles_.push_back(triangle_shells_.size());
    const Collision& collision = scene.collisions[solid];
    if (std::holds_alternative<Plane>(collision.shape)) {
      add_plane(collision, solid);
    } else {
      add_solid(collision, solid, options.min_facet_m2);
    }
  }
  facet_blocks_ = tagfield::facet_blocks(facets_);
  sides_ = table_of_sides(facets_);
}

void RadioScene::add_plane(const Collision& collision, std::uint32_t solid) {
  const Eigen::Vector3d normal =
      collision.X_WC.rotation * std::get<Plane>(collision.shape).normal.normalized();
  Facet facet = endless_facet(normal, normal.dot(collision.X_WC.translation));
  facet.solid = solid;
  facet.shell = static_cast<std::uint32_t>(shells_.size());
  triangle_shells_.push_back(facet.shell);
  shells_.push_back({solid, true, false});
  facets_.push_back(std::move(facet));
}

void RadioScene::add_solid(const Collision& collision, std::uint32_t solid, double min_m2) {
  const WeldedMesh mesh = weld(world_mesh(collision));
  const std::vector<Edge> edges = sorted_edges(mesh);
  const Pieces pieces = find_pieces(mesh, edges);
  const auto first_shell = static_cast<std::uint32_t>(shells_.size());
  for (const Piece& piece : pieces.pieces) {
    shells_.push_back({solid, piece.closed, piece.inverted});
  }
  // Degenerate triangles, which no ray hits, form an open shell of their own.
  const auto flat_shell = static_cast<std::uint32_t>(shells_.size());
  shells_.push_back({solid, false, false});
  for (const std::uint32_t kept : mesh.kept) {
    triangle_shells_.push_back(kept == kNoTriangle ? flat_shell
                                                   : first_shell + pieces.of_triangle[kept]);
  }
  for (Facet& facet : flat_pieces(mesh, edges, pieces, flat_triangles(collision, mesh))) {
    if (facet.area_m2 < min_m2) {
      ++left_out_.count;
      left_out_.area_m2 += facet.area_m2;
      continue;
    }
    facet.solid = solid;
    facet.shell += first_shell;
    facets_.push_back(std::move(facet));
  }
}

bool RadioScene::reaches(std::size_t from, bool front, std::size_t to) const {
  const char there =
      sides_.empty() ? sides(facets_[from], facets_[to]) : sides_[from * facets_.size() + to];
  return (there & (front ? kInFront : kBehind)) != 0;
}

}  // namespace tagfield
