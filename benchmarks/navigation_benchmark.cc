// SPDX-License-Identifier: Apache-2.0
// Speed of simulated autonomous robots: mapping, and localizing and driving on the map, as
// multiples of real time, in the paper's warehouse and, if the environment variable
// TAGFIELD_AWS_WORLD names it, in the AWS warehouse. BENCHMARK.md has the results and the command.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "tagfield/experiment/experiment.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

constexpr int kThreads = 2;

/// The paper's experiment, or the same robot among the AWS world's shelves.
ScenarioWithWorld scenario_of(std::int64_t which, Diagnostics& diagnostics) {
  if (which == 0) {
    return load_scenario_with_world(TAGFIELD_SOURCE_DIR "/scenarios/paper_warehouse_slam.yaml", {},
                                    diagnostics);
  }
  const std::string world = std::getenv("TAGFIELD_AWS_WORLD");
  return load_scenario_with_world(
      TAGFIELD_SOURCE_DIR "/scenarios/aws_warehouse.yaml",
      {parse_override("world.path=" + world), parse_override("navigation=slam")}, diagnostics);
}

struct Ready {
  Scenario scenario;
  NavigationWorld world;
};

std::optional<Ready> ready(benchmark::State& state) {
  if (state.range(0) == 1 && std::getenv("TAGFIELD_AWS_WORLD") == nullptr) {
    state.SkipWithError("TAGFIELD_AWS_WORLD is not set");
    return std::nullopt;
  }
  Diagnostics diagnostics;
  const ScenarioWithWorld loaded = scenario_of(state.range(0), diagnostics);
  return Ready{loaded.scenario, navigation_world(loaded.scenario, loaded.scene, diagnostics)};
}

Survey survey_of(const Ready& ready, std::uint64_t seed) {
  const Scenario& scenario = ready.scenario;
  return survey(navigation_of(scenario), ready.world, mapping_robot(scenario), scenario.time_step_s,
                seed, kThreads, nullptr, {});
}

void count_time(benchmark::State& state, double simulated_s) {
  state.counters["real_time"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
}

void Mapping(benchmark::State& state) {
  const std::optional<Ready> made = ready(state);
  if (!made) return;
  double simulated_s = 0.0;
  std::uint64_t seed = 0;
  for (auto _ : state) simulated_s += survey_of(*made, ++seed).simulated_s;
  count_time(state, simulated_s);
}

/// Including the antennas' reads, on an existing map.
void LocalizationAndDriving(benchmark::State& state) {
  std::optional<Ready> made = ready(state);
  if (!made) return;
  made->world.given_map = survey_of(*made, 1).map;
  double simulated_s = 0.0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    RunControl control;
    control.threads = kThreads;
    simulated_s += simulate(made->scenario, ++seed, control, &made->world).simulated_s;
  }
  count_time(state, simulated_s);
}

BENCHMARK(Mapping)->Arg(0)->Arg(1)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);
BENCHMARK(LocalizationAndDriving)
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(3);

}  // namespace
}  // namespace tagfield

BENCHMARK_MAIN();
