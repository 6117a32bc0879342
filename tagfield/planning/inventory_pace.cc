#include "tagfield/planning/inventory_pace.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/time.h"
#include "tagfield/gen2/inventory.h"

namespace tagfield {
namespace {

constexpr std::size_t kSteps = 40;
/// Of few tags the slots' luck matters: so many runs are averaged, fewer of many tags.
constexpr std::size_t kRuns = 24;

/// When each tag was first read [s], rising.
std::vector<double> first_reads(const Gen2Reader& gen2, std::size_t tags, double most_s,
                                std::uint64_t seed) {
  TagMemories memories;
  Inventory inventory(gen2.link, gen2.inventory, memories, seed, tags);
  std::vector<TagOnAir> field;
  for (std::size_t tag = 0; tag < tags; ++tag) {
    field.push_back({static_cast<std::uint32_t>(tag), -50.0, 1.0});
  }
  const Time begin{};
  inventory.set_field(begin, field);
  inventory.start(begin);
  std::vector<Singulation> read;
  inventory.run_until(begin + duration_from_seconds(most_s), read);
  std::vector<char> seen(tags, 0);
  std::vector<double> firsts;
  for (const Singulation& one : read) {
    if (seen[one.tag] == 0) firsts.push_back(to_seconds(one.stamp));
    seen[one.tag] = 1;
  }
  return firsts;
}

}  // namespace

InventoryPace::InventoryPace(const Gen2Reader& gen2, double most_s, std::size_t most_tags,
                             std::uint64_t seed)
    : step_s_(most_s / static_cast<double>(kSteps)) {
  double next = 1.0;
  for (std::size_t tags = 1;; tags = static_cast<std::size_t>(std::ceil(next))) {
    Row row{static_cast<double>(tags), std::vector<double>(kSteps + 1, 0.0)};
    const std::size_t runs = std::max<std::size_t>(1, kRuns / std::max<std::size_t>(1, tags / 16));
    for (std::size_t run = 0; run < runs; ++run) {
      for (const double first_s : first_reads(gen2, tags, most_s, seed + run)) {
        const auto step = static_cast<std::size_t>(std::ceil(first_s / step_s_));
        for (std::size_t i = step; i <= kSteps; ++i) row.read[i] += 1.0 / static_cast<double>(runs);
      }
    }
    rows_.push_back(std::move(row));
    if (tags >= most_tags) return;
    while (std::ceil(next) <= static_cast<double>(tags)) next *= std::sqrt(2.0);
  }
}

double InventoryPace::read_of(const Row& row, double time_s) const {
  const double at = std::clamp(time_s / step_s_, 0.0, static_cast<double>(kSteps));
  const auto low = static_cast<std::size_t>(at);
  if (low >= kSteps) return row.read.back();
  const double part = at - static_cast<double>(low);
  return (1.0 - part) * row.read[low] + part * row.read[low + 1];
}

double InventoryPace::read(double tags, double time_s) const {
  if (!(tags > 0.0)) return 0.0;
  if (tags <= rows_.front().tags) return tags * read_of(rows_.front(), time_s);
  for (std::size_t i = 1; i < rows_.size(); ++i) {
    if (tags > rows_[i].tags) continue;
    const double part = (tags - rows_[i - 1].tags) / (rows_[i].tags - rows_[i - 1].tags);
    return (1.0 - part) * read_of(rows_[i - 1], time_s) + part * read_of(rows_[i], time_s);
  }
  return read_of(rows_.back(), time_s);
}

}  // namespace tagfield
