// SPDX-License-Identifier: Apache-2.0
// A rectangular room against the lattice of its images: J. Allen, D. Berkley, Image method for
// efficiently simulating small-room acoustics, J. Acoust. Soc. Am. 65(4), 1979.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/propagation/trace_paths.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

struct Room {
  Eigen::Vector3d low;
  Eigen::Vector3d size;
};

Scene of_six_boxes(const Room& room) {
  Scene scene;
  const Eigen::Vector3d centre = room.low + 0.5 * room.size;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Eigen::Vector3d size = room.size + Eigen::Vector3d::Constant(0.5);
      size[axis] = 0.2;
      Eigen::Vector3d p = centre;
      p[axis] += side * (0.5 * room.size[axis] + 0.1);
      scene.collisions.push_back({"wall", Box{size}, from_translation(p)});
    }
  }
  return scene;
}

Scene of_one_box(const Room& room) {
  Scene scene;
  scene.collisions = {{"room", Box{room.size}, from_translation(room.low + 0.5 * room.size)}};
  return scene;
}

Scene of_inside_out_mesh(const Room& room) {
  auto mesh = std::make_shared<TriangleMesh>(triangulate(Box{room.size}));
  for (auto& triangle : mesh->triangles) std::swap(triangle[1], triangle[2]);
  Scene scene;
  scene.collisions = {{"room", MeshPtr(mesh), from_translation(room.low + 0.5 * room.size)}};
  return scene;
}

struct Expected {
  int bounces = 0;
  Eigen::Vector3d departure;
  Eigen::Vector3d arrival;
  double length = 0.0;
};

/// The tag's images along one axis: at 2Lm + x after |2m| bounces and at 2Lm − x after |2m − 1|.
struct Coordinate {
  double x = 0.0;
  int bounces = 0;
};

std::vector<Coordinate> images_along(double length, double x) {
  std::vector<Coordinate> found;
  for (int m = -2; m <= 2; ++m) {
    found.push_back({2.0 * length * m + x, std::abs(2 * m)});
    found.push_back({2.0 * length * m - x, std::abs(2 * m - 1)});
  }
  return found;
}

std::vector<Expected> lattice(const Room& room, const Eigen::Vector3d& a, const Eigen::Vector3d& t,
                              int order) {
  const Eigen::Vector3d tag = t - room.low;
  std::vector<Expected> found;
  for (const Coordinate& x : images_along(room.size.x(), tag.x())) {
    for (const Coordinate& y : images_along(room.size.y(), tag.y())) {
      for (const Coordinate& z : images_along(room.size.z(), tag.z())) {
        const int bounces = x.bounces + y.bounces + z.bounces;
        if (bounces > order) continue;
        const Eigen::Vector3d way = Eigen::Vector3d(x.x, y.x, z.x) + room.low - a;
        const Eigen::Vector3d departure = way / way.norm();
        // Each bounce reverses the direction along its axis.
        const Eigen::Vector3d turned(x.bounces % 2 ? -1.0 : 1.0, y.bounces % 2 ? -1.0 : 1.0,
                                     z.bounces % 2 ? -1.0 : 1.0);
        found.push_back({bounces, departure, departure.cwiseProduct(turned), way.norm()});
      }
    }
  }
  return found;
}

bool matches(const RadioPath& path, const Expected& expected) {
  return path.bounce_count == expected.bounces &&
         std::abs(path.length_m - expected.length) < 1e-9 &&
         (path.departure_W - expected.departure).norm() < 1e-9 &&
         (path.arrival_W - expected.arrival).norm() < 1e-9;
}

double any(int low, int high) { return 1e-4 * *rc::gen::inRange(low, high); }

/// A point at multiples of 1e-4 of the room's size, plus an odd offset so that paths don't run
/// along edges.
Eigen::Vector3d any_in(const Room& room) {
  const Eigen::Vector3d part(any(50, 9950), any(50, 9950), any(50, 9950));
  return room.low + room.size.cwiseProduct(part) + Eigen::Vector3d(1.1e-5, 2.3e-5, -1.7e-5);
}

void expect_lattice(const Scene& scene, const Room& room, const Eigen::Vector3d& a,
                    const Eigen::Vector3d& t) {
  RC_PRE((a - t).norm() > 1e-3);
  RadioSceneOptions opaque;
  opaque.opaque.assign(scene.collisions.size(), 1);
  const RadioScene radio(scene, opaque);
  TraceOptions options;
  options.order = 3;
  std::vector<RadioPath> paths;
  trace_paths(radio, images_of(radio, a, options), t, options, paths);
  const std::vector<Expected> expected = lattice(room, a, t, 3);
  RC_ASSERT(expected.size() == 63U);  // 1 + 6 + 18 + 38
  RC_ASSERT(paths.size() == expected.size());
  for (const Expected& one : expected) {
    const auto same = std::count_if(paths.begin(), paths.end(),
                                    [&](const RadioPath& path) { return matches(path, one); });
    RC_ASSERT(same == 1);
  }
}

Room any_room() {
  return {{any(-50000, 50000), any(-50000, 50000), any(-5000, 5000)},
          {any(15000, 200000), any(15000, 200000), any(15000, 60000)}};
}

RC_GTEST_PROP(Shoebox, OfSixBoxesHasTheLatticeOfImages, ()) {
  const Room room = any_room();
  expect_lattice(of_six_boxes(room), room, any_in(room), any_in(room));
}

RC_GTEST_PROP(Shoebox, OfOneBoxHasTheLatticeOfImages, ()) {
  const Room room = any_room();
  expect_lattice(of_one_box(room), room, any_in(room), any_in(room));
}

RC_GTEST_PROP(Shoebox, OfAnInsideOutMeshHasTheLatticeOfImages, ()) {
  const Room room = any_room();
  expect_lattice(of_inside_out_mesh(room), room, any_in(room), any_in(room));
}

}  // namespace
}  // namespace tagfield
