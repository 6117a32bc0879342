// The straight way against every triangle of a world.
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

/// What the segment is to one triangle: kTooNear where it passes within kNear of its rim, or ends
/// near its surface.
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
  // Across the line, not along the triangle's plane.
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

TEST(Occlusion, IsThatOfEveryTriangleInTheSmallWarehouse) {
  compare(TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf");
}

TEST(Occlusion, IsThatOfEveryTriangleInTheAwsWarehouse) {
  const char* named = std::getenv("TAGFIELD_AWS_WORLD");
  const std::string world = named != nullptr ? named
                                             : TAGFIELD_SOURCE_DIR
                                "/../shared/data/aws-small-warehouse/worlds/"
                                "no_roof_small_warehouse.world";
  if (!std::ifstream(world)) GTEST_SKIP() << "no AWS warehouse at " << world;
  compare(world);
}

}  // namespace
}  // namespace tagfield
