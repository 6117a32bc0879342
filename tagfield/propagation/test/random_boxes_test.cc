// SPDX-License-Identifier: Apache-2.0
// Paths among random boxes, against all sequences of their faces.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>
#include <thread>

#include "tagfield/propagation/test/brute_force.h"
#include "tagfield/propagation/trace_paths.h"

namespace tagfield {
namespace {

/// A face of a box: |u·(p − centre)| ≤ half_u and the same for v, in its plane.
struct Face {
  Eigen::Vector3d centre;
  Eigen::Vector3d normal;  ///< Out of the box, or into it if it contains the antenna.
  Eigen::Vector3d u;
  Eigen::Vector3d v;
  double half_u = 0.0;
  double half_v = 0.0;
  std::size_t solid = 0;
};

bool is_in_box(const Collision& collision, const Eigen::Vector3d& p) {
  const Eigen::Vector3d p_C = collision.X_WC.inverse() * p;
  const Eigen::Vector3d half = 0.5 * std::get<Box>(collision.shape).size;
  return (p_C.cwiseAbs() - half).maxCoeff() < 0.0;
}

std::vector<Face> faces_of(const Scene& scene, const Eigen::Vector3d& antenna) {
  std::vector<Face> faces;
  for (std::size_t solid = 0; solid < scene.collisions.size(); ++solid) {
    const Collision& collision = scene.collisions[solid];
    const Eigen::Vector3d half = 0.5 * std::get<Box>(collision.shape).size;
    const Eigen::Matrix3d R = collision.X_WC.rotation.toRotationMatrix();
    const double way = is_in_box(collision, antenna) ? -1.0 : 1.0;
    for (int k = 0; k < 3; ++k) {
      for (const double side : {-1.0, 1.0}) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        faces.push_back({collision.X_WC.translation + side * half[k] * R.col(k),
                         way * side * R.col(k), R.col(i), R.col(j), half[i], half[j], solid});
      }
    }
  }
  return faces;
}

using Points = std::vector<Eigen::Vector3d>;

/// The path via `sequence`: the antenna, the bounces and the tag, or none.
std::optional<Points> way_by(const std::vector<Face>& sequence, const Eigen::Vector3d& antenna,
                             const Eigen::Vector3d& tag) {
  Points images{antenna};
  for (const Face& face : sequence) {
    const double height = face.normal.dot(images.back() - face.centre);
    if (height < 1e-6) return std::nullopt;
    images.emplace_back(images.back() - 2.0 * height * face.normal);
  }
  Points points{tag};
  for (std::size_t k = sequence.size(); k-- > 0;) {
    const Face& face = sequence[k];
    const Eigen::Vector3d p = points.back();
    const Eigen::Vector3d& image = images[k + 1];
    if (face.normal.dot(p - face.centre) < 1e-9) return std::nullopt;
    const double t = face.normal.dot(face.centre - p) / face.normal.dot(image - p);
    const Eigen::Vector3d hit = p + t * (image - p);
    if (std::abs(face.u.dot(hit - face.centre)) > face.half_u) return std::nullopt;
    if (std::abs(face.v.dot(hit - face.centre)) > face.half_v) return std::nullopt;
    points.push_back(hit);
  }
  points.push_back(antenna);
  return Points(points.rbegin(), points.rend());
}

struct BruteForce {
  std::vector<Face> faces;
  std::vector<TestTriangle> triangles;
  bool opaque = false;
  std::vector<Points> found;

  void search(std::vector<Face>& sequence, std::size_t order, const Eigen::Vector3d& antenna,
              const Eigen::Vector3d& tag) {
    const auto way = way_by(sequence, antenna, tag);
    if (way && (!opaque || is_clear(*way))) found.push_back(*way);
    if (sequence.size() == order) return;
    for (const Face& face : faces) {
      sequence.push_back(face);
      search(sequence, order, antenna, tag);
      sequence.pop_back();
    }
  }

  [[nodiscard]] bool is_clear(const Points& way) const {
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      if (is_blocked(triangles, way[i], way[i + 1], 1e-6)) return false;
    }
    return true;
  }
};

struct Case {
  Scene scene;
  Eigen::Vector3d antenna;
  Eigen::Vector3d tag;
};

Case random_case(std::uint64_t seed, bool may_be_inside) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto point = [&](double size) {
    return Eigen::Vector3d(size * unit(random), size * unit(random), size * unit(random));
  };
  Case found;
  const int count = 3 + static_cast<int>(seed % 6);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d size = Eigen::Vector3d::Constant(0.4) + (point(2.5)).cwiseAbs();
    // Half of them axis-aligned, the others arbitrarily rotated.
    const Eigen::Vector3d turn = i % 2 == 0 ? Eigen::Vector3d::Zero().eval() : point(3.0);
    found.scene.collisions.push_back({"box", Box{size}, from_xyz_rpy(point(3.0), turn)});
  }
  const auto is_inside = [&](const Eigen::Vector3d& p) {
    return std::any_of(found.scene.collisions.begin(), found.scene.collisions.end(),
                       [&](const Collision& one) { return is_in_box(one, p); });
  };
  do found.antenna = point(4.0);
  while (!may_be_inside && is_inside(found.antenna));
  do found.tag = point(4.0);
  while (!may_be_inside && is_inside(found.tag));
  return found;
}

