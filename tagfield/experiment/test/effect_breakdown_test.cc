// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/effect_breakdown.h"

#include <gtest/gtest.h>

#include <set>

#include "tagfield/base/units.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

/// A robot that passes three tags in free space, with all effects that need no world.
Scenario passing_tags() {
  Scenario scenario;
  scenario.name = "passing";
  scenario.duration_s = 20.0;
  RobotSpec robot;
  robot.name = "robot";
  robot.start = {-2.5, 0.0, 0.0};
  robot.waypoints = {{2.5, 0.0}, {2.5, 0.8}, {0.0, 0.8}};
  scenario.robots = {robot};
  RadioModel model;
  model.antenna.gain_dbi = 6.0;
  model.antenna.polarization = PolarizationKind::kRightCircular;
  model.plan = known_plan("etsi_low");
  model.gen2 = Gen2Reader{};
  model.gen2->inventory.target = Target::kAlternate;
  AntennaSpec antenna;
  antenna.parameters.name = "mobile";
  antenna.parameters.model = std::make_shared<const RadioModel>(model);
  antenna.on = "robot";
  antenna.X_PA = from_xyz_rpy({0, 0, 1.0}, {0, 0, kPi / 2});
  scenario.antennas = {antenna};
  for (int i = 0; i < 3; ++i) {
    TagSpec tag;
    tag.id = "tag" + std::to_string(i);
    tag.motion = {{Time{}, from_translation({0.8 * i - 0.8, 2.5, 1.2})}};
    scenario.tags.push_back(tag);
  }
  return scenario;
}

TEST(EffectsIn, AreThoseThatDoAnything) {
  std::set<std::string> names;
  for (const EffectSwitch& effect : effects_in(passing_tags())) names.insert(effect.name);
  EXPECT_EQ(names,
            (std::set<std::string>{"patterns", "polarization", "occlusion", "noise", "quantization",
                                   "hopping", "phase_offsets", "pi_ambiguity", "inventory"}));
  Scenario beside = passing_tags();
  auto model = std::make_shared<RadioModel>(*physical(beside.antennas[0].parameters));
  model->interference = model->tag_coupling = true;
  beside.antennas[0].parameters.model = std::shared_ptr<const RadioModel>(model);
  for (const EffectSwitch& effect : effects_in(beside)) names.erase(effect.name);
  EXPECT_TRUE(names.empty());
  EXPECT_EQ(effects_in(beside).size(), effects_in(passing_tags()).size() + 2);
  Scenario paper = passing_tags();
  paper.antennas[0].parameters.model = PaperAntenna{};
  EXPECT_TRUE(effects_in(paper).empty());
}

TEST(WithEffects, TurnsOffWhatIsNotWantedAndOnNothing) {
  Scenario scenario = passing_tags();
  auto model = std::make_shared<RadioModel>(*physical(scenario.antennas[0].parameters));
  model->effects.hopping = false;
  scenario.antennas[0].parameters.model = std::shared_ptr<const RadioModel>(model);
  RadioEffects wanted = no_effects();
  wanted.noise = wanted.hopping = true;
  const RadioEffects got = physical(with_effects(scenario, wanted).antennas[0].parameters)->effects;
  EXPECT_TRUE(got.noise);
  EXPECT_FALSE(got.hopping);
  EXPECT_FALSE(got.patterns);
}

TEST(BreakDown, HasARowForNoneEachAloneAllButEachAndAll) {
  Diagnostics diagnostics;
  const Scenario scenario = passing_tags();
  const auto costs = break_down(scenario, 1, 1, {}, diagnostics);
  ASSERT_EQ(costs.size(), 2 * effects_in(scenario).size() + 2);
  EXPECT_EQ(costs.front().set, EffectSet::kNone);
  EXPECT_EQ(costs.back().set, EffectSet::kAll);
  // Without any effect the phase is exact, and so are the positions, up to the fit's rounding.
  EXPECT_EQ(costs.front().located, 3U);
  ASSERT_TRUE(costs.front().error_m);
  EXPECT_LT(costs.front().error_m->max, 1e-4);
  // With all effects it is the scenario itself.
  const auto runs = run_seeds(scenario, 1, 1, {}, diagnostics);
  EXPECT_EQ(costs.back().reads, runs.front().recording.reads.size());
}

TEST(BreakDown, NoiseAloneCostsMoreThanNothing) {
  Diagnostics diagnostics;
  const auto costs = break_down(passing_tags(), 1, 1, {}, diagnostics);
  for (const EffectCost& cost : costs) {
    if (cost.effect != "receiver's noise" || cost.set != EffectSet::kAlone) continue;
    ASSERT_TRUE(cost.error_m);
    EXPECT_GT(cost.error_m->mean, costs.front().error_m->mean);
    EXPECT_LT(cost.error_m->mean, 0.05);
  }
}

}  // namespace
}  // namespace tagfield
