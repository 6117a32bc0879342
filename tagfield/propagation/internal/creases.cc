// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/creases.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Surfaces that are bent by less count as round [rad].
constexpr double kMinBend = radians(40.0);
/// A vertex this close to a side lies on it [m].
constexpr double kOnSide = 2e-5;
constexpr double kSamePath = 1.0 - 1e-6;  ///< Minimum cosine between segments of one line.
constexpr double kSameFace = 0.999;       ///< Same for faces; normals of small triangles are noisy.

using Eigen::Vector3d;

/// A part of an edge between two vertices.
struct Segment {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  DiffractingEdge edge;
};

Vector3d normal_of(const WeldedMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vector3d& p = mesh.vertices[a];
  return (mesh.vertices[b] - p).cross(mesh.vertices[c] - p).normalized();
}

/// Cuts the sides that belong to a single triangle at the vertices that lie on them. Such sides are
/// borders of sheets, or have T-junctions with adjacent triangles.
class SideCutter {
 public:
  explicit SideCutter(const WeldedMesh& mesh) : mesh_(mesh), by_x_(mesh.vertices.size()) {
    std::iota(by_x_.begin(), by_x_.end(), 0U);
    std::sort(by_x_.begin(), by_x_.end(), [&](std::uint32_t i, std::uint32_t j) {
      return mesh_.vertices[i].x() < mesh_.vertices[j].x();
    });
  }

  std::vector<Edge> cut(const std::vector<Edge>& edges) {
    std::vector<Edge> all;
    for_each_run(edges, [&](const Edge* begin, const Edge* end) {
      if (end - begin == 1) {
        add_parts(*begin, all);
      } else {
        all.insert(all.end(), begin, end);
      }
    });
    std::sort(all.begin(), all.end(), [](const Edge& one, const Edge& other) {
      return std::tie(one.low, one.high, one.triangle) <
             std::tie(other.low, other.high, other.triangle);
    });
    return all;
  }

 private:
  void add_parts(const Edge& side, std::vector<Edge>& all) {
    const Vector3d& a = mesh_.vertices[side.low];
    const Vector3d along = mesh_.vertices[side.high] - a;
    const double length = along.norm();
    std::vector<std::pair<double, std::uint32_t>> on = {{0.0, side.low}, {length, side.high}};
    const double least = a.x() + std::min(0.0, along.x()) - kOnSide;
    const double most = a.x() + std::max(0.0, along.x()) + kOnSide;
    auto i = std::lower_bound(by_x_.begin(), by_x_.end(), least,
                              [&](std::uint32_t v, double x) { return mesh_.vertices[v].x() < x; });
    for (; i != by_x_.end() && mesh_.vertices[*i].x() <= most; ++i) {
      const Vector3d to = mesh_.vertices[*i] - a;
      const double s = to.dot(along) / length;
      if (s < kOnSide || s > length - kOnSide) continue;
      if ((to - s / length * along).norm() < kOnSide) on.emplace_back(s, *i);
    }
    std::sort(on.begin(), on.end());
    for (std::size_t k = 0; k + 1 < on.size(); ++k) {
      const auto [low, high] = std::minmax(on[k].second, on[k + 1].second);
      all.push_back({low, high, side.triangle, side.forward == (on[k].second == low)});
    }
  }

  const WeldedMesh& mesh_;
  std::vector<std::uint32_t> by_x_;
};

/// The wedge face that a triangle forms at its side `edge`, whose unit vector is `axis`.
WedgeFace face_of(const WeldedMesh& mesh, const Edge& edge, const Vector3d& axis) {
  WedgeFace face;
  face.normal_W = normal_of(mesh, edge.triangle);
  face.into_W = face.normal_W.cross(edge.forward ? axis : Vector3d(-axis));
  return face;
}

/// The border of a sheet: both of its sides are faces.
DiffractingEdge border(const WedgeFace& face) {
  DiffractingEdge edge;
  edge.faces = {face, {face.into_W, -face.normal_W, false}};
  edge.exterior_rad = kTwoPi;
  edge.is_sheet = true;
  return edge;
}

/// The edge between two faces; for a sheet, on its convex side.
std::optional<DiffractingEdge> bend(WedgeFace one, WedgeFace other, bool closed) {
  DiffractingEdge edge;
  edge.is_sheet = !closed;
  if (!closed && one.normal_W.dot(other.into_W) > 0.0) one.normal_W = -one.normal_W;
  if (!closed && other.normal_W.dot(one.into_W) > 0.0) other.normal_W = -other.normal_W;
  if (one.normal_W.dot(other.into_W) >= 0.0) return std::nullopt;  // Concave.
  const double by = std::acos(std::clamp(one.normal_W.dot(other.normal_W), -1.0, 1.0));
  if (by < kMinBend) return std::nullopt;
  edge.faces = {one, other};
  edge.exterior_rad = kPi + by;
  return edge;
}