std::vector<RadioPath> trace(const Case& the, int order, bool opaque, bool reversed = false) {
  RadioSceneOptions scene_options;
  scene_options.opaque.assign(the.scene.collisions.size(), opaque ? 1 : 0);
  const RadioScene radio(the.scene, scene_options);
  TraceOptions options;
  options.order = order;
  options.mount_depth_m = 0.0;
  std::vector<RadioPath> paths;
  const Eigen::Vector3d& from = reversed ? the.tag : the.antenna;
  const Eigen::Vector3d& to = reversed ? the.antenna : the.tag;
  trace_paths(radio, images_of(radio, from, options), to, options, paths);
  return paths;
}

bool is_same(const RadioPath& path, const Points& way) {
  if (static_cast<std::size_t>(path.bounce_count) + 2 != way.size()) return false;
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) length += (way[i + 1] - way[i]).norm();
  if (std::abs(length - path.length_m) > 1e-9) return false;
  for (std::size_t i = 0; i + 2 < way.size(); ++i) {
    if ((path.bounces[i].p_W - way[i + 1]).norm() > 1e-9) return false;
  }
  return (path.departure_W - (way[1] - way[0]).normalized()).norm() < 1e-9 &&
         (path.arrival_W - (way.back() - way[way.size() - 2]).normalized()).norm() < 1e-9;
}

/// Returns the number of reflected paths.
std::size_t expect_brute_force(const Case& the, int order, bool opaque) {
  BruteForce brute{faces_of(the.scene, the.antenna), all_triangles(the.scene), opaque, {}};
  std::vector<Face> sequence;
  brute.search(sequence, static_cast<std::size_t>(order), the.antenna, the.tag);
  const std::vector<RadioPath> paths = trace(the, order, opaque);
  EXPECT_EQ(paths.size(), brute.found.size());
  for (const Points& way : brute.found) {
    const auto same = std::count_if(paths.begin(), paths.end(),
                                    [&](const RadioPath& path) { return is_same(path, way); });
    EXPECT_EQ(same, 1);
  }
  return brute.found.size() - std::min<std::size_t>(brute.found.size(), 1);
}

TEST(RandomBoxes, HaveThePathsOfAllSequencesOfFaces) {
  std::size_t mirrored = 0;
  for (const bool opaque : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
      SCOPED_TRACE(testing::Message() << seed << (opaque ? " opaque" : ""));
      const int order = seed % 30 == 0 ? 3 : 2;
      mirrored += expect_brute_force(random_case(seed, true), order, opaque);
    }
  }
  EXPECT_GT(mirrored, 500U);
}

/// Whether `back` is `path` reversed.
bool is_reverse(const RadioPath& path, const RadioPath& back) {
  if (path.bounce_count != back.bounce_count || std::abs(path.length_m - back.length_m) > 1e-9 ||
      (path.departure_W + back.arrival_W).norm() > 1e-9 ||
      (path.arrival_W + back.departure_W).norm() > 1e-9 ||
      path.crossings.size() != back.crossings.size()) {
    return false;
  }
  const auto count = static_cast<std::size_t>(path.bounce_count);
  for (std::size_t i = 0; i < count; ++i) {
    const Bounce& one = path.bounces[i];
    const Bounce& other = back.bounces[count - 1 - i];
    if (one.facet != other.facet || (one.p_W - other.p_W).norm() > 1e-9) return false;
  }
  double crossed = 0.0;
  for (const Crossing& crossing : path.crossings) crossed += crossing.length_m;
  for (const Crossing& crossing : back.crossings) crossed -= crossing.length_m;
  return std::abs(crossed) < 1e-8;
}

TEST(RandomBoxes, GiveTheSamePathsWithTheEndsSwapped) {
  int compared = 0;
  for (const bool opaque : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
      const Case the = random_case(seed, false);
      const std::vector<RadioPath> there = trace(the, 3, opaque);
      const std::vector<RadioPath> back = trace(the, 3, opaque, true);
      EXPECT_EQ(there.size(), back.size()) << seed;
      for (const RadioPath& path : there) {
        ++compared;
        EXPECT_EQ(std::count_if(back.begin(), back.end(),
                                [&](const RadioPath& one) { return is_reverse(path, one); }),
                  1)
            << seed;
      }
    }
  }
  EXPECT_GT(compared, 2000);
}

TEST(RandomBoxes, GiveTheSamePathsOnSeveralThreads) {
  Case the = random_case(11, false);
  the.scene.collisions.push_back({"floor", Plane{}, from_translation({0.0, 0.0, -6.0})});
  RadioSceneOptions half;
  for (std::size_t i = 0; i < the.scene.collisions.size(); ++i) half.opaque.push_back(i % 2 == 0);
  const RadioScene radio(the.scene, half);
  TraceOptions options;
  options.order = 3;
  const ImageSet images = images_of(radio, the.antenna, options);
  const auto lengths = [&] {
    std::vector<double> found;
    std::vector<RadioPath> paths;
    for (int i = 0; i < 200; ++i) {
      trace_paths(radio, images, the.tag + Eigen::Vector3d(0.01 * i, 0.0, 0.0), options, paths);
      for (const RadioPath& path : paths) {
        found.push_back(path.length_m);
        for (const Crossing& crossing : path.crossings) found.push_back(crossing.length_m);
      }
    }
    return found;
  };
  const std::vector<double> alone = lengths();
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (std::vector<double>& one : found) threads.emplace_back([&] { one = lengths(); });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& one : found) EXPECT_EQ(one, alone);
  EXPECT_GT(alone.size(), 300U);
}

}  // namespace
}  // namespace tagfield
