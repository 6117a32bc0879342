// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/top_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <polyclipping/clipper.hpp>

#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;
using Points = std::vector<Eigen::Vector3d>;

/// Clipper uses integers; one unit is 0.1 mm.
constexpr double kUnitsPerMetre = 1e4;
/// Larger coordinates [m] are meaningless in a drawing and would overflow in Clipper.
constexpr double kMaxCoordinate = 1e7;

/// The part of a convex polygon where side * (z - height) >= 0 (Sutherland and Hodgman's step).
Points keep_side(const Points& polygon, double height, double side) {
  Points kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& here = polygon[i];
    const Eigen::Vector3d& next = polygon[(i + 1) % polygon.size()];
    const double depth_here = side * (here.z() - height);
    const double depth_next = side * (next.z() - height);
    if (depth_here >= 0.0) kept.push_back(here);
    if (depth_here * depth_next < 0.0) {
      kept.emplace_back(here + (next - here) * (depth_here / (depth_here - depth_next)));
    }
  }
  return kept;
}

IntPoint to_clipper(const Eigen::Vector2d& p) {
  if (!(p.cwiseAbs().maxCoeff() <= kMaxCoordinate)) throw Error("too far away to draw from above");
  return {std::llround(p.x() * kUnitsPerMetre), std::llround(p.y() * kUnitsPerMetre)};
}

/// Twice the area of the triangle a, b, c; positive if it turns left.
ClipperLib::cInt turn(const IntPoint& a, const IntPoint& b, const IntPoint& c) {
  return (b.X - a.X) * (c.Y - a.Y) - (b.Y - a.Y) * (c.X - a.X);
}

bool before(const IntPoint& a, const IntPoint& b) { return a.X != b.X ? a.X < b.X : a.Y < b.Y; }

/// One chain of a convex hull, from the first of `points` to the last (Andrew's algorithm).
template <typename Iterator>
Path hull_chain(Iterator begin, Iterator end) {
  Path chain;
  for (; begin != end; ++begin) {
    while (chain.size() >= 2 && turn(chain[chain.size() - 2], chain.back(), *begin) <= 0) {
      chain.pop_back();
    }
    chain.push_back(*begin);
  }
  return chain;
}

/// Anticlockwise.
Path convex_hull(Path points) {
  std::sort(points.begin(), points.end(), before);
  Path lower = hull_chain(points.begin(), points.end());
  Path upper = hull_chain(points.rbegin(), points.rend());
  lower.pop_back();
  upper.pop_back();
  lower.insert(lower.end(), upper.begin(), upper.end());
  return lower;
}

/// A convex polygon seen from above, with a square of ± `margin` around each of its points.
Path thick_outline(const Points& polygon, double margin) {
  Path corners;
  for (const Eigen::Vector3d& p : polygon) {
    for (const double dx : {-margin, margin}) {
      for (const double dy : {-margin, margin}) {
        corners.push_back(to_clipper({p.x() + dx, p.y() + dy}));
      }
    }
  }
  return convex_hull(std::move(corners));
}

Paths united(const Paths& paths) {
  ClipperLib::Clipper clipper;
  Paths result;
  if (!clipper.AddPaths(paths, ClipperLib::ptSubject, true)) return result;  // None has an area.
  // Clipper catches all internal exceptions, which are out-of-memory errors, and returns false.
  if (!clipper.Execute(ClipperLib::ctUnion, result, ClipperLib::pftNonZero,
                       ClipperLib::pftNonZero)) {
    throw std::bad_alloc();
  }
  return result;
}

/// Union by halves: inner edges vanish early, which on a fine mesh is far faster than a single
/// union.
Paths united_by_halves(const Paths& paths, std::size_t begin, std::size_t end) {
  const auto at = [&paths](std::size_t i) {
    return paths.begin() + static_cast<std::ptrdiff_t>(i);
  };
  if (end - begin <= 16) return united(Paths(at(begin), at(end)));
  const std::size_t middle = begin + (end - begin) / 2;
  Paths halves = united_by_halves(paths, begin, middle);
  const Paths second = united_by_halves(paths, middle, end);
  halves.insert(halves.end(), second.begin(), second.end());
  return united(halves);
}

Polygon to_polygon(const Path& path) {
  Polygon polygon;
  polygon.reserve(path.size());
  for (const IntPoint& p : path) {
    polygon.emplace_back(static_cast<double>(p.X) / kUnitsPerMetre,
                         static_cast<double>(p.Y) / kUnitsPerMetre);
  }
  return polygon;
}

