// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads that belong nowhere: phases of any value, a few in a hundred, as readers give them now and
/// then. They are told by the place that most waves agree on, and by their neighbours there.
#pragma once

#include <cstddef>

#include "tagfield/localization/height_model.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// What the place says that most of a tag's waves agree on.
struct BrightestPlace {
  TagPhases phases;              ///< Of the antennas that moved.
  Eigen::ArrayXd residuals_rad;  ///< There, within ±π; empty where there is no such place.
  double reads_worth_one = 1.0;  ///< Correlation of the residuals (residuals.h): 1 for noise.
};
BrightestPlace brightest_place(const LocalizationProblem& problem, const std::string& tag,
                               const SamplesOfTag& samples);

/// Angles taken for a mixture of normal noise and of others of any value.
struct OutlierMixture {
  double sigma_rad = 0.0;      ///< Of the noise.
  double share = 0.0;          ///< Of the others.
  double evidence = 0.0;       ///< ln of the likelihood over that of the best normal noise alone.
  Eigen::ArrayXd probability;  ///< That each is one of the others.
};

/// Maximum likelihood by expectation and maximization. `angles` within ±π, not empty.
OutlierMixture outlier_mixture(const Eigen::ArrayXd& angles);

/// Each residual less the mean of its neighbours of the same span, up to four before and after it:
/// what bends the phase slowly is left out.
Eigen::ArrayXd less_neighbours(const TagPhases& phases, const Eigen::ArrayXd& residuals_rad);

/// Whether there are outliers beyond doubt (evidence over ln n), and no more than one in five.
bool has_outliers(const OutlierMixture& mixture);

/// Takes the likely outliers out of one tag's samples; how many there were.
std::size_t remove_outliers(const LocalizationProblem& problem, const std::string& tag,
                            SamplesOfTag& samples);

}  // namespace tagfield
