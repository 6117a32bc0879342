// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/known_world.h"

#include <gtest/gtest.h>

#include "tagfield/channel/radio_world.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

Scenario with_antenna(const Scene& scene, const RadioModel& model) {
  Diagnostics unheard;
  Scenario scenario;
  scenario.radio_world = std::make_shared<const RadioWorld>(radio_world(scene, {}, unheard));
  AntennaSpec antenna;
  antenna.parameters.name = "antenna";
  antenna.parameters.model = std::make_shared<const RadioModel>(model);
  scenario.antennas = {antenna};
  return scenario;
}

TEST(KnownWorld, IsTracedOnlyWhereSomethingReflects) {
  Scene hall;
  hall.collisions.push_back({"wall", Box{{4.0, 0.1, 2.0}}, {}, {}});
  RadioModel model;
  model.reflection_order = 1;
  EXPECT_TRUE(traced_replies(with_antenna(hall, model)));
  EXPECT_FALSE(traced_replies(with_antenna(Scene{}, model)));
  Scenario nowhere = with_antenna(hall, model);
  nowhere.radio_world = nullptr;
  EXPECT_FALSE(traced_replies(nowhere));
  model.effects.reflections = false;
  EXPECT_FALSE(traced_replies(with_antenna(hall, model)));
  model.effects.reflections = true;
  model.reflection_order = 0;
  EXPECT_FALSE(traced_replies(with_antenna(hall, model)));
}

}  // namespace
}  // namespace tagfield
