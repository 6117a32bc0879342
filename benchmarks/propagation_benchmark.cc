// SPDX-License-Identifier: Apache-2.0
// Computation time of the paths from one antenna to many tags: images_of() and trace_paths() for
// each tag, in the small warehouse and, if the environment variable TAGFIELD_AWS_WORLD names it, in
// the AWS warehouse; by order, number of tags, of facets, and the rays' share of it.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <string>

#include "tagfield/propagation/trace_paths.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {
namespace {

const char* world_file(std::int64_t which) {
  return which == 0 ? TAGFIELD_SOURCE_DIR "/worlds/small_warehouse.sdf"
                    : std::getenv("TAGFIELD_AWS_WORLD");
}

/// Read once.
const Scene& load(std::int64_t which) {
  static std::map<std::int64_t, Scene> scenes;
  if (scenes.count(which) == 0) {
    Diagnostics diagnostics;
    scenes[which] = load_world(world_file(which), {}, diagnostics);
  }
  return scenes[which];
}

RadioSceneOptions options_for(const Scene& scene, bool opaque, double min_facet_m2) {
  RadioSceneOptions options;
  options.opaque.assign(scene.collisions.size(), opaque ? 1 : 0);
  options.min_facet_m2 = min_facet_m2;
  return options;
}

/// An antenna that circles around the middle of the hall.
Eigen::Vector3d on_circle(int update) {
  const double angle = 0.1 * update;
  return {1.5 * std::cos(angle), 1.5 * std::sin(angle), 1.0};
}

std::vector<Eigen::Vector3d> tags(std::int64_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-5.0, 5.0);
  std::uniform_real_distribution<double> up(0.2, 2.5);
  std::vector<Eigen::Vector3d> places;
  for (std::int64_t i = 0; i < count; ++i) {
    places.emplace_back(across(random), across(random), up(random));
  }
  return places;
}

struct Totals {
  double updates = 0.0;
  double images = 0.0;
  double paths = 0.0;
  double crossings = 0.0;
};

void report(benchmark::State& state, const RadioScene& scene, const Totals& totals,
            std::size_t tag_count) {
  const double links = totals.updates * static_cast<double>(tag_count);
  state.counters["facets"] = static_cast<double>(scene.facets().size());
  state.counters["left_out"] = static_cast<double>(scene.left_out().count);
  state.counters["images"] = totals.images / totals.updates;
  state.counters["paths"] = totals.paths / links;
  state.counters["crossings"] = totals.crossings / links;
  state.SetItemsProcessed(static_cast<std::int64_t>(links));
}

void run(benchmark::State& state, const RadioScene& scene, const TraceOptions& options,
         const std::vector<Eigen::Vector3d>& places) {
  std::vector<RadioPath> paths;
  Totals totals;
  for (auto _ : state) {
    const ImageSet images = images_of(scene, on_circle(static_cast<int>(totals.updates)), options);
    for (const Eigen::Vector3d& p_WT : places) {
      trace_paths(scene, images, p_WT, options, paths);
      totals.paths += static_cast<double>(paths.size());
      for (const RadioPath& path : paths) {
        totals.crossings += static_cast<double>(path.crossings.size());
      }
    }
    totals.images += static_cast<double>(images.images.size());
    totals.updates += 1.0;
  }
  report(state, scene, totals, places.size());
}

/// One update. Arguments: world, order, tags, whether all solids are opaque, whether to check for
/// obstructions, and the least facet [cm²].
void update(benchmark::State& state) {
  if (world_file(state.range(0)) == nullptr) {
    state.SkipWithError("TAGFIELD_AWS_WORLD names no world");
    return;
  }
  const Scene& world = load(state.range(0));
  const RadioScene scene(
      world, options_for(world, state.range(3) != 0, 1e-4 * static_cast<double>(state.range(5))));
  TraceOptions options;
  options.order = static_cast<int>(state.range(1));
  options.occlusion = state.range(4) != 0;
  run(state, scene, options, tags(state.range(2)));
}

void images_alone(benchmark::State& state) {
  if (world_file(state.range(0)) == nullptr) {
    state.SkipWithError("TAGFIELD_AWS_WORLD names no world");
    return;
  }
  const RadioScene scene(load(state.range(0)));
  TraceOptions options;
  options.order = static_cast<int>(state.range(1));
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(images_of(scene, on_circle(i++), options));
}

void each_case(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"aws", "order", "tags", "opaque", "occlusion", "cm2"});
  for (const int world : {0, 1}) {
    for (const int order : {0, 1, 2, 3}) {
      for (const int opaque : {1, 0}) benchmark->Args({world, order, 1000, opaque, 1, 1000});
      benchmark->Args({world, order, 1000, 1, 0, 1000});
    }
    for (const int count : {10, 100, 10000}) benchmark->Args({world, 2, count, 1, 1, 1000});
    for (const int least : {0, 300, 3000, 10000}) benchmark->Args({world, 2, 1000, 1, 1, least});
  }
}

BENCHMARK(update)->Apply(each_case)->Unit(benchmark::kMillisecond);
BENCHMARK(images_alone)
    ->ArgNames({"aws", "order"})
    ->ArgsProduct({{0, 1}, {1, 2, 3}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tagfield

BENCHMARK_MAIN();
