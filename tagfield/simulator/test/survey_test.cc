// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/survey.h"

#include <gtest/gtest.h>

#include "tagfield/map/true_map.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/simulator/test/small_world.h"

namespace tagfield {
namespace {

struct Made {
  NavigationWorld world;
  Survey survey;
};

Made survey_with(Scenario scenario, const std::atomic<bool>* stop = nullptr) {
  own_navigation(scenario).mapper.particles = 3;
  Diagnostics diagnostics;
  Made made{navigation_world(scenario, small_room(), diagnostics), {}};
  made.survey = survey(navigation_of(scenario), made.world, scenario.robots[0],
                       scenario.time_step_s, scenario.seed, 1, stop, nullptr);
  return made;
}

TEST(Survey, MapsARoomAndComesBack) {
  const Made made = survey_with(small_drive());
  EXPECT_TRUE(made.survey.complete);
  const MapComparison map = compare_maps(made.survey.map, made.world.true_map);
  EXPECT_GT(map.found_share, 0.97);
  EXPECT_LT(map.false_share, 0.03);
  EXPECT_GT(map.known_share, 0.97);
  EXPECT_LT(position_of(made.survey.true_end_W).norm(), 0.15);
  EXPECT_LT((position_of(made.survey.end.pose_M) - position_of(made.survey.true_end_W)).norm(),
            0.05);
  // A sample every 0.1 s, and a path as long as the sum of its segments.
  ASSERT_EQ(made.survey.true_path.size(), made.survey.believed_path.size());
  double way_m = 0.0;
  for (std::size_t i = 1; i < made.survey.true_path.size(); ++i) {
    const StampedPose& here = made.survey.true_path[i];
    EXPECT_NEAR(to_seconds(here.stamp - made.survey.true_path[i - 1].stamp), 0.1, 0.021);
    way_m += (here.X_WB.translation - made.survey.true_path[i - 1].X_WB.translation).norm();
    const PlanarPose pose{here.X_WB.translation.x(), here.X_WB.translation.y(),
                          yaw_of(here.X_WB.rotation)};
    EXPECT_GT(made.world.clearance.distance(pose, {}), 0.0);
  }
  EXPECT_NEAR(made.survey.path_length_m, way_m, 0.1);
}

TEST(Survey, EndsAtItsLimit) {
  Scenario scenario = small_drive();
  own_navigation(scenario).mapping_limit_s = 2.0;
  const Made made = survey_with(scenario);
  EXPECT_FALSE(made.survey.complete);
  EXPECT_NEAR(made.survey.simulated_s, 2.0, 0.021);
}

TEST(Survey, EndsWhenStopped) {
  const std::atomic<bool> stop{true};
  const Made made = survey_with(small_drive(), &stop);
  EXPECT_FALSE(made.survey.complete);
  EXPECT_EQ(made.survey.simulated_s, 0.0);
}

}  // namespace
}  // namespace tagfield
