// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/seeds.h"

#include <gtest/gtest.h>

#include "made_reads.h"

namespace tagfield {
namespace {

/// Distances [m] to a tag straight ahead of a path of 4 m, with an error added to the middle one.
PhaseSegment straight_ahead(double error_m) {
  PhaseSegment segment;
  const made::Path path = made::straight(4.0, 0.5);
  for (std::size_t i = 0; i < path.size(); ++i) {
    PhaseSample sample;
    sample.p_WA = path[i];
    segment.samples.push_back(sample);
    const Eigen::Vector3d p_WT(9.0, 1.0, 0.4);
    segment.distance_m.push_back((p_WT - path[i]).norm() - (p_WT - path[0]).norm());
  }
  segment.distance_m[path.size() / 2] += error_m;
  return segment;
}

/// A distance cannot change by more than the antenna moved: noise that claims so makes a conic
/// without points.
TEST(Seeds, EmptyConicsAreLeftOut) {
  const auto count = [](double error_m) {
    std::size_t conics = 0;
    for (const ConicGroup& group : make_conics({straight_ahead(error_m)}, 0.45, 100)) {
      for (const Conic& conic : group) EXPECT_TRUE(is_usable(conic));
      conics += group.size();
    }
    return conics;
  };
  EXPECT_EQ(count(0.0), 8u);
  EXPECT_EQ(count(-0.2), 7u);
}

}  // namespace
}  // namespace tagfield
