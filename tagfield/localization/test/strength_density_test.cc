// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/strength_density.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "method_study.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using namespace made;

constexpr int kAntennas = 4;
constexpr double kRoom = 6.0;  // [m]

/// A law with correlated coefficients, as learned ones have.
StrengthLaw law_with(double fading_db, double sigma_db, Rng& rng) {
  const Eigen::Index size = kAntennas + 2;
  StrengthLaw law;
  law.mean = Eigen::VectorXd::Zero(size);
  law.mean[0] = -30.0;
  law.mean[size - 1] = 40.0;
  Eigen::MatrixXd mixed(size, size);
  for (double& value : mixed.reshaped()) value = normal(rng, sigma_db);
  law.covariance = mixed * mixed.transpose();
  law.fading_db = fading_db;
  return law;
}

/// A tag at a random place of the room, read without noise; its cells cover the room.
TagOnGrid tag_in_room(double cell_m, const Lobe& lobe, Rng& rng, Eigen::Vector3d& p_WT) {
  p_WT = {uniform(rng, 0.3, kRoom - 0.3), uniform(rng, 0.3, kRoom - 0.3), 1.0};
  std::vector<std::string> names;
  std::vector<FixedReads> reads;
  for (int i = 0; i < kAntennas; ++i) {
    FixedReads of;
    of.antenna = std::to_string(i);
    of.p_WA = {kRoom * (i % 2), kRoom * (i / 2), 2.0};  // NOLINT(bugprone-integer-division)
    of.boresight_W = (Eigen::Vector3d(0.5 * kRoom, 0.5 * kRoom, 1.0) - of.p_WA).normalized();
    of.strengths = 1.0;
    const Eigen::Vector3d way = p_WT - of.p_WA;
    of.rssi_dbm = -30.0 - 40.0 * std::log10(way.norm()) + lobe_db(lobe, of.boresight_W, way);
    names.push_back(of.antenna);
    reads.push_back(of);
  }
  PossiblePlaces places;
  for (double x = 0.5 * cell_m; x < kRoom; x += cell_m) {
    for (double y = 0.5 * cell_m; y < kRoom; y += cell_m) places.cells.emplace_back(x, y, 1.0);
  }
  const auto count = static_cast<Eigen::Index>(places.cells.size());
  places.size_m = Eigen::ArrayXd::Constant(count, cell_m);
  places.density = Eigen::ArrayXXd::Constant(count, 1, 1.0 / (kRoom * kRoom));
  return on_grid(names, reads, places, lobe);
}

/// The definition: a normal density whose covariance is that of law, tag and fading.
double log_density(const TagOnGrid& tag, Eigen::Index cell, const StrengthLaw& law,
                   double tag_sigma_db) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(kAntennas, kAntennas + 2);
  rows.col(0).setOnes();
  rows.middleCols(1, kAntennas).setIdentity();
  rows.col(kAntennas + 1) = -tag.log_distance.col(cell);
  Eigen::MatrixXd covariance = rows * law.covariance * rows.transpose();
  covariance.array() += tag_sigma_db * tag_sigma_db;
  covariance.diagonal().array() += law.fading_db * law.fading_db;
  const Eigen::VectorXd misfit = tag.rssi_dbm - tag.gain_db.col(cell) - rows * law.mean;
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  return -0.5 * misfit.dot(covariance.llt().solve(misfit)) - root.diagonal().array().log().sum() -
         0.5 * kAntennas * std::log(kTwoPi);
}

TEST(StrengthDensity, IsTheNormalDensityOfLawTagAndFading) {
  Rng rng(1);
  Lobe lobe;
  lobe.beam_width_deg = 70.0;
  const StrengthLaw law = law_with(1.5, 1.0, rng);
  Eigen::Vector3d p_WT;
  const TagOnGrid tag = tag_in_room(0.5, lobe, rng, p_WT);
  const Eigen::ArrayXd logs = log_strength(tag, law, {lobe});
  for (Eigen::Index i = 0; i < logs.size(); ++i) {
    const double expected = log_density(tag, i, law, StrengthPrior{}.tag_sigma_db);
    EXPECT_NEAR(logs[i], expected, 1e-6 * (1.0 + std::abs(expected)));
  }
}

/// No place within the cell is likelier than what the bound of the cell says: twenty in each.
TEST(StrengthDensity, TheBoundOfACellHoldsWithinIt) {
  Rng rng(2);
  const StrengthLaw law = law_with(0.2, 0.01, rng);
  Eigen::Vector3d p_WT;
  const TagOnGrid tag = tag_in_room(0.5, {}, rng, p_WT);
  const Eigen::ArrayXd bounds = cell_strengths(tag, law, {}).bound;
  for (int i = 0; i < 20; ++i) {
    TagOnGrid there = tag;
    PossiblePlaces places = tag.places;
    for (Eigen::Vector3d& place : places.cells) {
      place += Eigen::Vector3d(uniform(rng, -0.25, 0.25), uniform(rng, -0.25, 0.25), 0.0);
    }
    put_on(places, {}, there);
    // The determinant changes within a cell, too, but hardly.
    EXPECT_GT((bounds - log_strength(there, law, {})).minCoeff(), -0.1);
  }
}

/// With exact RSSI the posterior is millimetres wide and lies between the middles of coarse cells.
TEST(StrengthDensity, NarrowPosteriorsAreFoundFromCoarseCells) {
  Rng rng(3);
  for (const double fading : {0.02, 0.2, 2.0}) {
    const StrengthLaw law = law_with(fading, 0.001, rng);
    Eigen::Vector3d p_WT;
    const TagOnGrid coarse = tag_in_room(0.75, {}, rng, p_WT);
    const TagOnGrid fine = refined(coarse, law, {});
    const Eigen::ArrayXd cells = log_prior(fine.places, Eigen::ArrayXd::Ones(1));
    const double likelihood = (log_strength(fine, law, {}) + cells).exp().sum();
    // The same integral by brute force, around the tag where the posterior is narrow.
    const double step = fading < 1.0 ? 0.02 * fading : 0.02;
    const double around = fading < 1.0 ? 2.0 * fading : 2.0 * kRoom;
    PossiblePlaces places;
    for (double x = p_WT.x() - around; x < p_WT.x() + around; x += step) {
      for (double y = p_WT.y() - around; y < p_WT.y() + around; y += step) {
        if (x > 0.0 && y > 0.0 && x < kRoom && y < kRoom) places.cells.emplace_back(x, y, 1.0);
      }
    }
    places.size_m = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(places.cells.size()));
    TagOnGrid all = coarse;
    put_on(places, {}, all);
    const double expected = log_strength(all, law, {}).exp().sum() * step * step / (kRoom * kRoom);
    EXPECT_NEAR(likelihood / expected, 1.0, 0.1) << fading;
  }
}

}  // namespace
}  // namespace tagfield
