// SPDX-License-Identifier: Apache-2.0
/// @file
/// Parameterization of the error of the believed poses: for each body that carries antennas, the
/// error in x, y (and yaw) at knots in time, linear between them, with an Ornstein-Uhlenbeck prior.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Rigidly connected antennas, such as those of one robot.
struct Body {
  std::string reference;  ///< Its first antenna, the centre of rotation of the yaw error.
  std::vector<std::string> antennas;  ///< Including the reference.
};

/// The moving antennas of `problem`, grouped by body: antennas whose relative poses are constant
/// within 5 mm and 0.5° share a body. Stationary antennas belong to none: their positions are taken
/// as exact.
std::vector<Body> bodies_of(const LocalizationProblem& problem);

/// How the error of dead reckoning goes on from the previous knot: it stays, its yaw turns what the
/// reference antenna drives (displacement_of()), and something is added.
struct KnotStep {
  bool is_first = false;             ///< Of a body: the error was 0 before.
  Eigen::Vector2d driven{0.0, 0.0};  ///< Since the previous knot, as believed [m].
  /// Inverse covariance of what is added to x, y [m], yaw [rad], in the axes of the believed poses.
  Eigen::Matrix3d precision = Eigen::Matrix3d::Identity();
};

/// Knots of all bodies, body by body. The error at knot k is `scale[k]` u_k, where u is a process
/// of variance 1 with the correlation e^(−|Δt|/τ) for any interval Δt to the previous knot.
struct PoseKnots {
  /// Evenly spaced knots, at least two.
  struct Piece {
    Eigen::Index first = 0;
    Eigen::Index count = 0;
    double begin_s = 0.0;
    double spacing_s = 1.0;
    [[nodiscard]] double end_s() const;  ///< Time of the last knot.
  };
  /// Knots of one body. There are no reads between its pieces.
  struct Chain {
    std::string reference;
    std::vector<Piece> pieces;  ///< In time order, at least one.
  };
  int size = 2;  ///< Unknowns per knot: x, y or x, y, yaw.
  double time_constant_s = 5.0;
  std::vector<Chain> chains;
  std::map<std::string, std::size_t> chain_of;  ///< By antenna.
  std::vector<Eigen::Matrix3d> scale;           ///< Per knot; of x, y [m] and yaw [rad].
  /// Per knot, of poses by dead reckoning (drift_steps.h), with 3 unknowns per knot; otherwise
  /// empty, and the process is the one above.
  std::vector<KnotStep> steps;

  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(scale.size()); }
  /// Correlation of each knot with the previous one; 0 for a body's first, and an extra 0 at the
  /// end.
  [[nodiscard]] Eigen::ArrayXd correlations() const;
};

/// Knots at most `spacing_s` apart during the reads, none in pauses longer than the model's time
/// constant (or `spacing_s`, if greater): no read constrains the error there, and the knots at both
/// ends are correlated anyway. So a read adds at most as many knots as fit into a time constant,
/// however far reads are apart. If `model` is null, the covariances of the tracks are those of the
/// process; otherwise `model` gives its variances. Without bodies, or with σ = 0, there are no
/// knots, and none of bodies without drift if others drift: their poses are exact.
PoseKnots make_knots(const LocalizationProblem& problem, const PoseErrorModel* model,
                     double spacing_s);

/// The knots with standard deviations multiplied by `factor`.
PoseKnots scaled(PoseKnots knots, double factor);

/// The true lever, R(−yaw error) times the believed one [m].
inline Eigen::Vector2d true_lever(const Eigen::Vector2d& believed, double yaw_error_rad) {
  return Eigen::Rotation2Dd(-yaw_error_rad) * believed;
}

/// Believed minus true position of an antenna [m] at a lever from its body's reference, believed
/// too; `error` of the reference in x, y [m] and yaw [rad]. Exact: at a yaw error of 5° and a lever
/// of half a metre the second order is 2 mm, which phases resolve.
inline Eigen::Vector2d displacement_of(const Eigen::Vector3d& error, const Eigen::Vector2d& lever) {
  return error.head<2>() + lever - true_lever(lever, error.z());
}

/// Interpolation in a chain at a given time, between knot `at` and the next: the error is the sum
/// of the errors at the two knots, weighted by `before` and `after`. Linear, except in a pause,
/// where it is the mean of the process given both knots. Constant before the first knot and after
/// the last.
struct KnotPlace {
  Eigen::Index at = 0;
  double before = 1.0;
  double after = 0.0;
};
KnotPlace place_in(const PoseKnots& knots, const PoseKnots::Chain& chain, double time_s);

/// Error in x, y, yaw at a time; `u` has `size` entries per knot.
Eigen::Vector3d error_at(const PoseKnots& knots, const Eigen::VectorXd& u,
                         const PoseKnots::Chain& chain, double time_s);

/// Poses of all antennas, with the error removed for those on bodies.
std::vector<AntennaPose> corrected_poses(const LocalizationProblem& problem, const PoseKnots& knots,
                                         const Eigen::VectorXd& u);

/// Samples with the error removed from their antenna positions.
SamplesOfTag corrected_samples(const LocalizationProblem& problem, const PoseKnots& knots,
                               const Eigen::VectorXd& u, const SamplesOfTag& samples);

}  // namespace tagfield
