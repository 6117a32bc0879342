// SPDX-License-Identifier: Apache-2.0
// Line of sight against every triangle of a world.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

#include "tagfield/propagation/test/brute_force.h"
#include "tagfield/propagation/trace_paths.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {
namespace {

constexpr double kNear = 1e-6;  // [m]

enum class Verdict { kFree, kBlocked, kTooNear };

/// Distance from `p` to the line through two corners.
double to_edge(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (p - a).cross(b - a).norm() / (b - a).norm();
}

/// Whether one triangle blocks the segment: kTooNear if the segment passes within kNear of the
/// triangle's boundary, or ends near its surface.
Verdict verdict_on(const TestTriangle& triangle, const Eigen::Vector3d& from,
                   const Eigen::Vector3d& to) {
  const auto& [a, b, c] = triangle.p;
  const double length = (to - from).norm();
  const Eigen::Vector3d direction = (to - from) / length;
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  const double t = normal.dot(a - from) / normal.dot(direction);
  if (!(t > -1e-3 && t < length + 1e-3)) return Verdict::kFree;
  const auto hit = moeller_trumbore(from, direction, triangle);
  const double end = std::min(std::abs(normal.dot(from - a)), std::abs(normal.dot(to - a)));
  if (hit && end < 2e-5) return Verdict::kTooNear;
  const Eigen::Vector3d p = from + t * direction;
  const double slope = std::abs(normal.dot(direction));
  // Measured perpendicular to the line, not in the triangle's plane.
  const double rim = slope * std::min({to_edge(p, a, b), to_edge(p, b, c), to_edge(p, c, a)});
  const double size = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
  if (rim < kNear && (p - (a + b + c) / 3.0).norm() < size + kNear / slope) {
    return Verdict::kTooNear;
  }
  return hit && *hit > 0.0 && *hit < length ? Verdict::kBlocked : Verdict::kFree;
}

Verdict verdict(const Scene& scene, const std::vector<TestTriangle>& triangles,
                const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  bool blocked = false;
  for (const TestTriangle& triangle : triangles) {
    const Verdict one = verdict_on(triangle, from, to);
    if (one == Verdict::kTooNear) return one;
    blocked = blocked || one == Verdict::kBlocked;
  }
  for (const Collision& collision : scene.collisions) {
    const auto* plane = std::get_if<Plane>(&collision.shape);
    if (plane == nullptr) continue;
    const Eigen::Vector3d normal = collision.X_WC.rotation * plane->normal;
    const double of_from = normal.dot(from - collision.X_WC.translation);
    const double of_to = normal.dot(to - collision.X_WC.translation);
    blocked = blocked || of_from * of_to < 0.0;
  }
  return blocked ? Verdict::kBlocked : Verdict::kFree;
}

void compare(const std::string& world) {
  Diagnostics diagnostics;
  const Scene scene = load_world(world, {}, diagnostics);
  RadioSceneOptions opaque;
  opaque.opaque.assign(scene.collisions.size(), 1);
  const RadioScene radio(scene, opaque);
  const std::vector<TestTriangle> triangles = all_triangles(scene);
  TraceOptions options;
  options.mount_depth_m = 0.0;
  const ImageSet none{{}, {}, {}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> across(-7.0, 7.0);
  std::uniform_real_distribution<double> up(-0.1, 3.0);
  std::array<int, 3> counts{};
  std::vector<RadioPath> paths;
  for (int i = 0; i < 10'000; ++i) {
    const Eigen::Vector3d a(across(random), across(random), up(random));
    const Eigen::Vector3d t(across(random), across(random), up(random));
    const Verdict expected = verdict(scene, triangles, a, t);
    ++counts.at(static_cast<std::size_t>(expected));
    if (expected == Verdict::kTooNear) continue;
    trace_paths(radio, images_of(radio, a, options), t, options, paths);
    EXPECT_EQ(paths.size(), expected == Verdict::kFree ? 1U : 0U) << i;
    EXPECT_EQ(is_unobstructed(radio, a, t, options), expected == Verdict::kFree) << i;
  }
  std::printf("%zu triangles: %d pairs free, %d blocked, %d within 1e-6 m of an edge\n",
              triangles.size(), counts[0], counts[1], counts[2]);
  EXPECT_GT(counts[0], 500);
  EXPECT_GT(counts[1], 500);
  EXPECT_LT(counts[2], 100);
}

/// The reflection point on one triangle, if there is one.
std::optional<Eigen::Vector3d> bounce_on(const TestTriangle& mirror, const Eigen::Vector3d& a,
                                         const Eigen::Vector3d& t) {
  const Eigen::Vector3d normal =
      (mirror.p[1] - mirror.p[0]).cross(mirror.p[2] - mirror.p[0]).normalized();
  const double of_a = normal.dot(a - mirror.p[0]);
  if (of_a * normal.dot(t - mirror.p[0]) < 1e-9) return std::nullopt;
  const Eigen::Vector3d direction = t - (a - 2.0 * of_a * normal);
  const auto part = moeller_trumbore(t - direction, direction, mirror);
  if (!part) return std::nullopt;
  return Eigen::Vector3d(t - direction + *part * direction);
}

/// All unobstructed bounces, each once where triangles are flush or share an edge.
std::vector<Eigen::Vector3d> all_bounces(const std::vector<TestTriangle>& triangles,
                                         const Eigen::Vector3d& a, const Eigen::Vector3d& t) {
  std::vector<Eigen::Vector3d> found;
  for (const TestTriangle& mirror : triangles) {
    const auto p = bounce_on(mirror, a, t);
    if (!p || is_blocked(triangles, a, *p, 1e-4) || is_blocked(triangles, *p, t, 1e-4)) continue;
    const bool known = std::any_of(found.begin(), found.end(), [&](const Eigen::Vector3d& other) {
      return (other - *p).norm() < 1e-4;
    });
    if (!known) found.push_back(*p);
  }
  return found;
}

/// All facets reflect, however small. Bounces agree to the 0.1 mm that facets are flat to.
void compare_bounces(const std::string& world) {
  Diagnostics diagnostics;
  Scene scene = load_world(world, {}, diagnostics);
  const auto is_not_flat = [](const Collision& one) {
    return !std::holds_alternative<Box>(one.shape) && !std::holds_alternative<MeshPtr>(one.shape);
  };
  scene.collisions.erase(
      std::remove_if(scene.collisions.begin(), scene.collisions.end(), is_not_flat),
      scene.collisions.end());
  RadioSceneOptions all;
  all.opaque.assign(scene.collisions.size(), 1);
  all.min_facet_m2 = 0.0;
  const RadioScene radio(scene, all);
  const std::vector<TestTriangle> triangles = all_triangles(scene);
  TraceOptions options;
  options.order = 1;
  options.mount_depth_m = 0.0;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> across(-6.0, 6.0);
  std::uniform_real_distribution<double> up(0.2, 2.5);
  std::vector<RadioPath> paths;
  std::size_t count = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d a(across(random), across(random), up(random));
    const Eigen::Vector3d t(across(random), across(random), up(random));
    trace_paths(radio, images_of(radio, a, options), t, options, paths);
    if (!paths.empty() && paths[0].bounce_count == 0) paths.erase(paths.begin());
    const std::vector<Eigen::Vector3d> expected = all_bounces(triangles, a, t);
    EXPECT_EQ(paths.size(), expected.size()) << i;
    for (const Eigen::Vector3d& p : expected) {
      EXPECT_TRUE(std::any_of(
          paths.begin(), paths.end(),
          [&](const RadioPath& path) { return (path.bounces[0].p_W - p).norm() < 1e-3; }))
          << i << ": " << p.transpose();
    }
    count += expected.size();
  }
  EXPECT_GT(count, 200U);
}

TEST(Occlusion, IsThatOfEveryTriangleInTheSmallWarehouse) {
  compare(TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf");
}

TEST(Bounces, AreThoseOfEveryTriangleInTheSmallWarehouse) {
  compare_bounces(TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf");
}

/// File of the AWS warehouse, which may not exist.
std::string aws_world() {
  const char* named = std::getenv("TAGFIELD_AWS_WORLD");
  return named != nullptr ? named
                          : TAGFIELD_SOURCE_DIR
             "/../shared/data/aws-small-warehouse/worlds/"
             "no_roof_small_warehouse.world";
}

TEST(Occlusion, IsThatOfEveryTriangleInTheAwsWarehouse) {
  if (!std::ifstream(aws_world())) GTEST_SKIP() << "no AWS warehouse at " << aws_world();
  compare(aws_world());
}

TEST(Bounces, AreThoseOfEveryTriangleInTheAwsWarehouse) {
  if (!std::ifstream(aws_world())) GTEST_SKIP() << "no AWS warehouse at " << aws_world();
  compare_bounces(aws_world());
}

}  // namespace
}  // namespace tagfield
