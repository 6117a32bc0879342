// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_coupling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/channel/mutual_impedance.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

constexpr double kLambda = 0.3463;

std::shared_ptr<const TagModel> dipole(PolarizationKind polarization = PolarizationKind::kLinear) {
  TagModel tag = *default_tag_model();
  tag.antenna.polarization = polarization;
  return std::make_shared<const TagModel>(tag);
}

TagPopulation tags_at(const std::vector<Vector3d>& places) {
  TagPopulation tags(1.0);
  std::uint32_t slot = 0;
  for (const Vector3d& p_W : places) {
    tags.add(slot, "tag" + std::to_string(slot), p_W);
    ++slot;
  }
  return tags;
}

double own_of(const TagPopulation& tags, std::uint32_t slot) {
  TagCouplings couplings;
  couplings.see(tags);
  return std::abs(couplings.of(slot, kLambda).own);
}

TEST(TagCouplings, FindTheNeighboursNearerThanAWavelength) {
  const TagPopulation tags =
      tags_at({{0, 0, 0}, {0.3, 0, 0}, {-0.3, 0, 0}, {0, 0.35, 0}, {0, 0, 0.34}, {5, 0, 0}});
  TagCouplings couplings;
  couplings.see(tags);
  std::vector<std::uint32_t> slots;
  for (const auto& [slot, share] : couplings.of(0, kLambda).neighbours) slots.push_back(slot);
  EXPECT_EQ(slots, (std::vector<std::uint32_t>{1, 2, 4}));
  EXPECT_TRUE(couplings.of(5, kLambda).neighbours.empty());
  EXPECT_EQ(couplings.of(5, kLambda).own, 1.0);
}

TEST(TagCouplings, AreThoseOfTheWholeSystem) {
  // Three in a row: the middle tag's currents by Cramer's rule.
  const TagPopulation tags = tags_at({{0, 0, 0}, {0, 0.08, 0}, {0, -0.08, 0}});
  TagCouplings couplings;
  couplings.see(tags);
  const CoupledTag middle = couplings.of(0, kLambda);
  const double both = 2.0 * kDipoleImpedance_ohm.real();
  const double k = kTwoPi / kLambda;
  const std::complex<double> a = parallel_impedance(k, 0.08, 0.0) / both;
  const std::complex<double> b = parallel_impedance(k, 0.16, 0.0) / both;
  const std::complex<double> determinant = 1.0 - b * b - 2.0 * a * a * (1.0 - b);
  EXPECT_NEAR(std::abs(middle.own - (1.0 - b * b) / determinant), 0.0, 1e-12);
  for (const auto& [slot, share] : middle.neighbours) {
    EXPECT_NEAR(std::abs(share - (b - 1.0) * a / determinant), 0.0, 1e-12) << slot;
  }
}

TEST(TagCouplings, LeaveCrossedAndCircularTagsAlone) {
  TagPopulation tags = tags_at({{0, 0, 0}, {0.05, 0, 0}});
  EXPECT_GT(std::abs(own_of(tags, 0) - 1.0), 0.05);
  tags.turn(1, Eigen::Quaterniond(Eigen::AngleAxisd(kPi / 2, Vector3d::UnitX())));
  EXPECT_NEAR(own_of(tags, 0), 1.0, 1e-12);
  tags.turn(1, Eigen::Quaterniond::Identity());
  tags.set_model(1, dipole(PolarizationKind::kRightCircular));
  EXPECT_EQ(own_of(tags, 0), 1.0);
}

TEST(TagCouplings, FollowTagsThatMoveTurnComeAndGo) {
  TagPopulation tags = tags_at({{0, 0, 0}, {0.05, 0, 0}, {0.9, 0, 0}});
  TagCouplings kept;
  const auto expect_fresh = [&](const char* what) {
    kept.see(tags);
    tags.for_each([&](std::uint32_t slot) {
      TagCouplings fresh;
      fresh.see(tags);
      const CoupledTag& expected = fresh.of(slot, kLambda);
      const CoupledTag& actual = kept.of(slot, kLambda);
      EXPECT_EQ(actual.own, expected.own) << what;
      EXPECT_EQ(actual.neighbours, expected.neighbours) << what;
    });
  };
  expect_fresh("at first");
  tags.move(1, {0.8, 0, 0});
  expect_fresh("moved");
  tags.turn(2, Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitX())));
  expect_fresh("turned");
  tags.add(3, "more", {0.02, 0.02, 0});
  expect_fresh("came");
  tags.remove(0);
  expect_fresh("gone");
}

