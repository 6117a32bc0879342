// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/tracing_forecast.h"

#include <gtest/gtest.h>

#include <string>

#include "tagfield/channel/radio_world.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

/// A hall with `boxes` boxes, and a robot that drives 10 m in it.
Scenario hall_with(int boxes, int order) {
  Scene scene;
  scene.collisions.push_back({"floor", Plane{}, {}, {}});
  for (int i = 0; i < boxes; ++i) {
    const Eigen::Vector3d p_WB(3.0 + 1.5 * (i % 40), 3.0 + 1.5 * (i / 40), 0.5);
    scene.collisions.push_back(
        {"box" + std::to_string(i), Box{Eigen::Vector3d::Ones()}, from_translation(p_WB), {}});
  }
  Diagnostics unheard;
  Scenario scenario;
  scenario.radio_world = std::make_shared<const RadioWorld>(radio_world(scene, {}, unheard));
  RobotSpec robot;
  robot.name = "robot";
  robot.waypoints = {{10.0, 0.0}};
  scenario.robots = {robot};
  RadioModel model;
  model.reflection_order = order;
  AntennaSpec antenna;
  antenna.parameters.name = "mobile";
  antenna.parameters.model = std::make_shared<const RadioModel>(model);
  antenna.on = "robot";
  antenna.X_PA = from_translation({0.0, 0.0, 1.0});
  scenario.antennas = {antenna};
  TagSpec tag;
  tag.id = "tag";
  tag.motion = {{Time{}, from_translation({2.0, 2.0, 1.0})}};
  scenario.tags = {tag};
  return scenario;
}

TEST(TracingForecast, IsOfMovingAntennasThatMeetReflectionsAlone) {
  EXPECT_TRUE(tracing_forecast(hall_with(4, 1), 1));
  EXPECT_FALSE(tracing_forecast(hall_with(4, 0), 1));
  Scenario fixed = hall_with(4, 1);
  fixed.antennas[0].on = "";
  EXPECT_FALSE(tracing_forecast(fixed, 1));
  Scenario empty = hall_with(4, 1);
  empty.radio_world = nullptr;
  EXPECT_FALSE(tracing_forecast(empty, 1));
}

TEST(TracingForecast, IsMeasuredWhereThatIsQuick) {
  const Scenario scenario = hall_with(40, 2);
  for (const int order : {0, 1, 2}) {
    const auto forecast = tracing_forecast(scenario, order);
    EXPECT_EQ(forecast->order, order);
    EXPECT_TRUE(forecast->is_measured);
    EXPECT_GT(forecast->seconds, 0.0);
  }
}

TEST(TracingForecast, FewTagsAtRestKeepTheirImages) {
  Scenario scenario = hall_with(4, 2);
  EXPECT_TRUE(tags_keep_images(scenario));
  scenario.tags.resize(64, scenario.tags[0]);
  EXPECT_TRUE(tags_keep_images(scenario));
  scenario.tags.resize(65, scenario.tags[0]);
  EXPECT_FALSE(tags_keep_images(scenario));
  EXPECT_TRUE(tracing_forecast(scenario, 2)->is_measured);
  scenario.tags.resize(1);
  scenario.tags[0].on = "robot";
  EXPECT_FALSE(tags_keep_images(scenario));
}

TEST(TracingForecast, LongRunsAreWarnedOfWithAnOrderThatFits) {
  Diagnostics diagnostics;
  warn_of_long_tracing(hall_with(4, 1), diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  Scenario scenario = hall_with(800, 3);
  scenario.duration_s = 10'000'000.0;
  warn_of_long_tracing(scenario, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(diagnostics.warnings()[0].find("tracing reflections of order 3 among"),
            std::string::npos);
  EXPECT_NE(diagnostics.warnings()[0].find("; reflection_order "), std::string::npos)
      << diagnostics.warnings()[0];
}

}  // namespace
}  // namespace tagfield
