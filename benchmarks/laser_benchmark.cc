// SPDX-License-Identifier: Apache-2.0
// Speed of laser scans: rays per second of simulate_scan() with 720 beams, of RayScene alone, and
// of Embree itself with the same rays, in the small warehouse and, if the environment variable
// TAGFIELD_AWS_WORLD names it, in the AWS warehouse. BENCHMARK.md has the results and the command.
#include <benchmark/benchmark.h>
#if TAGFIELD_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "tagfield/laser/deskew.h"
#include "tagfield/laser/simulated_laser.h"
#include "tagfield/sdf/load_world.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

const char* world_file(std::int64_t which) {
  return which == 0 ? TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf"
                    : std::getenv("TAGFIELD_AWS_WORLD");
}

Scene load(const char* path) {
  Diagnostics diagnostics;
  return load_world(path, {}, diagnostics);
}

std::size_t triangle_count(const Scene& scene) {
  std::size_t count = 0;
  for (const Collision& collision : scene.collisions) count += triangle_count(collision.shape);
  return count;
}

/// A robot that drives in a circle about the middle of the hall.
RigidTransform on_circle(Time time) {
  const double angle = 0.3 * to_seconds(time);
  return from_planar(1.5 * std::cos(angle), 1.5 * std::sin(angle), angle + 1.57);
}

/// Rays of 32 scans, each from another position.
std::vector<std::vector<Ray>> scans_of_rays(const LaserParameters& laser) {
  std::vector<std::vector<Ray>> scans(32);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const RigidTransform X_WL =
        on_circle(scan_stamp(laser, 20 * static_cast<std::int64_t>(k))) * laser.X_RL;
    for (int i = 0; i < laser.beams; ++i) {
      const double angle = laser.first_angle_rad +
                           (laser.last_angle_rad - laser.first_angle_rad) * i / (laser.beams - 1);
      const Eigen::Vector3d forward(std::cos(angle), std::sin(angle), 0.0);
      scans[k].push_back({X_WL.translation.cast<float>(), (X_WL.rotation * forward).cast<float>(),
                          static_cast<float>(laser.max_range_m)});
    }
  }
  return scans;
}

void report(benchmark::State& state, const Scene& scene, std::int64_t rays) {
  state.SetItemsProcessed(rays);
  state.counters["triangles"] = static_cast<double>(triangle_count(scene));
}

/// Only the scene's solids, set up as in Embree's tutorials.
class EmbreeScene {
 public:
  EmbreeScene(const Scene& scene, RTCSceneFlags flags)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, flags);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    for (const Collision& collision : scene.collisions) {
      if (!std::holds_alternative<Plane>(collision.shape)) add(collision);
    }
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  [[nodiscard]] RTCScene get() const { return scene_; }

 private:
  void add(const Collision& collision) {
    const TriangleMesh mesh = triangulate(collision.shape);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices.size()));
    auto* index = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (const Eigen::Vector3d& p_C : mesh.vertices) {
      const Eigen::Vector3d p_W = collision.X_WC * p_C;
      for (int axis = 0; axis < 3; ++axis) *vertex++ = static_cast<float>(p_W[axis]);
    }
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) *index++ = corner;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  RTCDevice device_;
  RTCScene scene_;
};

float intersect_one(RTCScene scene, const Ray& ray) {
  RTCRayHit hit{};
  hit.ray.org_x = ray.origin.x();
  hit.ray.org_y = ray.origin.y();
  hit.ray.org_z = ray.origin.z();
  hit.ray.dir_x = ray.direction.x();
  hit.ray.dir_y = ray.direction.y();
  hit.ray.dir_z = ray.direction.z();
  hit.ray.tfar = ray.max_m;
  hit.ray.mask = ~0U;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if TAGFIELD_EMBREE >= 4
  rtcIntersect1(scene, &hit);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &hit);
#endif
  return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                   : hit.ray.tfar;
}

/// rtcIntersect1() for one ray after the other.
void embree_alone(benchmark::State& state, RTCSceneFlags flags) {
  const char* path = world_file(state.range(0));
  if (path == nullptr) return state.SkipWithError("TAGFIELD_AWS_WORLD is not set");
  const Scene scene = load(path);
  const EmbreeScene embree(scene, flags);
  const auto scans = scans_of_rays(LaserParameters{});
  std::size_t next = 0;
  std::int64_t rays = 0;
  for (auto _ : state) {
    for (const Ray& ray : scans[next]) benchmark::DoNotOptimize(intersect_one(embree.get(), ray));
    rays += static_cast<std::int64_t>(scans[next].size());
    next = (next + 1) % scans.size();
  }
  report(state, scene, rays);
}

