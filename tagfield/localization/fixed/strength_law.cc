// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/strength_law.h"

#include <algorithm>
#include <cmath>

#include "tagfield/fit/products.h"
#include "tagfield/fit/symmetric.h"
#include "tagfield/localization/fixed/strength_density.h"

namespace tagfield {
namespace {

constexpr double kAnyLevel = 60.0;   ///< Prior standard deviation of the level [dB].
constexpr double kUsualLevel = -45;  ///< [dBm at 1 m]
constexpr double kWorth = 4.0;       ///< Weight of the fading's prior, in RSSI values.
/// Where RSSI follows the law exactly, this keeps covariances regular [dB]; below a reader's steps.
constexpr double kLeastFading = 0.01;
constexpr int kLawRounds = 100;    ///< At most,
constexpr double kSettled = 0.02;  ///< or until ln of the likelihood changes by less,
/// and the fading by less than this part. Of an exact law it falls by a tenth each round, so that
/// it is then known to a tenth.
constexpr double kSteady = 0.01;

/// A tag's contribution to the law: its normal equations, its share of the fading, and the
/// probabilities that it is in each of the areas.
struct Contribution {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  double squares = 0.0;
  double strengths = 0.0;
  Eigen::ArrayXd areas;
};

Eigen::Index size_of(std::size_t antennas) { return static_cast<Eigen::Index>(antennas) + 2; }

/// Covariance due to fading and to the tag itself.
Eigen::MatrixXd scatter(Eigen::Index count, double fading_db, double tag_sigma_db) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(count, count, tag_sigma_db * tag_sigma_db);
  covariance.diagonal().array() += fading_db * fading_db;
  return covariance;
}

double log_sum_exp(const Eigen::ArrayXd& logs) {
  const double most = logs.maxCoeff();
  return most + std::log((logs - most).exp().sum());
}

StrengthLaw before_data(std::size_t antennas, const StrengthPrior& prior) {
  const Eigen::Index size = size_of(antennas);
  StrengthLaw law;
  law.mean = Eigen::VectorXd::Zero(size);
  law.mean[0] = kUsualLevel;
  law.mean[size - 1] = prior.slope_db;
  Eigen::VectorXd sigmas = Eigen::VectorXd::Constant(size, prior.antenna_sigma_db);
  sigmas[0] = kAnyLevel;
  sigmas[size - 1] = prior.slope_sigma_db;
  law.covariance = sigmas.array().max(1e-3).square().matrix().asDiagonal();
  law.fading_db = prior.fading_db;
  return law;
}

/// Probabilities of the areas for a tag with these probabilities of its cells.
Eigen::ArrayXd areas_by(const PossiblePlaces& places, const Eigen::VectorXd& weights,
                        const Eigen::ArrayXd& areas) {
  if (is_known(places)) return Eigen::ArrayXd::Zero(areas.size());
  const Eigen::ArrayXXd joint = places.density.rowwise() * areas.transpose();
  const Eigen::ArrayXd all = joint.rowwise().sum();
  return (weights.transpose() * (joint.colwise() / all).matrix()).transpose().array();
}

/// Expectations over the cells, of which `weights` are the probabilities.
Contribution contribution_of(const TagOnGrid& tag, const StrengthLaw& law,
                             const Eigen::VectorXd& weights, const StrengthPrior& prior) {
  const Eigen::Index size = law.mean.size();
  const Eigen::Index slope = size - 1;
  const auto count = static_cast<Eigen::Index>(tag.antennas.size());
  const double tag_variance = prior.tag_sigma_db * prior.tag_sigma_db;
  const Eigen::MatrixXd inverse =
      invert_symmetric(scatter(count, law.fading_db, prior.tag_sigma_db));
  const Eigen::MatrixXd levels = levels_of(tag, slope);
  const Eigen::MatrixXd& distances = tag.log_distance;
  const Eigen::MatrixXd strengths = (-tag.gain_db).colwise() + tag.rssi_dbm;
  const Eigen::MatrixXd weighted = distances * weights.asDiagonal();
  const Eigen::VectorXd distance = distances * weights;
  const Eigen::MatrixXd squared_distances = product(weighted, distances.transpose());
  Contribution of{
      Eigen::MatrixXd(size, size), Eigen::VectorXd(size), 0.0, static_cast<double>(count), {}};
  const Eigen::MatrixXd to_levels = product(levels.transpose(), inverse);
  of.normal.topLeftCorner(slope, slope) = product(to_levels, levels);
  of.normal.col(slope).head(slope) = -to_levels * distance;
  of.normal.row(slope).head(slope) = of.normal.col(slope).head(slope).transpose();
  of.normal(slope, slope) = inverse.cwiseProduct(squared_distances).sum();
  of.right.head(slope) = to_levels * (strengths * weights);
  of.right[slope] = -inverse.cwiseProduct(product(weighted, strengths.transpose())).sum();
  // Gain that estimates the tag's own deviation from the sum of its misfits.
  const double gain =
      tag_variance / (law.fading_db * law.fading_db + static_cast<double>(count) * tag_variance);
  Eigen::MatrixXd misfit = strengths + law.mean[slope] * distances;
  misfit.colwise() -= levels * law.mean.head(slope);
  const Eigen::RowVectorXd own = gain * misfit.colwise().sum();
  misfit.rowwise() -= own;
  const Eigen::VectorXd with_slope = levels * law.covariance.col(slope).head(slope);
  of.squares = misfit.colwise().squaredNorm() * weights +
               static_cast<double>(count) * gain * law.fading_db * law.fading_db +
               transformed(levels, law.covariance.topLeftCorner(slope, slope)).trace() -
               2.0 * distance.dot(with_slope) +
               law.covariance(slope, slope) * squared_distances.trace();
  return of;
}

Contribution sum_of(const std::vector<Contribution>& all, Eigen::Index size, Eigen::Index areas) {
  Contribution sum{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0.0, 0.0,
                   Eigen::ArrayXd::Zero(areas)};
  for (const Contribution& contribution : all) {
    sum.normal += contribution.normal;
    sum.right += contribution.right;
    sum.squares += contribution.squares;
    sum.strengths += contribution.strengths;
    sum.areas += contribution.areas;
  }
  return sum;
}

/// Probabilities of the areas before any tag: all alike, which is worth one tag.
Eigen::ArrayXd areas_before(Eigen::Index count) {
  return Eigen::ArrayXd::Constant(count, 1.0 / static_cast<double>(count));
}

/// The prior law updated with all contributions except that of one tag.
StrengthLaw law_by(const StrengthLaw& before, const Contribution& all,
                   const Contribution* without) {
  const Eigen::MatrixXd weights = invert_symmetric(before.covariance);
  Eigen::MatrixXd normal = weights + all.normal;
  Eigen::VectorXd right = weights * before.mean + all.right;
  double squares = kWorth * before.fading_db * before.fading_db + all.squares;
  double strengths = kWorth + all.strengths;
  if (without != nullptr) {
    normal -= without->normal;
    right -= without->right;
    squares -= without->squares;
    strengths -= without->strengths;
  }
  StrengthLaw law;
  law.covariance = invert_symmetric(normal);
  law.mean = law.covariance * right;
  law.fading_db = std::sqrt(std::max(squares / strengths, kLeastFading * kLeastFading));
  return law;
}

/// ln of the RSSI density if the values scatter by `fading_db` around levels independent of
/// distance, each tag's by the levels learned from all others.
double log_of_chance(const std::vector<TagOnGrid>& tags, const StrengthLaw& flat,
                     double tag_sigma_db) {
  const Eigen::Index size = flat.mean.size();
  std::vector<Contribution> contributions;
  for (const TagOnGrid& tag : tags) {
    const Eigen::MatrixXd rows = levels_of(tag, size);
    const Eigen::MatrixXd weighted = product(
        rows.transpose(), invert_symmetric(scatter(rows.rows(), flat.fading_db, tag_sigma_db)));
    contributions.push_back(
        {product(weighted, rows), weighted * tag.rssi_dbm, 0.0, 0.0, Eigen::ArrayXd::Zero(1)});
  }
  const Contribution sum = sum_of(contributions, size, 1);
  double log = 0.0;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const Eigen::MatrixXd rows = levels_of(tags[i], size);
    const StrengthLaw law = law_by(flat, sum, &contributions[i]);
    Eigen::VectorXd misfit = tags[i].rssi_dbm - rows * law.mean;
    Eigen::MatrixXd covariance =
        transformed(rows, law.covariance) + scatter(rows.rows(), flat.fading_db, tag_sigma_db);
    log += log_normal_density(misfit, covariance);
  }
  return log;
}

