// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/strength_law.h"

#include <algorithm>
#include <cmath>

#include "tagfield/fit/products.h"
#include "tagfield/fit/symmetric.h"

namespace tagfield {
namespace {

constexpr double kNearestCell = 0.1;        ///< Smaller distances are clamped to this [m].
constexpr double kAnyLevel = 60.0;          ///< Prior standard deviation of the level [dB].
constexpr double kUsualLevel = -45;         ///< [dBm at 1 m]
constexpr double kWorth = 4.0;              ///< Weight of the fading's prior, in RSSI values.
constexpr int kLawRounds = 25;              ///< At most,
constexpr double kSettled = 0.02;           ///< or until ln of the likelihood changes by less.
constexpr double kNegligibleWeight = 1e-4;  ///< Cells of less weight are skipped.

/// A tag's contribution to the law: its normal equations, and its share of the fading.
struct Contribution {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  double squares = 0.0;
  double strengths = 0.0;
};

Eigen::Index size_of(std::size_t antennas) { return static_cast<Eigen::Index>(antennas) + 2; }

/// Rows of the linear law: RSSI − gains = H θ.
Eigen::MatrixXd design(const TagOnGrid& tag, Eigen::Index cell, Eigen::Index size) {
  const auto count = static_cast<Eigen::Index>(tag.antennas.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count, size);
  for (Eigen::Index i = 0; i < count; ++i) {
    rows(i, 0) = 1.0;
    rows(i, 1 + static_cast<Eigen::Index>(tag.antennas[static_cast<std::size_t>(i)])) = 1.0;
    rows(i, size - 1) = -tag.log_distance(cell, i);
  }
  return rows;
}

/// Covariance due to fading and to the tag itself.
Eigen::MatrixXd scatter(Eigen::Index count, double fading_db, double tag_sigma_db) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(count, count, tag_sigma_db * tag_sigma_db);
  covariance.diagonal().array() += fading_db * fading_db;
  return covariance;
}

Eigen::VectorXd less_gain(const TagOnGrid& tag, Eigen::Index cell) {
  return tag.rssi_dbm - tag.gain_db.row(cell).matrix().transpose();
}

double log_mean_exp(const Eigen::ArrayXd& logs) {
  const double most = logs.maxCoeff();
  return most + std::log((logs - most).exp().mean());
}

Eigen::ArrayXd weights_of(const Eigen::ArrayXd& logs) {
  const Eigen::ArrayXd weights = (logs - logs.maxCoeff()).exp();
  return weights / weights.sum();
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

Contribution contribution_of(const TagOnGrid& tag, const StrengthLaw& law,
                             const Eigen::ArrayXd& weights, const StrengthPrior& prior) {
  const Eigen::Index size = law.mean.size();
  const auto count = static_cast<Eigen::Index>(tag.antennas.size());
  const double tag_variance = prior.tag_sigma_db * prior.tag_sigma_db;
  const Eigen::MatrixXd inverse =
      invert_symmetric(scatter(count, law.fading_db, prior.tag_sigma_db));
  // Gain that estimates the tag's own deviation from the sum of its misfits.
  const double gain =
      tag_variance / (law.fading_db * law.fading_db + static_cast<double>(count) * tag_variance);
  Contribution contribution{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0.0,
                            static_cast<double>(count)};
  for (Eigen::Index cell = 0; cell < weights.size(); ++cell) {
    if (weights[cell] < kNegligibleWeight) continue;
    const Eigen::MatrixXd rows = design(tag, cell, size);
    const Eigen::VectorXd strengths = less_gain(tag, cell);
    const Eigen::MatrixXd weighted = weights[cell] * product(rows.transpose(), inverse);
    contribution.normal += product(weighted, rows);
    contribution.right += weighted * strengths;
    const Eigen::VectorXd misfit = strengths - rows * law.mean;
    const double own = gain * misfit.sum();
    contribution.squares +=
        weights[cell] * ((misfit.array() - own).square().sum() +
                         static_cast<double>(count) * gain * law.fading_db * law.fading_db +
                         transformed(rows, law.covariance).trace());
  }
  return contribution;
}

Contribution sum_of(const std::vector<Contribution>& all, Eigen::Index size) {
  Contribution sum{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0.0, 0.0};
  for (const Contribution& contribution : all) {
    sum.normal += contribution.normal;
    sum.right += contribution.right;
    sum.squares += contribution.squares;
    sum.strengths += contribution.strengths;
  }
  return sum;
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
  law.fading_db = std::sqrt(std::max(squares / strengths, 0.25));
  return law;
}

/// ln of the RSSI density if the values scatter by `fading_db` around levels independent of
/// distance, each tag's by the levels learned from all others.
double log_of_chance(const std::vector<TagOnGrid>& tags, const StrengthLaw& flat,
                     double tag_sigma_db) {
  const Eigen::Index size = flat.mean.size();
  std::vector<Contribution> contributions;
  for (const TagOnGrid& tag : tags) {
    const Eigen::MatrixXd rows = design(tag, 0, size);
    const Eigen::MatrixXd weighted = product(
        rows.transpose(), invert_symmetric(scatter(rows.rows(), flat.fading_db, tag_sigma_db)));
    contributions.push_back({product(weighted, rows), weighted * tag.rssi_dbm, 0.0, 0.0});
  }
  const Contribution sum = sum_of(contributions, size);
  double log = 0.0;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const Eigen::MatrixXd rows = design(tags[i], 0, size);
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
  return log_mean_exp(logs);
}

}  // namespace

TagOnGrid on_grid(const std::vector<std::string>& names, const std::vector<FixedReads>& reads,
                  std::vector<Eigen::Vector3d> cells, const Lobe& lobe) {
  std::vector<const FixedReads*> used;
  TagOnGrid tag;
  for (const FixedReads& of : reads) {
    const auto found = std::find(names.begin(), names.end(), of.antenna);
    if (of.strengths < 1.0 || found == names.end()) continue;
    used.push_back(&of);
    tag.antennas.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  const auto count = static_cast<Eigen::Index>(used.size());
  const auto places = static_cast<Eigen::Index>(cells.size());
  tag.rssi_dbm.resize(count);
  tag.log_distance.resize(places, count);
  tag.gain_db.resize(places, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const FixedReads& of = *used[static_cast<std::size_t>(i)];
    tag.rssi_dbm[i] = of.rssi_dbm;
    for (Eigen::Index j = 0; j < places; ++j) {
      const Eigen::Vector3d way = cells[static_cast<std::size_t>(j)] - of.p_WA;
      tag.log_distance(j, i) = std::log10(std::max(way.norm(), kNearestCell));
      tag.gain_db(j, i) = lobe_db(lobe, of.boresight_W, way);
    }
  }
  tag.cells = std::move(cells);
  return tag;
}

Eigen::ArrayXd log_strength(const TagOnGrid& tag, const StrengthLaw& law,
                            const StrengthPrior& prior) {
  const Eigen::Index count = tag.rssi_dbm.size();
  const Eigen::Index slope = law.mean.size() - 1;
  // design() differs between cells only in its last column, the negative logarithms of the
  // distances.
  const Eigen::MatrixXd levels = design(tag, 0, law.mean.size()).leftCols(slope);
  const Eigen::MatrixXd of_levels = scatter(count, law.fading_db, prior.tag_sigma_db) +
                                    transformed(levels, law.covariance.topLeftCorner(slope, slope));
  const Eigen::VectorXd with_slope = levels * law.covariance.col(slope).head(slope);
  const Eigen::VectorXd over_level = tag.rssi_dbm - levels * law.mean.head(slope);
  Eigen::ArrayXd logs(static_cast<Eigen::Index>(tag.cells.size()));
  Eigen::VectorXd distances(count);
  Eigen::VectorXd misfit(count);
  Eigen::MatrixXd covariance(count, count);
  for (Eigen::Index cell = 0; cell < logs.size(); ++cell) {
    distances = tag.log_distance.row(cell).matrix().transpose();
    misfit = over_level - tag.gain_db.row(cell).matrix().transpose() + law.mean[slope] * distances;
    covariance = of_levels;
    covariance.noalias() -= with_slope * distances.transpose();
    covariance.noalias() -= distances * with_slope.transpose();
    covariance.noalias() += law.covariance(slope, slope) * distances * distances.transpose();
    logs[cell] = log_normal_density(misfit, covariance);
  }
  return logs;
}

LearnedLaw learn_law(const std::vector<TagOnGrid>& tags, std::size_t antennas,
                     const StrengthPrior& prior) {
  const StrengthLaw before = before_data(antennas, prior);
  LearnedLaw learned;
  learned.of_all = before;
  learned.of_tag.assign(tags.size(), before);
  std::vector<Contribution> contributions(tags.size());
  double log_of_law = 0.0;
  for (int round = 0; round < kLawRounds; ++round) {
    const double before_round = log_of_law;
    log_of_law = 0.0;
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const Eigen::ArrayXd logs = log_strength(tags[i], learned.of_tag[i], prior);
      log_of_law += log_mean_exp(logs);
      contributions[i] = contribution_of(tags[i], learned.of_all, weights_of(logs), prior);
    }
    const Contribution sum = sum_of(contributions, before.mean.size());
    learned.of_all = law_by(before, sum, nullptr);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      learned.of_tag[i] = law_by(before, sum, &contributions[i]);
    }
    if (round > 0 && std::abs(log_of_law - before_round) < kSettled) break;
  }
  // Slope and positions were fitted to n RSSI values: Schwarz's criterion takes ½ ln n for each of
  // the two.
  double strengths = 1.0;
  for (const TagOnGrid& tag : tags) strengths += static_cast<double>(tag.antennas.size());
  learned.evidence = log_of_law - log_of_chance(tags, antennas, prior) - std::log(strengths);
  return learned;
}

}  // namespace tagfield
