// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan_check.h"

#include <memory>
#include <mutex>

#include "tagfield/base/parallel.h"
#include "tagfield/layout/internal/satisfied_tags.h"
#include "tagfield/layout/layout_scenario.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

/// Number of the first sample of tags that no forecast uses.
constexpr std::size_t kFirstSample = 1'000'000;

struct TagCounts {
  double read = -1.0;
  double crossed = -1.0;  ///< By a reader of another zone.
};

CountedRun counted_run(const PlanSpec& plan, const PlannedLayout& layout,
                       const std::vector<PlanTag>& tags, const Scenario& scenario) {
  CountedRun run;
  run.aim = plan.aim;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const TagSpec& tag = scenario.tags[i];
    run.zone_of_tag[tag.id] = plan.tags[tags[i].group].zone;
    run.p_WT[tag.id] = tag.motion.front().X_WB.translation;
  }
  for (const PlannedAntenna& antenna : layout.antennas) {
    run.zone_of_reader[antenna.reader] = antenna.zone;
    run.p_WA[antenna.name] = antenna.p_W;
  }
  for (const AntennaSpec& antenna : scenario.antennas) {
    run.readers[antenna.parameters.name] = physical(antenna.parameters)->hardware;
  }
  return run;
}

class Checker {
 public:
  Checker(const ScenarioToPlan& to_plan, const PlannedLayout& layout, std::uint64_t seed,
          const RunControl& control)
      : to_plan_(to_plan), layout_(layout), seed_(seed), control_(control) {}

  [[nodiscard]] bool has_zones() const { return layout_.zones.size() > 1; }

  /// Run number `i`, with all links weaker by `less_db`.
  [[nodiscard]] TagCounts run(std::size_t i, double less_db) const {
    const std::size_t sample = kFirstSample + i;
    const Scenario scenario = scenario_of_layout(to_plan_, layout_, seed_, sample, less_db);
    const auto counted = std::make_shared<SatisfiedTags>(counted_run(
        to_plan_.plan, layout_, tags_of_sample(to_plan_.plan, seed_, sample), scenario));
    Outlets outlets;
    outlets.reads.push_back(counted);
    Simulation simulation(scenario, seed_ + i, outlets);
    while (!simulation.finished() && !stopped(control_)) simulation.step();
    simulation.finish();
    return {static_cast<double>(counted->satisfied()), static_cast<double>(counted->crossed())};
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
