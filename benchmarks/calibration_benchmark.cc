// SPDX-License-Identifier: Apache-2.0
// A loop that never changes: results of other benchmarks are compared as ratios to it, between
// versions and machines.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace {

/// A million steps of integer arithmetic, square roots and a table that fits into the L2 cache.
void calibration(benchmark::State& state) {
  constexpr std::size_t kEntries = std::size_t{1} << 14U;
  std::vector<double> table(kEntries, 1.0);
  std::uint64_t word = 1;
  for (auto _ : state) {
    for (int i = 0; i < 1'000'000; ++i) {
      word = word * 6364136223846793005U + 1442695040888963407U;
      double& entry = table[word >> 50U];
      entry = std::sqrt(entry + 1.0);
    }
    benchmark::DoNotOptimize(table.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(calibration)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