TEST(TagCouplings, TakeTheNearestOfACrowd) {
  std::vector<Vector3d> places = {{0, 0, 0}};
  for (int i = 1; i <= 40; ++i) places.emplace_back(0.005 * i, 0.0, 0.0);
  const TagPopulation tags = tags_at(places);
  TagCouplings couplings;
  couplings.see(tags);
  const CoupledTag crowded = couplings.of(0, kLambda);
  ASSERT_EQ(crowded.neighbours.size(), kMaxNeighbours);
  EXPECT_EQ(crowded.neighbours.back().first, kMaxNeighbours);
}

/// Power radiated by vertical half-wave dipoles at `places` with currents `c`, relative to that of
/// one with a current of 1: integrated over all directions.
double radiated(const std::vector<Vector3d>& places, const Eigen::RowVectorXcd& c) {
  constexpr int kSteps = 200;
  double sum = 0.0;
  double of_one = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = kPi * (i + 0.5) / kSteps;
    const double pattern = std::cos(0.5 * kPi * std::cos(theta)) / std::sin(theta);
    const double weight = pattern * pattern * std::sin(theta);
    for (int j = 0; j < kSteps; ++j) {
      const double around = kTwoPi * j / kSteps;
      const Vector3d u(std::sin(theta) * std::cos(around), std::sin(theta) * std::sin(around),
                       std::cos(theta));
      std::complex<double> field = 0.0;
      for (std::size_t n = 0; n < places.size(); ++n) {
        field +=
            c(static_cast<Eigen::Index>(n)) * std::polar(1.0, kTwoPi / kLambda * u.dot(places[n]));
      }
      sum += weight * std::norm(field);
      of_one += weight;
    }
  }
  return sum / of_one;
}

TEST(SharesAmong, KeepTheEnergy) {
  // The first tag transmits with the same weights as it receives. The power radiated by all is what
  // their currents put into the real part of the impedances; together with the power absorbed by
  // the neighbours' chips, it is at most that of a matched source.
  const auto kind = dipole();
  const std::vector<std::vector<Vector3d>> arrays = {
      {{0, 0, 0}, {0.02, 0, 0}, {0, 0.05, 0}},
      {{0, 0, 0}, {0.05, 0, 0.1}, {-0.1, 0.08, -0.12}},
      {{0, 0, 0}, {0, 0, 0.19}, {0.17, 0, 0}}};
  for (const std::vector<Vector3d>& places : arrays) {
    std::vector<TagAtPose> tags;
    tags.reserve(places.size());
    for (const Vector3d& p_W : places) tags.push_back({kind.get(), from_translation(p_W)});
    const Eigen::RowVectorXcd c = shares_among(tags, kLambda);
    const double resistance = kDipoleImpedance_ohm.real();
    double put_in = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < places.size(); ++j) {
        const Vector3d way = places[i] - places[j];
        const double mutual =
            i == j ? resistance
                   : parallel_impedance(kTwoPi / kLambda, way.head<2>().norm(), way.z()).real();
        const auto row = static_cast<Eigen::Index>(i);
        const auto column = static_cast<Eigen::Index>(j);
        put_in += (std::conj(c(row)) * c(column)).real() * mutual / resistance;
      }
    }
    EXPECT_NEAR(radiated(places, c), put_in, 1e-3);
    EXPECT_LE(put_in + c.tail(2).squaredNorm(), 1.0);
    EXPECT_GT(put_in, 0.05);
  }
}

}  // namespace
}  // namespace tagfield