void Embree(benchmark::State& state) { embree_alone(state, RTC_SCENE_FLAG_NONE); }
void EmbreeRobust(benchmark::State& state) { embree_alone(state, RTC_SCENE_FLAG_ROBUST); }

void RayScenePackets(benchmark::State& state) {
  const char* path = world_file(state.range(0));
  if (path == nullptr) return state.SkipWithError("TAGFIELD_AWS_WORLD is not set");
  const Scene scene = load(path);
  const RayScene world(scene);
  const auto scans = scans_of_rays(LaserParameters{});
  std::vector<float> distances;
  std::size_t next = 0;
  std::int64_t rays = 0;
  for (auto _ : state) {
    world.distances(scans[next], distances);
    benchmark::DoNotOptimize(distances.data());
    rays += static_cast<std::int64_t>(distances.size());
    next = (next + 1) % scans.size();
  }
  report(state, scene, rays);
}

void RaySceneOneByOne(benchmark::State& state) {
  const char* path = world_file(state.range(0));
  if (path == nullptr) return state.SkipWithError("TAGFIELD_AWS_WORLD is not set");
  const Scene scene = load(path);
  const RayScene world(scene);
  const auto scans = scans_of_rays(LaserParameters{});
  std::size_t next = 0;
  std::int64_t rays = 0;
  for (auto _ : state) {
    for (const Ray& ray : scans[next]) benchmark::DoNotOptimize(world.distance(ray));
    rays += static_cast<std::int64_t>(scans[next].size());
    next = (next + 1) % scans.size();
  }
  report(state, scene, rays);
}

void simulate(benchmark::State& state, const LaserParameters& laser, const Obstacles& obstacles) {
  const char* path = world_file(state.range(0));
  if (path == nullptr) return state.SkipWithError("TAGFIELD_AWS_WORLD is not set");
  const Scene scene = load(path);
  const RayScene world(scene);
  std::int64_t number = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulate_scan(
        world, laser, 20 * (number++ % 32), on_circle, [&](Time) { return obstacles; }, 1, 2));
  }
  report(state, scene, number * laser.beams);
}

void SimulateScan(benchmark::State& state) { simulate(state, {}, {}); }

void SimulateScanInASweep(benchmark::State& state) {
  LaserParameters laser;
  laser.sweep_s = 0.02;
  simulate(state, laser, {});
}

void SimulateScanAmongTenObstacles(benchmark::State& state) {
  Obstacles obstacles;
  for (int i = 0; i < 5; ++i) {
    obstacles.discs.push_back({{3.0 - i, 2.0}, 0.3});
    obstacles.rectangles.push_back({{-3.0 + i, -2.0}, {0.8, 0.6}, 0.3 * i});
  }
  simulate(state, {}, obstacles);
}

void Deskew(benchmark::State& state) {
  const char* path = world_file(state.range(0));
  if (path == nullptr) return state.SkipWithError("TAGFIELD_AWS_WORLD is not set");
  const Scene scene = load(path);
  LaserParameters laser;
  laser.sweep_s = 0.02;
  const LaserScan scan = simulate_scan(RayScene(scene), laser, 0, on_circle, nullptr, 1, 2);
  const auto odometry_at = [](Time time) { return advance({}, {0.45, 0.3}, to_seconds(time)); };
  std::int64_t count = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(deskewed(scan, odometry_at, laser.X_RL));
    ++count;
  }
  report(state, scene, count * laser.beams);
}

BENCHMARK(Embree)->Arg(0)->Arg(1)->ArgName("aws");
BENCHMARK(EmbreeRobust)->Arg(0)->Arg(1)->ArgName("aws");
BENCHMARK(RaySceneOneByOne)->Arg(0)->Arg(1)->ArgName("aws");
BENCHMARK(RayScenePackets)->Arg(0)->Arg(1)->ArgName("aws");
BENCHMARK(SimulateScan)->Arg(0)->Arg(1)->ArgName("aws");
BENCHMARK(SimulateScanInASweep)->Arg(0)->Arg(1)->ArgName("aws");
BENCHMARK(SimulateScanAmongTenObstacles)->Arg(0)->Arg(1)->ArgName("aws");
BENCHMARK(Deskew)->Arg(0)->Arg(1)->ArgName("aws");

}  // namespace
}  // namespace tagfield

BENCHMARK_MAIN();
