// What is drawn for one filter depends on its own seed alone, although MRPT has one generator for
// the whole process.

#include <gtest/gtest.h>

#include <vector>

#include "tagfield/map/true_map.h"
#include "tagfield/navigation/monte_carlo_localizer.h"
#include "tagfield/navigation/test/room.h"

namespace tagfield {
namespace {

MonteCarloLocalizer localizer_from(const PlanarPose& start, std::uint64_t seed) {
  LocalizerSettings settings;
  settings.beams = 30;
  MonteCarloLocalizer localizer(true_map(room(), 0.31, {0.0, 0.0}, 0.05), settings,
                                LaserParameters{}.X_RL, seed);
  localizer.start_at({start, Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal()});
  return localizer;
}

struct Look {
  LaserScan scan;
  PlanarPose odometry;
};

std::vector<Look> looks() {
  std::vector<Look> all;
  int count = 0;
  const Drive ahead{{-1.0, -1.0, 0.0}, {{{0.3, 0.25}, 8.0}}};
  sense(room(), ahead, {}, 5, [&](const LaserScan& scan, const PlanarPose& odometry, PlanarPose) {
    if (count++ % 12 == 0) all.push_back({scan, odometry});
  });
  return all;
}

/// Particles after all looks; `others` filters of other seeds take theirs in between.
std::vector<PlanarPose> particles_among(int others) {
  MonteCarloLocalizer one = localizer_from({-1.0, -1.0, 0.0}, 1);
  std::vector<MonteCarloLocalizer> rest;
  for (int i = 0; i < others; ++i) {
    rest.push_back(localizer_from({-1.0, -1.0 + 0.1 * i, 0.0}, 2 + static_cast<std::uint64_t>(i)));
  }
  for (const Look& look : looks()) {
    one.update(look.scan, look.odometry);
    for (MonteCarloLocalizer& other : rest) other.update(look.scan, look.odometry);
  }
  return one.particles();
}

TEST(MrptRandom, OtherFiltersChangeNothing) {
  const std::vector<PlanarPose> alone = particles_among(0);
  for (const int others : {0, 1, 3}) {
    const std::vector<PlanarPose> among = particles_among(others);
    ASSERT_EQ(among.size(), alone.size()) << others;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      ASSERT_EQ(among[i].x, alone[i].x) << others;
      ASSERT_EQ(among[i].yaw, alone[i].yaw) << others;
    }
  }
}

}  // namespace
}  // namespace tagfield
