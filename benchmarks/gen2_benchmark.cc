// SPDX-License-Identifier: Apache-2.0
// Speed of simulated inventory: simulated seconds per second, with all tags of one field in range.
// The field is updated ten times per simulated second, as by a moving robot. BENCHMARK.md has the
// results.
#include <benchmark/benchmark.h>

#include "tagfield/gen2/inventory.h"

namespace tagfield {
namespace {

std::vector<TagOnAir> field_of(std::int64_t tags, double decode_probability) {
  std::vector<TagOnAir> field;
  for (std::int64_t tag = 0; tag < tags; ++tag) {
    field.push_back({static_cast<std::uint32_t>(tag), -60.0, decode_probability});
  }
  return field;
}

void run(benchmark::State& state, const LinkSettings& link, Session session, Target target,
         double decode_probability = 0.98) {
  const std::vector<TagOnAir> field = field_of(state.range(0), decode_probability);
  InventorySettings settings;
  settings.session = session;
  settings.target = target;
  settings.capture_db = 6.0;  // None is 6 dB above the others, but all must be summed.
  TagMemories memories;
  Inventory inventory(link, settings, memories, 1, 1);
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

void dual_target_in_s0(benchmark::State& state) {
  run(state, {}, Session::kS0, Target::kAlternate);
}
void single_target_in_s1(benchmark::State& state) { run(state, {}, Session::kS1, Target::kA); }
void single_target_in_s2(benchmark::State& state) { run(state, {}, Session::kS2, Target::kA); }

/// Reads per second with links from slow to fast, dual target in S0, all replies decoded.
void reads(benchmark::State& state, const LinkSettings& link) {
  run(state, link, Session::kS0, Target::kAlternate, 1.0);
}

LinkSettings link(double tari_s, double data1_tari, double blf_hz, Encoding encoding, bool pilot) {
  LinkSettings link;
  link.tari_s = tari_s;
  link.data1_tari = data1_tari;
  link.blf_hz = blf_hz;
  link.encoding = encoding;
  link.pilot = pilot;
  return link;
}

BENCHMARK(dual_target_in_s0)->RangeMultiplier(10)->Range(1, 10000);
BENCHMARK(single_target_in_s1)->RangeMultiplier(10)->Range(1, 10000);
BENCHMARK(single_target_in_s2)->RangeMultiplier(10)->Range(1, 10000);
BENCHMARK_CAPTURE(reads, miller8_250khz, link(25e-6, 2.0, 250e3, Encoding::kMiller8, true))
    ->RangeMultiplier(10)
    ->Range(1, 1000);
BENCHMARK_CAPTURE(reads, miller4_250khz, LinkSettings{})->RangeMultiplier(10)->Range(1, 1000);
BENCHMARK_CAPTURE(reads, miller2_320khz, link(12.5e-6, 1.5, 320e3, Encoding::kMiller2, false))
    ->RangeMultiplier(10)
    ->Range(1, 1000);
BENCHMARK_CAPTURE(reads, fm0_640khz, link(6.25e-6, 2.0, 640e3, Encoding::kFm0, false))
    ->RangeMultiplier(10)
    ->Range(1, 1000);

}  // namespace
}  // namespace tagfield

BENCHMARK_MAIN();