/// Range of heights to draw [m], and margin around everything [m].
struct Band {
  double low;
  double high;
  double margin;
};

/// The outlines of a mesh's triangles within the band, and the heights that they span.
struct Outlines {
  Paths paths;
  Eigen::AlignedBox1d heights;
};

Outlines outlines_of(const TriangleMesh& mesh, const RigidTransform& X_WC, const Band& band) {
  Points vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& p_C : mesh.vertices) vertices.emplace_back(X_WC * p_C);
  Outlines outlines;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Points above = keep_side({vertices[a], vertices[b], vertices[c]}, band.low, 1.0);
    const Points inside = keep_side(above, band.high, -1.0);
    if (inside.empty()) continue;
    for (const Eigen::Vector3d& p : inside)
      outlines.heights.extend(Eigen::Matrix<double, 1, 1>(p.z()));
    outlines.paths.push_back(thick_outline(inside, band.margin));
  }
  return outlines;
}

std::optional<Silhouette> silhouette_of(const Collision& collision, const Band& band) {
  if (std::holds_alternative<Plane>(collision.shape)) return std::nullopt;
  const Outlines outlines = outlines_of(triangulate(collision.shape), collision.X_WC, band);
  if (outlines.paths.empty()) return std::nullopt;
  Silhouette silhouette{collision.name, outlines.heights.min().x(), outlines.heights.max().x(), {}};
  for (const Path& path : united_by_halves(outlines.paths, 0, outlines.paths.size())) {
    silhouette.rings.push_back(to_polygon(path));
  }
  return silhouette;
}

nlohmann::json to_json(const Polygon& ring) {
  nlohmann::json points = nlohmann::json::array();
  for (const Eigen::Vector2d& p : ring) points.push_back({p.x(), p.y()});
  return points;
}

nlohmann::json to_json(const Silhouette& silhouette) {
  nlohmann::json rings = nlohmann::json::array();
  for (const Polygon& ring : silhouette.rings) rings.push_back(to_json(ring));
  return {{"name", silhouette.name},
          {"z_min", silhouette.z_min},
          {"z_max", silhouette.z_max},
          {"rings", rings}};
}

Polygon ring_from_json(const nlohmann::json& points) {
  Polygon ring;
  for (const auto& point : points.get<std::vector<std::vector<double>>>()) {
    if (point.size() != 2) throw Error("top view is not the JSON expected: a point is not [x, y]");
    ring.emplace_back(point[0], point[1]);
  }
  return ring;
}

Silhouette silhouette_from_json(const nlohmann::json& object) {
  Silhouette silhouette;
  silhouette.name = object.at("name").get<std::string>();
  silhouette.z_min = object.at("z_min").get<double>();
  silhouette.z_max = object.at("z_max").get<double>();
  for (const nlohmann::json& ring : object.at("rings").get<std::vector<nlohmann::json>>()) {
    silhouette.rings.push_back(ring_from_json(ring));
  }
  return silhouette;
}

}  // namespace

std::vector<Silhouette> top_view(const Scene& scene, double z_low, double z_high, double margin) {
  std::vector<Silhouette> silhouettes;
  for (const Collision& collision : scene.collisions) {
    const auto silhouette = silhouette_of(collision, {z_low, z_high, margin});
    if (silhouette) silhouettes.push_back(*silhouette);
  }
  std::stable_sort(silhouettes.begin(), silhouettes.end(),
                   [](const auto& a, const auto& b) { return a.z_max < b.z_max; });
  return silhouettes;
}

std::string top_view_to_json(const std::vector<Silhouette>& silhouettes) {
  nlohmann::json list = nlohmann::json::array();
  for (const Silhouette& silhouette : silhouettes) list.push_back(to_json(silhouette));
  // A name from a user's file may contain bytes that are not UTF-8.
  return list.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<Silhouette> top_view_from_json(const std::string& text) {
  constexpr int kMaxLevels = 20;
  try {
    const nlohmann::json list = nlohmann::json::parse(text, [](int levels, auto, const auto&) {
      if (levels > kMaxLevels) throw Error("top view is not the JSON expected: too deep a nest");
      return true;
    });
    if (!list.is_array()) throw Error("top view is not the JSON expected: no list");
    std::vector<Silhouette> silhouettes;
    for (const nlohmann::json& object : list) {
      silhouettes.push_back(silhouette_from_json(object));
    }
    return silhouettes;
  } catch (const nlohmann::json::exception& exception) {
    throw Error("top view is not the JSON expected: " + std::string(exception.what()));
  }
}

}  // namespace tagfield
