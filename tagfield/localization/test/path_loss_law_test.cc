// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/path_loss_law.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "method_study.h"

namespace tagfield {
namespace {

using namespace made;

constexpr double kSlope = 31.0;
constexpr double kLevel = -36.0;

/// Tags "tag0" … beside a curve, read by a law with kSlope and kLevel; those named by `references`
/// are reference tags.
LocalizationProblem tags_by_a_law(std::size_t count, std::size_t references, double noise_db,
                                  Rng& rng) {
  LocalizationProblem problem;
  const Path path = s_curve(12.0, 0.1);
  for (std::size_t k = 0; k < count; ++k) {
    const std::string tag = "tag" + std::to_string(k);
    const double x = uniform(rng, 1.0, 9.0);
    const Eigen::Vector3d p_WT(x, uniform(rng, 1.5, 4.0), 1.1);
    std::vector<PhaseSample> samples = read_along(path, p_WT, Noise{}, rng);
    for (PhaseSample& sample : samples) {
      const double distance = (p_WT - sample.p_WA).norm();
      sample.rssi_dbm = kLevel - kSlope * std::log10(distance) + normal(rng, noise_db);
    }
    problem.samples[tag]["a"] = samples;
    problem.heights.of_tag[tag] = p_WT.z();
    if (k < references) problem.reference_tags[tag] = p_WT;
  }
  return problem;
}

/// Slope and level by least squares over all averaged reads of the reference tags, with another
/// row that says what the slope is thought to be.
Eigen::Vector2d line_through(const LocalizationProblem& problem, double slope_db, double weight,
                             double bin_m) {
  std::vector<double> logs;
  std::vector<double> levels;
  for (const auto& [tag, p_WT] : problem.reference_tags) {
    const BinnedRssi bins = binned_rssi(problem, problem.samples.at(tag), bin_m, {});
    for (Eigen::Index i = 0; i < bins.rssi.size(); ++i) {
      const Eigen::Vector3d p_WA(bins.x[i], bins.y[i], bins.z[i]);
      logs.push_back(std::log10((p_WT - p_WA).norm()));
      levels.push_back(bins.rssi[i]);
    }
  }
  const auto rows = static_cast<Eigen::Index>(logs.size());
  Eigen::MatrixXd a(rows + 1, 2);
  Eigen::VectorXd b(rows + 1);
  for (Eigen::Index i = 0; i < rows; ++i) {
    a.row(i) << -logs[static_cast<std::size_t>(i)], 1.0;
    b[i] = levels[static_cast<std::size_t>(i)];
  }
  a.row(rows) << weight, 0.0;
  b[rows] = weight * slope_db;
  return a.colPivHouseholderQr().solve(b);
}

TEST(PathLossLaw, ComesFromALineThroughTheReferenceTags) {
  Rng rng(1);
  const LocalizationProblem problem = tags_by_a_law(4, 4, 1.5, rng);
  TrilaterationOptions options;
  for (const double sigma_db : {0.5, 8.0, 1e6}) {
    options.slope_sigma_db = sigma_db;
    const PathLossLaw law = path_loss_laws(problem, options).isotropic;
    // Reads of reference tags deviate from the line by 2 dB.
    const Eigen::Vector2d line =
        line_through(problem, options.slope_db, 2.0 / sigma_db, options.bin_m);
    EXPECT_NEAR(law.slope_db, line[0], 1e-6) << sigma_db;
    EXPECT_NEAR(law.levels.at("a").mean_dbm, line[1], 1e-6) << sigma_db;
  }
  EXPECT_NEAR(path_loss_laws(problem, options).isotropic.slope_db, kSlope, 1.0);
}

TEST(PathLossLaw, ASlopeThatIsKnownStays) {
  Rng rng(2);
  TrilaterationOptions options;
  options.slope_sigma_db = 0.0;
  for (const std::size_t references : {0U, 2U}) {
    const PathLossLaws laws = path_loss_laws(tags_by_a_law(3, references, 1.0, rng), options);
    EXPECT_EQ(laws.isotropic.slope_db, options.slope_db);
    EXPECT_EQ(laws.directional.slope_db, options.slope_db);
    EXPECT_EQ(laws.isotropic.slope_sigma_db, 0.0);
  }
}

TEST(PathLossLaw, WithoutReferenceTagsTheSlopeSuitsAllTags) {
  Rng rng(3);
  TrilaterationOptions options;
  const PathLossLaw law = path_loss_laws(tags_by_a_law(8, 0, 0.5, rng), options).isotropic;
  EXPECT_LT(law.slope_sigma_db, 2.0);
  EXPECT_LT(std::abs(law.slope_db - kSlope), 3.0 * law.slope_sigma_db + 0.5);
  EXPECT_TRUE(law.levels.empty());
}

TEST(PathLossLaw, WithoutReadsItIsThatOfTheOptions) {
  TrilaterationOptions options;
  options.slope_db = 27.0;
  const PathLossLaw law = path_loss_laws({}, options).isotropic;
  EXPECT_EQ(law.slope_db, 27.0);
  EXPECT_NEAR(law.slope_sigma_db, options.slope_sigma_db, 0.15 * options.slope_sigma_db);
}

}  // namespace
}  // namespace tagfield
