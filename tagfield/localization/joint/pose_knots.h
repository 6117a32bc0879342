/// @file
/// The error of the believed poses as unknowns: of each body that carries antennas, the error in x,
/// y (and yaw) at knots in time, straight between them, an Ornstein-Uhlenbeck process beforehand.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Antennas that move as one, such as those of one robot.
struct Body {
  std::string reference;              ///< Its first antenna, about which the yaw's error turns it.
  std::vector<std::string> antennas;  ///< The reference among them.
};

/// The moving antennas of `problem` by body: those whose poses to each other stay the same within
/// 5 mm and 0.5° are on one. Antennas that stand still are on none: their places are taken as
/// exact.
std::vector<Body> bodies_of(const LocalizationProblem& problem);

/// Knots of all bodies, one body after the other. The error at knot k is `scale[k]` u_k, where u is
/// a process of variance 1 with the correlation e^(−|Δt|/τ).
struct PoseKnots {
  struct Chain {
    std::string reference;
    Eigen::Index first = 0;
    Eigen::Index count = 0;
    double begin_s = 0.0;
    double spacing_s = 1.0;
  };
  int size = 2;  ///< Unknowns of a knot: x, y or x, y, yaw.
  double time_constant_s = 5.0;
  std::vector<Chain> chains;
  std::map<std::string, std::size_t> chain_of;  ///< By antenna.
  std::vector<Eigen::Matrix3d> scale;           ///< By knot; of x, y [m] and yaw [rad].

  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(scale.size()); }
  /// Correlation of neighbours in this chain.
  [[nodiscard]] double correlation(const Chain& chain) const;
};

/// Knots at most `spacing_s` apart over the time of the reads. Where the tracks tell covariances
/// and `model` is null, these are the process' variances; else those of `model`. Without bodies, or
/// with σ = 0, there are no knots.
PoseKnots make_knots(const LocalizationProblem& problem, const PoseErrorModel* model,
                     double spacing_s);

/// Standard deviations multiplied by `factor`.
PoseKnots scaled(PoseKnots knots, double factor);

/// Where an antenna is in a chain at a time: between knot `at` and the next, `weight` of the way.
struct KnotPlace {
  Eigen::Index at = 0;
  double weight = 0.0;
};
KnotPlace place_in(const PoseKnots::Chain& chain, double time_s);

/// Error in x, y, yaw at a time; `u` has `size` entries a knot.
Eigen::Vector3d error_at(const PoseKnots& knots, const Eigen::VectorXd& u,
                         const PoseKnots::Chain& chain, double time_s);

/// Poses with their error taken out, of the antennas on bodies; others stay as they are.
std::vector<AntennaPose> corrected_poses(const LocalizationProblem& problem, const PoseKnots& knots,
                                         const Eigen::VectorXd& u);

/// Samples with their antennas' places freed of the error.
SamplesOfTag corrected_samples(const LocalizationProblem& problem, const PoseKnots& knots,
                               const Eigen::VectorXd& u, const SamplesOfTag& samples);

}  // namespace tagfield
