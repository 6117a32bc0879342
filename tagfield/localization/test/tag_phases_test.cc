// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/tag_phases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

/// Compared with the reflection across a line with normal n: p − 2 (n · (p − q)) n, q on the line.
TEST(MirrorImage, LiesAcrossThePathWhicheverWayThatGoes) {
  const Eigen::Vector2d p(-0.7, 2.9);
  const Eigen::Vector2d q(1.5, 0.4);
  for (double heading = -1.5; heading < 1.6; heading += 0.31) {
    TagPhases phases;
    resize(phases, 9);
    for (Eigen::Index i = 0; i < 9; ++i) {
      const double along = 0.2 * std::pow(static_cast<double>(i), 1.3);
      phases.x[i] = q.x() + along * std::cos(heading);
      phases.y[i] = q.y() + along * std::sin(heading);
    }
    const Eigen::Vector2d n(-std::sin(heading), std::cos(heading));
    const Eigen::Vector2d expected = p - 2.0 * n.dot(p - q) * n;
    EXPECT_NEAR((mirror_image(phases, p) - expected).norm(), 0.0, 1e-12) << heading;
  }
}

}  // namespace
}  // namespace tagfield
