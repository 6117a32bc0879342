// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tagfield/report/summary.h"

namespace tagfield {
namespace {

/// Adds the `fields` of the run's rows to those of the total, which has the same rows.
template <class Row, class... Fields>
void add_rows(std::vector<Row>& total, const std::vector<Row>& run, Fields... fields) {
  for (std::size_t i = 0; i < total.size() && i < run.size(); ++i) {
    ((total[i].*fields += run[i].*fields), ...);
  }
}

template <class Row, class... Fields>
void divide_rows(std::vector<Row>& rows, double by, Fields... fields) {
  for (Row& row : rows) ((row.*fields /= by), ...);
}

void add_zones(std::vector<ZoneInventory>& total, const std::vector<ZoneInventory>& run) {
  add_rows(total, run, &ZoneInventory::read, &ZoneInventory::read_by_own, &ZoneInventory::crossed);
  for (std::size_t i = 0; i < total.size() && i < run.size(); ++i) {
    add_rows(total[i].cross, run[i].cross, &CrossRead::tags, &CrossRead::reads);
  }
}

void add(const InventorySummary& run, InventorySummary& total) {
  total.read += run.read;
  total.reads += run.reads;
  total.min_read = std::min(total.min_read, run.min_read);
  total.max_read = std::max(total.max_read, run.max_read);
  for (auto rows : {&InventorySummary::readers, &InventorySummary::antennas}) {
    add_rows(total.*rows, run.*rows, &InventoryShare::tags, &InventoryShare::only,
             &InventoryShare::reads);
  }
  add_zones(total.zones, run.zones);
  add_rows(total.levels, run.levels, &LevelInventory::read);
}

/// Divides all added values by the number of runs.
void divide(InventorySummary& total, double runs) {
  total.read /= runs;
  total.reads /= runs;
  for (auto rows : {&InventorySummary::readers, &InventorySummary::antennas}) {
    divide_rows(total.*rows, runs, &InventoryShare::tags, &InventoryShare::only,
                &InventoryShare::reads);
  }
  divide_rows(total.zones, runs, &ZoneInventory::read, &ZoneInventory::read_by_own,
              &ZoneInventory::crossed);
  for (ZoneInventory& zone : total.zones) {
    divide_rows(zone.cross, runs, &CrossRead::tags, &CrossRead::reads);
  }
  divide_rows(total.levels, runs, &LevelInventory::read);
}

/// The mean over all runs; none if one of them has none.
std::optional<double> mean_time(const std::vector<InventorySummary>& runs, std::size_t which) {
  double sum = 0.0;
  for (const InventorySummary& run : runs) {
    if (which >= run.reached.size() || !run.reached[which].time_s) return std::nullopt;
    sum += *run.reached[which].time_s;
  }
  return sum / static_cast<double>(runs.size());
}

std::optional<double> mean_of_medians(const std::vector<InventorySummary>& runs) {
  double sum = 0.0;
  double count = 0.0;
  for (const InventorySummary& run : runs) {
    if (!run.median_reads) continue;
    sum += *run.median_reads;
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return sum / count;
}

}  // namespace

InventorySummary mean_of(const std::vector<InventorySummary>& runs) {
  // Sums of counts are exact, so that where each run read all tags their mean is exactly all.
  InventorySummary mean = runs.front();
  for (std::size_t i = 1; i < runs.size(); ++i) add(runs[i], mean);
  divide(mean, static_cast<double>(runs.size()));
  for (std::size_t i = 0; i < mean.reached.size(); ++i) mean.reached[i].time_s = mean_time(runs, i);
  mean.median_reads = mean_of_medians(runs);
  return mean;
}

}  // namespace tagfield
