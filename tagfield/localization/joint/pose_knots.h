// SPDX-License-Identifier: Apache-2.0
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
/// a process of variance 1 with the correlation e^(−|Δt|/τ), of whatever Δt to the knot before.
struct PoseKnots {
  /// Evenly spaced knots, at least two.
  struct Piece {
    Eigen::Index first = 0;
    Eigen::Index count = 0;
    double begin_s = 0.0;
    double spacing_s = 1.0;
    [[nodiscard]] double end_s() const;  ///< Time of the last knot.
  };
  /// Of one body. Between its pieces there are no reads.
  struct Chain {
    std::string reference;
    std::vector<Piece> pieces;  ///< In order of time, at least one.
  };
  int size = 2;  ///< Unknowns of a knot: x, y or x, y, yaw.
  double time_constant_s = 5.0;
  std::vector<Chain> chains;
  std::map<std::string, std::size_t> chain_of;  ///< By antenna.
  std::vector<Eigen::Matrix3d> scale;           ///< By knot; of x, y [m] and yaw [rad].

  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(scale.size()); }
  /// Of each knot with the one before it; 0 of a body's first, and one 0 more at the end.
  [[nodiscard]] Eigen::ArrayXd correlations() const;
};

/// Knots at most `spacing_s` apart over the time of the reads, none in pauses longer than the
/// model's time constant (or `spacing_s`, if greater): no read is there to tell of the error, and
/// the knots at both ends are correlated all the same. So a read brings at most as many knots as
/// go into a time constant, however much time lies between two of them. Where the tracks tell
/// covariances and `model` is null, these are the process' variances; else those of `model`.
/// Without bodies, or with σ = 0, there are no knots.
PoseKnots make_knots(const LocalizationProblem& problem, const PoseErrorModel* model,
                     double spacing_s);

/// Standard deviations multiplied by `factor`.
PoseKnots scaled(PoseKnots knots, double factor);

/// Where an antenna is in a chain at a time: between knot `at` and the next. The error is so much
/// of the one `before` and of the one `after`; straight between them, but in a pause, the mean of
/// the process given both. Before the first knot and after the last, as there.
struct KnotPlace {
  Eigen::Index at = 0;
  double before = 1.0;
  double after = 0.0;
};
KnotPlace place_in(const PoseKnots& knots, const PoseKnots::Chain& chain, double time_s);

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
