// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/effect_breakdown.h"

#include <algorithm>

namespace tagfield {
namespace {

/// Whether the effect changes anything for this antenna.
bool acts(const RadioModel& model, const EffectSwitch& effect) {
  if (!(model.effects.*effect.on)) return false;
  if (effect.on == &RadioEffects::reflections) return model.reflection_order > 0;
  if (effect.on == &RadioEffects::diffraction) return model.diffraction;
  if (effect.on == &RadioEffects::interference) return model.interference;
  if (effect.on == &RadioEffects::coupling) return model.tag_coupling;
  if (effect.on == &RadioEffects::diffuse) return model.diffuse_k_db.has_value();
  if (effect.on == &RadioEffects::inventory) return model.gen2.has_value();
  if (effect.on == &RadioEffects::hopping) return model.plan.carriers_hz.size() > 1;
  return true;
}

EffectCost cost_of(const std::vector<SeedRun>& runs) {
  EffectCost cost;
  std::vector<double> errors;
  for (const SeedRun& run : runs) {
    for (const TagOutcome& outcome : run.outcomes) {
      cost.reads += outcome.reads;
      if (outcome.reference) continue;
      ++cost.tags;
      if (outcome.estimate.verdict == Verdict::kLocated) ++cost.located;
      if (const auto error = error_of(outcome)) errors.push_back(*error);
    }
  }
  cost.error_m = statistics(errors);
  return cost;
}

/// One row to fill in.
struct Variant {
  std::string effect;
  EffectSet set = EffectSet::kNone;
  RadioEffects effects;
};

std::vector<Variant> variants_of(const Scenario& scenario) {
  const std::vector<EffectSwitch> present = effects_in(scenario);
  std::vector<Variant> variants = {{"", EffectSet::kNone, no_effects()}};
  for (const EffectSwitch& effect : present) {
    RadioEffects alone = no_effects();
    alone.*effect.on = true;
    variants.push_back({effect.what, EffectSet::kAlone, alone});
  }
  for (const EffectSwitch& effect : present) {
    RadioEffects others;
    others.*effect.on = false;
    variants.push_back({effect.what, EffectSet::kAllButThis, others});
  }
  variants.push_back({"", EffectSet::kAll, {}});
  return variants;
}

}  // namespace

Scenario with_effects(const Scenario& scenario, const RadioEffects& effects) {
  Scenario changed = scenario;
  for (AntennaSpec& antenna : changed.antennas) {
    const RadioModel* const given = physical(antenna.parameters);
    if (given == nullptr) continue;
    auto model = std::make_shared<RadioModel>(*given);
    for (const EffectSwitch& effect : kEffectSwitches) {
      model->effects.*effect.on = model->effects.*effect.on && effects.*effect.on;
    }
    antenna.parameters.model = std::shared_ptr<const RadioModel>(std::move(model));
  }
  return changed;
}

std::vector<EffectSwitch> effects_in(const Scenario& scenario) {
  std::vector<EffectSwitch> present;
  for (const EffectSwitch& effect : kEffectSwitches) {
    const bool any = std::any_of(scenario.antennas.begin(), scenario.antennas.end(),
                                 [&](const AntennaSpec& antenna) {
                                   const RadioModel* const model = physical(antenna.parameters);
                                   return model != nullptr && acts(*model, effect);
                                 });
    const bool has_bodies =
        std::any_of(scenario.robots.begin(), scenario.robots.end(),
                    [](const RobotSpec& robot) { return robot.body.has_value(); }) ||
        std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(),
                    [](const ObstacleSpec& obstacle) { return obstacle.body.has_value(); });
    if (effect.on == &RadioEffects::bodies && !has_bodies) continue;
    if (any) present.push_back(effect);
  }
  return present;
}

std::vector<EffectCost> break_down(const Scenario& scenario, std::uint64_t first, std::size_t seeds,
                                   const RunControl& control, Diagnostics& diagnostics,
                                   const NavigationWorld* world) {
  std::vector<EffectCost> costs;
  if (effects_in(scenario).empty()) return costs;
  const std::vector<Variant> variants = variants_of(scenario);
  Scenario alone = scenario;  // Costs are for one method only.
  alone.localization.compare.clear();
  RunControl of_one = control;
  for (const Variant& variant : variants) {
    if (control.stop != nullptr && *control.stop) break;
    const auto done = static_cast<double>(costs.size());
    const auto all = static_cast<double>(variants.size());
    if (control.on_progress) {
      of_one.on_progress = [&](double share) { control.on_progress((done + share) / all); };
    }
    const auto runs =
        run_seeds(with_effects(alone, variant.effects), first, seeds, of_one, diagnostics, world);
    costs.push_back(cost_of(runs));
    costs.back().effect = variant.effect;
    costs.back().set = variant.set;
  }
  return costs;
}

}  // namespace tagfield
