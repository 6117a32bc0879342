// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paper's signal model of one link: phase by eq. (4) with its optional distributions, RSSI by
/// eq. (5). See docs/paper_model.md.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace tagfield {

/// The geometry that a channel model needs.
struct LinkGeometry {
  double distance_m = 0.0;  ///< D of the paper's equations, greater than 0.
};

/// The link between an antenna at `p_WA` and a tag at `p_WT` [m]. Coincident ends count as 1 µm
/// apart, so that no model divides by zero.
inline LinkGeometry link_between(const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT) {
  constexpr double kMinDistance = 1e-6;
  return {std::max((p_WT - p_WA).norm(), kMinDistance)};
}

class RandomStream;

enum class DistributionKind {
  kNone,
  kUniform,      ///< On [a, b).
  kExponential,  ///< Rate λ.
  kGamma,        ///< Shape α, scale β.
  kWeibull,      ///< Shape a, scale b.
  kNormal,       ///< Mean, standard deviation.
  kLognormal,    ///< Mean and standard deviation of the logarithm.
  kChiSquared,   ///< Degrees of freedom n.
  kCauchy,       ///< Median a, half width b.
};

/// A distribution with its parameters [rad, or none], as C++'s `<random>` defines them.
struct OptionalDistribution {
  DistributionKind kind = DistributionKind::kNone;
  std::array<double, 2> parameters{};  ///< The second is unused if there is only one.
};

/// All names: "none", "uniform_real_distribution", "exponential_distribution", and so on, as in
/// C++'s standard library and in the published plugin.
const std::vector<std::string>& distribution_names();

/// The distribution called `name`. Throws Error on an unknown name (with the nearest known one), a
/// wrong number of parameters, or a parameter outside its range.
OptionalDistribution make_distribution(const std::string& name,
                                       const std::vector<double>& parameters);

/// One draw [rad]; 0 for none. Always finite: values above the largest double are clamped to it.
double draw(const OptionalDistribution& distribution, RandomStream& stream);

/// The parameters of Table 1 that shape the signal.
struct PaperModel {
  double frequency_hz = 865.7e6;    ///< Carrier; greater than 0.
  double phase_offset_rad = 0.0;    ///< φ0: cables, reader and tag electronics.
  double phase_noise_rad = 0.1;     ///< Standard deviation of n_φ; 0 or more.
  double rssi_noise = 0.01;         ///< Standard deviation of n_RSSI, an amplitude; 0 or more.
  double communication_gain = 1.0;  ///< G_RT; greater than 0.
  OptionalDistribution optional;    ///< n_optional.
};

/// One reply as the reader's receiver measures it.
struct Signal {
  double phase_rad = 0.0;  ///< In [0, 2π).
  double rssi_dbm = 0.0;   ///< An integer.
};

/// Throws Error naming the parameter that is out of range or not finite.
void check(const PaperModel& model);

/// φ0 + 4πD/λ + `noise_rad`, in [0, 2π): eq. (4). Finite for every distance greater than 0.
double paper_phase(const PaperModel& model, double distance_m, double noise_rad);

/// round(40 log10 |G λ/(4πD) + noise|): eq. (5). The absolute value is taken because noise can make
/// the sum negative where the signal is weak, and the logarithm as printed undefined. Finite for
/// every distance greater than 0.
double paper_rssi_dbm(const PaperModel& model, double distance_m, double noise);

/// One reply: n_φ and n_RSSI are drawn from `noise`, n_optional from `optional_noise`.
Signal paper_signal(const PaperModel& model, const LinkGeometry& link, RandomStream& noise,
                    RandomStream& optional_noise);

}  // namespace tagfield