bool is_before(const Vector3d& a, const Vector3d& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// Whether this is the canonical one of a line's two directions: the first coordinate that changes,
/// apart from rounding errors, increases.
bool goes_forward(const Vector3d& way) {
  constexpr double kRounding = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(way[axis]) > kRounding * way.norm()) return way[axis] > 0.0;
  }
  return true;
}

/// Starts the edge at the end that comes first, and orders the faces by the right-hand rule.
void set_line(const Vector3d& a, const Vector3d& b, DiffractingEdge& edge) {
  const bool forward = goes_forward(b - a);
  edge.from_W = forward ? a : b;
  edge.axis_W = (forward ? b - a : a - b).normalized();
  edge.length_m = (b - a).norm();
  const WedgeFace& first = edge.faces[0];
  if (first.into_W.cross(first.normal_W).dot(edge.axis_W) < 0.0) {
    std::swap(edge.faces[0], edge.faces[1]);
  }
}

std::vector<Segment> segments_of(const WeldedMesh& mesh) {
  const std::vector<Edge> edges = SideCutter(mesh).cut(sorted_edges(mesh));
  const Pieces pieces = find_pieces(mesh, edges);
  std::vector<Segment> segments;
  for_each_run(edges, [&](const Edge* begin, const Edge* end) {
    if (end - begin > 2) return;
    const Vector3d& a = mesh.vertices[begin->low];
    const Vector3d& b = mesh.vertices[begin->high];
    const Vector3d axis = (b - a).normalized();
    WedgeFace face = face_of(mesh, *begin, axis);
    const Piece& piece = pieces.pieces[pieces.of_triangle[begin->triangle]];
    if (piece.inverted) face.normal_W = -face.normal_W;
    std::optional<DiffractingEdge> edge;
    if (end - begin == 1) {
      edge = border(face);
    } else {
      WedgeFace other = face_of(mesh, *(begin + 1), axis);
      if (piece.inverted) other.normal_W = -other.normal_W;
      edge = bend(face, other, piece.closed);
    }
    if (!edge) return;
    set_line(a, b, *edge);
    segments.push_back({begin->low, begin->high, *edge});
  });
  return segments;
}

bool is_one_line(const DiffractingEdge& one, const DiffractingEdge& other) {
  if (one.axis_W.dot(other.axis_W) < kSamePath || one.is_sheet != other.is_sheet) return false;
  for (std::size_t i = 0; i < 2; ++i) {
    if (one.faces[i].normal_W.dot(other.faces[i].normal_W) < kSameFace) return false;
    if (one.faces[i].into_W.dot(other.faces[i].into_W) < kSameFace) return false;
  }
  return true;
}

std::size_t welded_root(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

/// Segments that continue each other get the same welded_root().
std::vector<std::size_t> joined(const std::vector<Segment>& segments) {
  std::vector<std::pair<std::uint32_t, std::size_t>> at;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    at.emplace_back(segments[i].low, i);
    at.emplace_back(segments[i].high, i);
  }
  std::sort(at.begin(), at.end());
  std::vector<std::size_t> parents(segments.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = i + 1; j < at.size() && at[j].first == at[i].first; ++j) {
      if (is_one_line(segments[at[i].second].edge, segments[at[j].second].edge)) {
        parents[welded_root(parents, at[j].second)] = welded_root(parents, at[i].second);
      }
    }
  }
  return parents;
}

Vector3d end_of(const DiffractingEdge& edge) { return edge.from_W + edge.length_m * edge.axis_W; }

/// Extends `edge` to include `part`, which is on the same line.
void grow(const DiffractingEdge& part, DiffractingEdge& edge) {
  const bool begins = goes_forward(edge.from_W - part.from_W) && part.from_W != edge.from_W;
  const bool ends = goes_forward(end_of(part) - end_of(edge)) && end_of(part) != end_of(edge);
  set_line(begins ? part.from_W : edge.from_W, ends ? end_of(part) : end_of(edge), edge);
}

}  // namespace

std::vector<DiffractingEdge> creases(const WeldedMesh& mesh) {
  const std::vector<Segment> segments = segments_of(mesh);
  std::vector<std::size_t> parents = joined(segments);
  std::vector<DiffractingEdge> whole(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    DiffractingEdge& edge = whole[welded_root(parents, i)];
    if (edge.length_m > 0.0) {
      grow(segments[i].edge, edge);
    } else {
      edge = segments[i].edge;
    }
  }
  whole.erase(std::remove_if(whole.begin(), whole.end(),
                             [](const DiffractingEdge& edge) { return !(edge.length_m > 0.0); }),
              whole.end());
  std::sort(whole.begin(), whole.end(), [](const DiffractingEdge& a, const DiffractingEdge& b) {
    return a.from_W == b.from_W ? is_before(end_of(a), end_of(b)) : is_before(a.from_W, b.from_W);
  });
  return whole;
}

}  // namespace tagfield
