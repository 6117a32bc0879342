#include "tagfield/propagation/trace_paths.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

std::vector<RadioPath> paths_between(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                                     const Eigen::Vector3d& p_WT, const TraceOptions& options) {
  std::vector<RadioPath> paths;
  trace_paths(scene, images_of(scene, p_WA, options), p_WT, options, paths);
  return paths;
}

TEST(TracePaths, OverAFloorThereIsTheMirrorPoint) {
  Scene scene;
  scene.collisions = {{"floor", Plane{}, {}}};
  TraceOptions options;
  options.order = 3;
  const auto paths = paths_between(RadioScene(scene), {0.0, 0.0, 1.0}, {4.0, 0.0, 2.0}, options);
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_NEAR(paths[0].length_m, std::sqrt(17.0), 1e-12);
  EXPECT_NEAR(paths[1].length_m, 5.0, 1e-12);
  EXPECT_TRUE(paths[1].bounces[0].p_W.isApprox(Eigen::Vector3d(4.0 / 3.0, 0.0, 0.0), 1e-12));
}

}  // namespace
}  // namespace tagfield
