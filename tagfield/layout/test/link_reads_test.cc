// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/internal/link_reads.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/planning/local_link.h"

namespace tagfield {
namespace {

RadioModel model_in(Session session) {
  RadioModel model;
  model.plan = known_plan("fcc");
  model.gen2.emplace();
  model.gen2->inventory.session = session;
  return model;
}

TEST(LinkReads, ATagWhoseFlagLastsIsReadOnceInThatTime) {
  // Turns of 0.2 s every 0.8 s. In S1 a flag lasts 2 s, with or without power: a read in every
  // third turn, in 7 turns of 20. In S2 it lasts 10 s without power, and power returns before that.
  EXPECT_DOUBLE_EQ(reads_a_turn(model_in(Session::kS1), 15.0, 4, 1), 7.0 / 20.0);
  EXPECT_DOUBLE_EQ(reads_a_turn(model_in(Session::kS2), 15.0, 4, 1), 1.0 / 20.0);
  // In S0 once each time that power returns.
  EXPECT_DOUBLE_EQ(reads_a_turn(model_in(Session::kS0), 15.0, 4, 1), 1.0);
}

TEST(LinkReads, ManyTagsShareTheSlotsThatThereAre) {
  const RadioModel model = model_in(Session::kS0);
  const double of_500 = 500.0 * reads_a_turn(model, 15.0, 4, 500);
  const double of_1000 = 1000.0 * reads_a_turn(model, 15.0, 4, 1000);
  EXPECT_LT(of_500, 250.0);  // Turns of 0.2 s, at far less than a tag per millisecond.
  EXPECT_NEAR(of_1000 / of_500, 1.0, 0.25);
}

TEST(LinkReads, WithoutAnInventoryEachUpdateReads) {
  RadioModel model = model_in(Session::kS1);
  model.gen2.reset();
  // Reads per second: its rate, whatever the other ports do.
  for (const std::size_t ports : {std::size_t{1}, std::size_t{4}}) {
    const double turns = 1.0 / (0.2 * static_cast<double>(ports));
    EXPECT_NEAR(turns * reads_a_turn(model, 15.0, ports, 100), 15.0, 1e-9);
  }
}

/// √tr of the inverse information of x and y, with an unknown offset for each antenna, computed
/// directly.
double plainly(const std::vector<Eigen::Vector3d>& antennas, const Eigen::Vector3d& p_WT,
               const std::vector<double>& carriers_hz, double sigma_rad) {
  const auto count = static_cast<Eigen::Index>(antennas.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 + count, 2 + count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const Eigen::Vector3d way = p_WT - antennas[static_cast<std::size_t>(a)];
    for (const double carrier : carriers_hz) {
      Eigen::VectorXd slope = Eigen::VectorXd::Zero(2 + count);
      slope.head<2>() = 4.0 * kPi * carrier / kSpeedOfLight * way.head<2>() / way.norm();
      slope[2 + a] = 1.0;
      J += slope * slope.transpose() / (sigma_rad * sigma_rad);
    }
  }
  return std::sqrt(J.inverse().topLeftCorner<2, 2>().trace());
}

TEST(LinkReads, TellOfAPlaceWhatTheWholeInformationMatrixDoes) {
  const std::vector<Eigen::Vector3d> antennas = {{0, 0, 1.2}, {4.5, 0.3, 2.0}, {2.0, 4.0, 2.8}};
  const Eigen::Vector3d p_WT(1.7, 2.2, 0.9);
  const std::vector<double>& carriers = known_plan("fcc").carriers_hz;
  const auto count = static_cast<double>(carriers.size());
  double mean = 0.0;
  for (const double carrier : carriers) mean += carrier / count;
  double spread = 0.0;
  for (const double carrier : carriers) spread += std::pow(carrier - mean, 2);
  std::vector<PositionInformation> information;
  for (const Eigen::Vector3d& p_WA : antennas) {
    information.push_back(information_along(information_of_phases(spread / 0.01), p_WA, p_WT));
  }
  EXPECT_NEAR(error_bound_m(information) / plainly(antennas, p_WT, carriers, 0.1), 1.0, 1e-5);
}

TEST(LinkReads, TellLessWhereTheyAreWeak) {
  const RadioModel model = model_in(Session::kS1);
  const auto states = [](double margin_db) {
    return LinkStates(std::vector<double>(kFadingPositions * 8, margin_db));
  };
  const RangeInformation strong = range_information(model, states(20.0), 0.0, 2.0);
  const RangeInformation weak = range_information(model, states(1.0), 0.0, 2.0);
  EXPECT_GT(strong.precision, 2.0 * weak.precision);
  EXPECT_DOUBLE_EQ(range_information(model, states(20.0), 19.0, 2.0).precision, weak.precision);
  EXPECT_EQ(range_information(model, states(1.0), 2.0, 2.0).precision, 0.0);
  // 40 dB per decade are 8.7 dB/m at 2 m, so 4 dB of fading give 0.46 m.
  EXPECT_NEAR(1.0 / std::sqrt(strong.by_strength), 0.46, 0.005);
  const PositionInformation once = position_information(strong, 1.0, 0.0, {0, 0, 0}, {2, 0, 0});
  EXPECT_NEAR(once.xx, strong.by_strength, 1e-4 * strong.by_strength);
}

TEST(LinkReads, SpreadOverTheChannelsThatAreVisited) {
  const RadioModel model = model_in(Session::kS1);
  EXPECT_EQ(expected_spread(model, 30.0, 1.0), 0.0);
  RadioModel one = model;
  one.plan = fixed_plan(915e6);
  EXPECT_EQ(expected_spread(one, 30.0, 30.0), 0.0);
  // Compare with random sets of six of the fifty channels, with five reads on each.
  RandomStream stream(1, Purpose::kPlaces);
  double mean = 0.0;
  constexpr int kDraws = 4000;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> carriers = model.plan.carriers_hz;
    CountedReads counted;
    for (int channel = 0; channel < 6; ++channel) {
      const auto at = std::min(
          carriers.size() - 1,
          static_cast<std::size_t>(uniform(stream) * static_cast<double>(carriers.size())));
      const double off_hz = carriers[at] - model.plan.carriers_hz.front();
      carriers.erase(carriers.begin() + static_cast<std::ptrdiff_t>(at));
      counted.reads += 5.0;
      counted.sum_hz += 5.0 * off_hz;
      counted.squares_hz += 5.0 * off_hz * off_hz;
    }
    mean += counted.spread() / kDraws;
  }
  // 2 % come from drawing without replacement, (N−1)/N; the random error is under 1 %.
  EXPECT_NEAR(expected_spread(model, 30.0, 6.0) / mean, 1.0, 0.04);
}

}  // namespace
}  // namespace tagfield
