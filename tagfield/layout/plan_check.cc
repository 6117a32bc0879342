// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan_check.h"

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

class ReadTags final : public ReadListener {
 public:
  void on_read(const TagRead& read) override { tags_.insert(read.tag); }
  [[nodiscard]] std::size_t count() const { return tags_.size(); }

 private:
  std::set<std::string> tags_;
};

double tags_read(const Scenario& scenario, std::uint64_t seed, const RunControl& control) {
  const auto read = std::make_shared<ReadTags>();
  Outlets outlets;
  outlets.reads.push_back(read);
  Simulation simulation(scenario, seed, outlets);
  while (!simulation.finished() && !stopped(control)) simulation.step();
  simulation.finish();
  return static_cast<double>(read->count());
}

}  // namespace

PlanCheck check_plan(const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                     std::uint64_t first, std::size_t count, const RunControl& control) {
  std::vector<double> read(count, -1.0);
  std::mutex mutex;
  std::size_t finished = 0;
  parallel_for(count, control.threads, [&](std::size_t i) {
    if (stopped(control)) return;
    const Scenario scenario =
        scenario_of_layout(to_plan, layout, first, kFirstSample + i, to_plan.plan.margin_db);
    const double tags = tags_read(scenario, first + i, control);
    const std::lock_guard lock(mutex);
    if (!stopped(control)) read[i] = tags;
    if (control.on_progress) {
      control.on_progress(static_cast<double>(++finished) / static_cast<double>(count));
    }
  });
  PlanCheck check;
  for (std::size_t i = 0; i < count; ++i) {
    if (read[i] < 0.0) continue;
    check.seeds.push_back(first + i);
    check.read.push_back(read[i]);
    if (read[i] >= layout.read.low && read[i] <= layout.read.high) ++check.inside;
  }
  return check;
}

}  // namespace tagfield
