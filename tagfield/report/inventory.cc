// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tagfield/report/summary.h"

namespace tagfield {
namespace {

/// Adds the weighted `fields` of the run's rows to those of the mean, which has the same rows.
template <class Row, class... Fields>
void add_rows(std::vector<Row>& mean, const std::vector<Row>& run, double weight,
              Fields... fields) {
  for (std::size_t i = 0; i < mean.size() && i < run.size(); ++i) {
    ((mean[i].*fields += weight * (run[i].*fields)), ...);
  }
}

template <class Row, class... Fields>
void clear_rows(std::vector<Row>& rows, Fields... fields) {
  for (Row& row : rows) ((row.*fields = 0.0), ...);
}

void add_zones(std::vector<ZoneInventory>& mean, const std::vector<ZoneInventory>& run,
               double weight) {
  add_rows(mean, run, weight, &ZoneInventory::read, &ZoneInventory::read_by_own,
           &ZoneInventory::crossed);
  for (std::size_t i = 0; i < mean.size() && i < run.size(); ++i) {
    add_rows(mean[i].cross, run[i].cross, weight, &CrossRead::tags, &CrossRead::reads);
  }
}

void add(const InventorySummary& run, double weight, InventorySummary& mean) {
  mean.read += weight * run.read;
  mean.reads += weight * run.reads;
  mean.min_read = std::min(mean.min_read, run.min_read);
  mean.max_read = std::max(mean.max_read, run.max_read);
  for (auto rows : {&InventorySummary::readers, &InventorySummary::antennas}) {
    add_rows(mean.*rows, run.*rows, weight, &InventoryShare::tags, &InventoryShare::only,
             &InventoryShare::reads);
  }
  add_zones(mean.zones, run.zones, weight);
  add_rows(mean.levels, run.levels, weight, &LevelInventory::read);
}

/// The first run's summary, with all averaged values set to 0.
InventorySummary cleared(InventorySummary first) {
  first.read = first.reads = 0.0;
  for (auto rows : {&InventorySummary::readers, &InventorySummary::antennas}) {
    clear_rows(first.*rows, &InventoryShare::tags, &InventoryShare::only, &InventoryShare::reads);
  }
  clear_rows(first.zones, &ZoneInventory::read, &ZoneInventory::read_by_own,
             &ZoneInventory::crossed);
  for (ZoneInventory& zone : first.zones) {
    clear_rows(zone.cross, &CrossRead::tags, &CrossRead::reads);
  }
  clear_rows(first.levels, &LevelInventory::read);
  return first;
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

double share_of(double part, std::size_t tags) {
  return tags == 0 ? 0.0 : part / static_cast<double>(tags);
}

InventorySummary mean_of(const std::vector<InventorySummary>& runs) {
  InventorySummary mean = cleared(runs.front());
  for (const InventorySummary& run : runs) add(run, 1.0 / static_cast<double>(runs.size()), mean);
  for (std::size_t i = 0; i < mean.reached.size(); ++i) mean.reached[i].time_s = mean_time(runs, i);
  mean.median_reads = mean_of_medians(runs);
  return mean;
}

}  // namespace tagfield