/// As above, averaged over scatter from 1 to 16 dB.
double log_of_chance(const std::vector<TagOnGrid>& tags, std::size_t antennas,
                     StrengthPrior prior) {
  prior.slope_db = 0.0;
  prior.slope_sigma_db = 0.0;
  Eigen::ArrayXd logs(9);
  for (Eigen::Index i = 0; i < logs.size(); ++i) {
    prior.fading_db = std::pow(2.0, 0.5 * static_cast<double>(i));
    logs[i] = log_of_chance(tags, before_data(antennas, prior), prior.tag_sigma_db);
  }
  return log_sum_exp(logs) - std::log(static_cast<double>(logs.size()));
}

}  // namespace

LearnedLaw learn_law(const std::vector<TagOnGrid>& tags, std::size_t antennas,
                     const StrengthPrior& prior) {
  const StrengthLaw before = before_data(antennas, prior);
  const Eigen::Index areas = tags.empty() ? 1 : tags.front().places.density.cols();
  LearnedLaw learned;
  learned.of_all = before;
  learned.of_tag.assign(tags.size(), before);
  learned.areas_of_tag.assign(tags.size(), areas_before(areas));
  std::vector<Contribution> contributions(tags.size());
  double log_of_law = 0.0;
  for (int round = 0; round < kLawRounds; ++round) {
    const double before_round = log_of_law;
    const double fading_before = learned.of_all.fading_db;
    log_of_law = 0.0;
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const TagOnGrid fine = refined(tags[i], learned.of_tag[i], prior);
      const Eigen::ArrayXd logs = log_strength(fine, learned.of_tag[i], prior) +
                                  log_prior(fine.places, learned.areas_of_tag[i]);
      const double log = log_sum_exp(logs);
      log_of_law += log;
      const Eigen::VectorXd weights = (logs - log).exp().matrix();
      contributions[i] = contribution_of(fine, learned.of_all, weights, prior);
      contributions[i].areas = areas_by(fine.places, weights, learned.areas_of_tag[i]);
    }
    const Contribution sum = sum_of(contributions, before.mean.size(), areas);
    learned.of_all = law_by(before, sum, nullptr);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      learned.of_tag[i] = law_by(before, sum, &contributions[i]);
      const Eigen::ArrayXd counts = areas_before(areas) + sum.areas - contributions[i].areas;
      learned.areas_of_tag[i] = counts / counts.sum();
    }
    const double change = learned.of_all.fading_db / fading_before - 1.0;
    if (std::abs(log_of_law - before_round) < kSettled && std::abs(change) < kSteady) break;
  }
  // Slope and positions were fitted to n RSSI values: Schwarz's criterion takes ½ ln n for each of
  // the two.
  double strengths = 1.0;
  for (const TagOnGrid& tag : tags) strengths += static_cast<double>(tag.antennas.size());
  learned.evidence = log_of_law - log_of_chance(tags, antennas, prior) - std::log(strengths);
  return learned;
}

}  // namespace tagfield
