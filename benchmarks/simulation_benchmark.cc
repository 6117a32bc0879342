// SPDX-License-Identifier: Apache-2.0
// Speed of the headless simulator: the paper's experiment, many tags, and the cost of a read for
// 100 to 100,000 tags. BENCHMARK.md has the results and the command.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "tagfield/experiment/experiment.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

constexpr double kSimulatedSeconds = 4.0;

void add_tag(Scenario& scenario, double x, double y) {
  TagSpec tag;
  tag.id = "E280" + std::to_string(scenario.tags.size());
  tag.motion = {{Time{}, from_translation({x, y, 1.0})}};
  scenario.tags.push_back(std::move(tag));
}

/// Tags on a square grid `spacing_m` apart, centred on the origin.
void add_tag_grid(Scenario& scenario, std::int64_t tags, double spacing_m) {
  const auto side = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(tags))));
  const double middle = 0.5 * static_cast<double>(side - 1);
  for (std::int64_t i = 0; i < tags; ++i) {
    const std::int64_t row = i / side;
    const std::int64_t column = i % side;
    add_tag(scenario, (static_cast<double>(column) - middle) * spacing_m,
            (static_cast<double>(row) - middle) * spacing_m);
  }
}

void add_antenna(Scenario& scenario, double x, double y) {
  AntennaSpec antenna;
  antenna.parameters.name = "antenna" + std::to_string(scenario.antennas.size());
  antenna.X_PA = from_translation({x, y, 2.0});
  scenario.antennas.push_back(antenna);
}

/// Four antennas at the corners of a square of 4 m around the origin, 7 m of range, 15 Hz.
Scenario four_antennas() {
  Scenario scenario;
  scenario.duration_s = kSimulatedSeconds;
  for (const double x : {-2.0, 2.0}) {
    for (const double y : {-2.0, 2.0}) add_antenna(scenario, x, y);
  }
  return scenario;
}

void clear(Recording& recording) {
  recording.reads.clear();
  recording.believed_poses.clear();
  recording.truth.antenna_poses.clear();
  recording.truth.robot_poses.clear();
  recording.truth.tag_positions.clear();
  recording.truth.distances.clear();
}

/// Repeatedly steps the scenario to its end; counts reads and simulated time per second. Placing
/// the tags, once per run, is not timed.
void run_steps(benchmark::State& state, const Scenario& scenario) {
  double reads = 0.0;
  double simulated_s = 0.0;
  Recording recording;
  for (auto _ : state) {
    state.PauseTiming();
    auto simulation = std::make_unique<Simulation>(scenario, 1, recorded_in(recording));
    simulation->step();
    const Time begin = simulation->now();
    state.ResumeTiming();
    while (!simulation->finished()) {
      clear(recording);
      simulation->step();
      reads += static_cast<double>(recording.reads.size());
    }
    state.PauseTiming();
    simulated_s += to_seconds(simulation->now() - begin);
    simulation.reset();
    state.ResumeTiming();
  }
  using benchmark::Counter;
  state.counters["real_time_factor"] = Counter(simulated_s, Counter::kIsRate);
  state.counters["reads_per_s"] = Counter(reads, Counter::kIsRate);
  state.counters["time_per_read"] = Counter(reads, Counter::kIsRate | Counter::kInvert);
}

/// scenarios/paper_warehouse.yaml, simulated and localized on one core, without loading, files and
/// page.
void PaperWarehouse(benchmark::State& state) {
  Diagnostics diagnostics;
  const Scenario scenario =
      load_scenario_with_world(std::string(TAGFIELD_SOURCE_DIR) + "/scenarios/paper_warehouse.yaml",
                               {}, diagnostics)
          .scenario;
  double simulated_s = 0.0;
  for (auto _ : state) {
    simulated_s += run_seeds(scenario, 1, 1, {}, diagnostics).front().simulated_s;
  }
  state.counters["real_time_factor"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
}
BENCHMARK(PaperWarehouse)->Unit(benchmark::kMillisecond);

/// 10,000 tags a metre apart in a hall of 100 m by 100 m, as in a warehouse.
void TenThousandTagsInAHall(benchmark::State& state) {
  Scenario scenario = four_antennas();
  add_tag_grid(scenario, 10'000, 1.0);
  run_steps(state, scenario);
}
BENCHMARK(TenThousandTagsInAHall)->Unit(benchmark::kMillisecond);

/// 10,000 tags in an area of 5 m by 5 m: every antenna reads every tag in every update.
void TenThousandTagsAllInRange(benchmark::State& state) {
  Scenario scenario = four_antennas();
  add_tag_grid(scenario, 10'000, 0.05);
  run_steps(state, scenario);
}
BENCHMARK(TenThousandTagsAllInRange)->Unit(benchmark::kMillisecond);

/// A hall that grows with its tags, one per square metre: the cost per read must not grow.
void GrowingHall(benchmark::State& state) {
  Scenario scenario = four_antennas();
  add_tag_grid(scenario, state.range(0), 1.0);
  run_steps(state, scenario);
}
BENCHMARK(GrowingHall)->RangeMultiplier(10)->Range(100, 100'000)->Unit(benchmark::kMillisecond);

/// Tags in an area of 5 m by 5 m, all of which each of the four antennas reads in every update.
void TagsInRange(benchmark::State& state) {
  Scenario scenario = four_antennas();
  add_tag_grid(scenario, state.range(0), 5.0 / std::sqrt(static_cast<double>(state.range(0))));
  run_steps(state, scenario);
}
BENCHMARK(TagsInRange)->RangeMultiplier(10)->Range(10, 10'000)->Unit(benchmark::kMillisecond);

/// Antennas that all read the same 100 tags.
void Antennas(benchmark::State& state) {
  Scenario scenario;
  scenario.duration_s = kSimulatedSeconds;
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    add_antenna(scenario, 0.02 * static_cast<double>(i), 0.0);
  }
  add_tag_grid(scenario, 100, 0.3);
  run_steps(state, scenario);
}
BENCHMARK(Antennas)->RangeMultiplier(4)->Range(1, 64)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tagfield

BENCHMARK_MAIN();
