// How fast inventory is simulated: seconds of it a second, with all tags of one field in range.
// Each second the field is told anew ten times, as by a robot that drives. BENCHMARK.md has the
// results.
#include <benchmark/benchmark.h>

#include "tagfield/gen2/inventory.h"

namespace tagfield {
namespace {

std::vector<TagOnAir> field_of(std::int64_t tags) {
  std::vector<TagOnAir> field;
  for (std::int64_t tag = 0; tag < tags; ++tag) {
    field.push_back({static_cast<std::uint32_t>(tag), -60.0, 0.98});
  }
  return field;
}

void run(benchmark::State& state, Session session, Target target) {
  const std::vector<TagOnAir> field = field_of(state.range(0));
  InventorySettings settings;
  settings.session = session;
  settings.target = target;
  settings.capture_db = 6.0;
  TagMemories memories;
  Inventory inventory({}, settings, memories, 1, 1);
  inventory.start(Time{});
  std::vector<Singulation> reads;
  std::int64_t steps = 0;
  std::size_t read = 0;
  for (auto _ : state) {
    for (int i = 0; i < 10; ++i) {
      const Time time = time_from_seconds(0.1 * static_cast<double>(steps++));
      inventory.run_until(time, reads);
      inventory.set_field(time, field);
    }
    read += reads.size();
    reads.clear();
  }
  const auto seconds = static_cast<double>(state.iterations());
  state.counters["real_time_factor"] = benchmark::Counter(seconds, benchmark::Counter::kIsRate);
  state.counters["reads_per_s"] = static_cast<double>(read) / seconds;
}

void dual_target_in_s0(benchmark::State& state) { run(state, Session::kS0, Target::kAlternate); }
void single_target_in_s1(benchmark::State& state) { run(state, Session::kS1, Target::kA); }
void single_target_in_s2(benchmark::State& state) { run(state, Session::kS2, Target::kA); }

BENCHMARK(dual_target_in_s0)->RangeMultiplier(10)->Range(1, 10000);
BENCHMARK(single_target_in_s1)->RangeMultiplier(10)->Range(1, 10000);
BENCHMARK(single_target_in_s2)->RangeMultiplier(10)->Range(1, 10000);

}  // namespace
}  // namespace tagfield
