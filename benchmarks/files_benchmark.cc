// SPDX-License-Identifier: Apache-2.0
// Throughput of writing reads to CSV and reading them; see BENCHMARK.md.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "tagfield/base/units.h"
#include "tagfield/files/files.h"
#include "tagfield/files/reads_csv.h"

namespace tagfield {
namespace {

/// Reads of 1,000 tags with 96-bit EPCs, by two antennas in 16 channels.
std::vector<TagRead> reads(std::size_t count) {
  std::vector<TagRead> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    TagRead& read = all[i];
    read.stamp = time_from_seconds(1.7e9) + std::chrono::microseconds(1234) * i;
    read.reader = "reader_1";
    read.antenna = i % 2 == 0 ? "dock_left" : "dock_right";
    read.tag = "3034257bf7194e40000" + std::to_string(10000 + i % 1000);
    read.frequency_hz = 865.7e6 + 0.6e6 * static_cast<double>(i / 100 % 16);
    read.phase_rad = wrap_to_two_pi(0.37 * static_cast<double>(i));
    read.rssi_dbm = std::round(-100.0 - 80.0 * std::sin(0.01 * static_cast<double>(i))) / 2.0;
  }
  return all;
}

void write_reads(benchmark::State& state) {
  const std::vector<TagRead> all = reads(200'000);
  std::size_t bytes = 0;
  for (auto _ : state) bytes += reads_to_csv(all).size();
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(all.size()));
}
BENCHMARK(write_reads)->Unit(benchmark::kMillisecond);

void read_reads(benchmark::State& state) {
  const std::string text = reads_to_csv(reads(200'000));
  const std::string path =
      std::filesystem::temp_directory_path() / ("reads-" + std::to_string(getpid()) + ".csv");
  write_text_file(path, text);
  std::size_t count = 0;
  for (auto _ : state) count += read_reads_csv(path).size();
  std::filesystem::remove(path);
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(text.size()));
  state.SetItemsProcessed(static_cast<std::int64_t>(count));
}
BENCHMARK(read_reads)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tagfield

BENCHMARK_MAIN();
