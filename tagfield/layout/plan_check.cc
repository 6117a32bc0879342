// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan_check.h"

#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "tagfield/base/parallel.h"
#include "tagfield/layout/layout_scenario.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

/// Samples of tags that no forecast takes.
constexpr std::size_t kFirstSample = 1'000'000;

/// Names of zones; "" for none.
struct Zones {
  std::map<std::string, std::string> of_tag;
  std::map<std::string, std::string> of_reader;
};

struct TagCounts {
  double read = -1.0;
  double crossed = -1.0;  ///< By a reader of another zone.
};

class ReadTags final : public ReadListener {
 public:
  explicit ReadTags(const Zones& zones) : zones_(zones) {}
  void on_read(const TagRead& read) override {
    tags_.insert(read.tag);
    const std::string& own = zones_.of_tag.at(read.tag);
    const std::string& readers = zones_.of_reader.at(read.reader);
    if (is_crossing(readers, own)) crossed_.insert(read.tag);
  }
  [[nodiscard]] TagCounts counts() const {
    return {static_cast<double>(tags_.size()), static_cast<double>(crossed_.size())};
  }

 private:
  const Zones& zones_;
  std::set<std::string> tags_;
  std::set<std::string> crossed_;
};

Zones zones_of(const PlanSpec& plan, const PlannedLayout& layout, const std::vector<PlanTag>& tags,
               const Scenario& scenario) {
  Zones zones;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    zones.of_tag[scenario.tags[i].id] = plan.tags[tags[i].group].zone;
  }
  for (const PlannedAntenna& antenna : layout.antennas) {
    zones.of_reader[antenna.reader] = antenna.zone;
  }
  return zones;
}

class Checker {
 public:
  Checker(const ScenarioToPlan& to_plan, const PlannedLayout& layout, std::uint64_t seed,
          const RunControl& control)
      : to_plan_(to_plan), layout_(layout), seed_(seed), control_(control) {}

  [[nodiscard]] bool has_zones() const { return layout_.zones.size() > 1; }

  /// Run number `i`, with all links as much weaker.
  [[nodiscard]] TagCounts run(std::size_t i, double less_db) const {
    const std::size_t sample = kFirstSample + i;
    const Scenario scenario = scenario_of_layout(to_plan_, layout_, seed_, sample, less_db);
    const Zones zones =
        zones_of(to_plan_.plan, layout_, tags_of_sample(to_plan_.plan, seed_, sample), scenario);
    const auto read = std::make_shared<ReadTags>(zones);
    Outlets outlets;
    outlets.reads.push_back(read);
    Simulation simulation(scenario, seed_ + i, outlets);
    while (!simulation.finished() && !stopped(control_)) simulation.step();
    simulation.finish();
    return read->counts();
  }

 private:
  const ScenarioToPlan& to_plan_;
  const PlannedLayout& layout_;
  std::uint64_t seed_;
  const RunControl& control_;
};

bool is_within(const ExpectedCount& range, double count) {
  return count >= range.low && count <= range.high;
}

}  // namespace

PlanCheck check_plan(const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                     std::uint64_t first, std::size_t count, const RunControl& control) {
  const Checker checker(to_plan, layout, first, control);
  const double margin_db = to_plan.plan.margin_db;
  std::vector<TagCounts> counts(count);
  std::mutex mutex;
  std::size_t finished = 0;
  parallel_for(count, control.threads, [&](std::size_t i) {
    if (stopped(control)) return;
    TagCounts of_run = checker.run(i, margin_db);
    if (margin_db > 0.0 && checker.has_zones()) of_run.crossed = checker.run(i, 0.0).crossed;
    const std::lock_guard lock(mutex);
    if (!stopped(control)) counts[i] = of_run;
    if (control.on_progress) {
      control.on_progress(static_cast<double>(++finished) / static_cast<double>(count));
    }
  });
  PlanCheck check;
  for (std::size_t i = 0; i < count; ++i) {
    if (counts[i].read < 0.0) continue;
    check.seeds.push_back(first + i);
    check.read.push_back(counts[i].read);
    if (is_within(layout.read, counts[i].read)) ++check.inside;
    if (!checker.has_zones()) continue;
    check.cross.push_back(counts[i].crossed);
    if (is_within(layout.cross, counts[i].crossed)) ++check.cross_inside;
  }
  return check;
}

}  // namespace tagfield
