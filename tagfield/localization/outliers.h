// SPDX-License-Identifier: Apache-2.0
/// @file
/// Outliers: reads with an arbitrary phase, a few in a hundred, as readers occasionally report.
/// They are recognized by their residuals at the position that most phasors agree on, relative to
/// those of neighbouring reads.
#pragma once

#include <cstddef>
#include <optional>

#include "tagfield/localization/height_model.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Residuals at the position that most of a tag's phasors agree on.
struct HologramPeak {
  TagPhases phases;              ///< Of the antennas that moved.
  Eigen::ArrayXd residuals_rad;  ///< At that position, within ±π; empty if there is none.
  double reads_worth_one = 1.0;  ///< The residuals' correlation factor (residuals.h): 1 for noise.
};
HologramPeak hologram_peak(const LocalizationProblem& problem, const std::string& tag,
                           const SamplesOfTag& samples);

/// Mixture model of angles: normal noise and uniformly distributed outliers.
struct OutlierMixture {
  double sigma_rad = 0.0;      ///< Of the noise.
  double share = 0.0;          ///< Of the outliers.
  double evidence = 0.0;       ///< ln of the likelihood ratio to the best normal noise alone.
  Eigen::ArrayXd probability;  ///< That each is an outlier.
};

/// Maximum likelihood by expectation maximization (EM). `angles` within ±π, not empty.
OutlierMixture outlier_mixture(const Eigen::ArrayXd& angles);

/// Each residual minus the circular mean of its neighbours in the same span, up to four on each
/// side, which removes slow errors.
Eigen::ArrayXd less_neighbours(const TagPhases& phases, const Eigen::ArrayXd& residuals_rad);

/// Whether there are outliers beyond doubt (evidence over ln n), and fewer than one in five.
bool has_outliers(const OutlierMixture& mixture);

/// Whether the likely outliers come one by one, as arbitrary phases do: not many more follow each
/// other directly than by chance (three standard deviations of Poisson's law). Those of a pose
/// error or of a wrong position come in a row, for instance wherever the antenna drives between
/// stops. `probability` as of outlier_mixture(), in the order of the phases.
bool are_scattered(const TagPhases& phases, const Eigen::ArrayXd& probability);

/// The outliers among the residuals; nullopt if there are none, or they come in a row.
std::optional<OutlierMixture> outliers_at(const HologramPeak& there);

/// Removes the likely outliers from one tag's samples and returns their number.
std::size_t remove_outliers(const LocalizationProblem& problem, const std::string& tag,
                            SamplesOfTag& samples);

/// Keeps reads whose phase is arbitrary out of a problem's samples as long as it exists. They are
/// recognized by following the phase from read to read (phase_following.h); a warning says how many
/// they are. For methods that unwrap phases: one such read among few shifts the others by whole
/// cycles.
class WithoutStrayPhases {
 public:
  WithoutStrayPhases(LocalizationProblem& problem, int threads, Diagnostics& diagnostics);
  ~WithoutStrayPhases();
  WithoutStrayPhases(const WithoutStrayPhases&) = delete;
  WithoutStrayPhases& operator=(const WithoutStrayPhases&) = delete;

 private:
  LocalizationProblem& problem_;
  SamplesByTag strays_;
};

/// Warns that this share of the phases is left out.
void warn_of_outliers(double share, Diagnostics& diagnostics);

}  // namespace tagfield
