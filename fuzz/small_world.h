// SPDX-License-Identifier: Apache-2.0
/// @file
/// A small live world, for interfaces to one.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "tagfield/live/live_world.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield::fuzz {

/// Two antennas of one reader in front of three tags, with Gen2.
inline Scenario small_hall() {
  Scenario scenario;
  scenario.name = "hall";
  auto model = std::make_shared<RadioModel>();
  model->plan = fixed_plan(866e6);
  for (const double y : {0.0, 0.5}) {
    AntennaSpec antenna;
    antenna.parameters.name = y > 0.0 ? "left" : "right";
    antenna.parameters.reader = "gate";
    antenna.parameters.model = model;
    antenna.X_PA = from_translation({0.0, y, 1.0});
    scenario.antennas.push_back(antenna);
  }
  for (const double y : {-0.5, 0.0, 0.5}) {
    TagSpec tag;
    tag.id = "3034000000000000000000" + std::string(y < 0.0 ? "01" : y > 0.0 ? "02" : "03");
    tag.motion = {{Time{}, from_translation({1.0, y, 1.0})}};
    scenario.tags.push_back(tag);
  }
  return scenario;
}

/// Advances the world by several steps at a time.
class Steps final : public LiveMember {
 public:
  void go_on(LiveWorld& world, int steps) {
    left_ = steps;
    stop_ = false;
    world.run(stop_);
  }
  void on_step(LiveWorld& /*world*/, Time /*now*/) override {
    if (--left_ <= 0) stop_ = true;
  }

 private:
  int left_ = 0;
  std::atomic<bool> stop_{false};
};

}  // namespace tagfield::fuzz
