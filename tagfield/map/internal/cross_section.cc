// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/internal/cross_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "tagfield/world/world_mesh.h"

namespace tagfield {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Point at height `z` of an edge with one end below `z` and the other not.
Eigen::Vector2d at_height(const Eigen::Vector3d& below, const Eigen::Vector3d& above, double z) {
  const double share = (z - below.z()) / (above.z() - below.z());
  return (below + share * (above - below)).head<2>();
}

std::optional<Segment> cut(const Triangle& triangle, double z) {
  std::array<Eigen::Vector2d, 3> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = triangle.at(i);
    const Eigen::Vector3d& b = triangle.at((i + 1) % 3);
    if ((a.z() < z) == (b.z() < z)) continue;
    // Always from below, so that both triangles of an edge get identical bits.
    ends.at(count++) = a.z() < z ? at_height(a, b, z) : at_height(b, a, z);
  }
  if (count != 2) return std::nullopt;
  return Segment{ends[0], ends[1]};
}

/// The part of a segment inside a square (Liang and Barsky).
std::optional<Segment> clipped(const Segment& segment, const Square& square) {
  const Eigen::Vector2d along = segment.to - segment.from;
  double first = 0.0;
  double last = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = square.centre[axis] - square.half - segment.from[axis];
    const double high = square.centre[axis] + square.half - segment.from[axis];
    if (along[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    first = std::max(first, std::min(low / along[axis], high / along[axis]));
    last = std::min(last, std::max(low / along[axis], high / along[axis]));
  }
  if (!(first <= last)) return std::nullopt;
  // Ends inside the square stay unchanged, bit by bit.
  return Segment{first > 0.0 ? Eigen::Vector2d(segment.from + first * along) : segment.from,
                 last < 1.0 ? Eigen::Vector2d(segment.from + last * along) : segment.to};
}

/// Line in which an inclined plane intersects the height, longer than the square.
std::optional<Segment> cut(const Plane& plane, const RigidTransform& X_WC, double z,
                           const Square& within) {
  const Eigen::Vector3d normal = X_WC.rotation * plane.normal.normalized();
  const Eigen::Vector2d level = normal.head<2>();
  // A slope below 1e-9 is a level floor that was rotated about z.
  if (!(level.norm() > 1e-9)) return std::nullopt;
  const Eigen::Vector3d& p = X_WC.translation;
  const double offset = normal.dot(p) - normal.z() * z - level.dot(within.centre);
  const Eigen::Vector2d nearest = within.centre + offset / level.squaredNorm() * level;
  const Eigen::Vector2d along =
      2.0 * within.half * Eigen::Vector2d(-level.y(), level.x()).normalized();
  return Segment{nearest - along, nearest + along};
}

void add(const std::optional<Segment>& segment, const Square& within,
         std::vector<Segment>& segments) {
  if (!segment) return;
  if (const auto inside = clipped(*segment, within)) segments.push_back(*inside);
}

void add_solid(const Collision& collision, double z, const Square& within,
               std::vector<Segment>& segments) {
  const TriangleMesh mesh = world_mesh(collision);
  for (const auto& [a, b, c] : mesh.triangles) {
    add(cut({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, z), within, segments);
  }
}

}  // namespace

std::vector<Segment> cross_section(const Scene& scene, double z_m, const Square& within) {
  std::vector<Segment> segments;
  for (const Collision& collision : scene.collisions) {
    if (const auto* plane = std::get_if<Plane>(&collision.shape)) {
      add(cut(*plane, collision.X_WC, z_m, within), within, segments);
    } else {
      add_solid(collision, z_m, within, segments);
    }
  }
  return segments;
}

}  // namespace tagfield
