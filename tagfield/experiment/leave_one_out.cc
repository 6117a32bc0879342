// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/leave_one_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "tagfield/base/parallel.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/wildcard.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

/// Counts the tags read, and keeps nothing else of a run.
class TagCounter final : public ReadListener {
 public:
  void on_read(const TagRead& read) override { tags_.insert(read.tag); }
  [[nodiscard]] std::size_t count() const { return tags_.size(); }

 private:
  std::set<std::string> tags_;
};

std::size_t tags_read(const Scenario& scenario, std::uint64_t seed, const RunControl& control) {
  const auto counter = std::make_shared<TagCounter>();
  Outlets outlets;
  outlets.reads.push_back(counter);
  Simulation simulation(scenario, seed, outlets);
  while (!simulation.finished() && !stopped(control)) simulation.step();
  simulation.finish();
  return counter->count();
}

}  // namespace

void take_antennas_away(const std::vector<std::string>& patterns, Scenario& scenario) {
  for (const std::string& pattern : patterns) {
    const auto goes = [&](const AntennaSpec& antenna) {
      return matches(pattern, antenna.parameters.name);
    };
    std::vector<std::string> names;
    for (const AntennaSpec& antenna : scenario.antennas) names.push_back(antenna.parameters.name);
    auto& all = scenario.antennas;
    const std::size_t before = all.size();
    all.erase(std::remove_if(all.begin(), all.end(), goes), all.end());
    if (all.size() == before) {
      throw Error(fmt::format("--without {}: no antenna has this name{}", pattern,
                              suggestion(pattern, names)));
    }
    if (all.empty()) throw Error(fmt::format("--without {}: no antenna is left", pattern));
  }
}

std::vector<InventoryWithout> leave_one_out(const Scenario& scenario, std::uint64_t first,
                                            std::size_t count, const RunControl& control) {
  if (scenario.pose.source == PoseSource::kSlam) {
    throw Error("--leave-one-out can't be used with robots that navigate by themselves");
  }
  const std::size_t antennas = scenario.antennas.size();
  if (antennas < 2) return {};
  std::vector<double> read(antennas * count, -1.0);
  std::mutex mutex;
  std::size_t finished = 0;
  parallel_for(read.size(), control.threads, [&](std::size_t i) {
    if (stopped(control)) return;
    Scenario rest = scenario;
    rest.antennas.erase(rest.antennas.begin() + static_cast<std::ptrdiff_t>(i / count));
    const std::size_t tags = tags_read(rest, first + i % count, control);
    const std::lock_guard lock(mutex);
    if (!stopped(control)) read[i] = static_cast<double>(tags);
    if (control.on_progress) {
      control.on_progress(static_cast<double>(++finished) / static_cast<double>(read.size()));
    }
  });
  std::vector<InventoryWithout> rows;
  for (std::size_t antenna = 0; antenna < antennas; ++antenna) {
    InventoryWithout row{scenario.antennas[antenna].parameters.name};
    bool is_whole = true;
    for (std::size_t seed = 0; seed < count; ++seed) {
      const double tags = read[antenna * count + seed];
      is_whole = is_whole && tags >= 0.0;
      row.read += tags / static_cast<double>(count);
    }
    if (is_whole) rows.push_back(row);
  }
  return rows;
}

}  // namespace tagfield
