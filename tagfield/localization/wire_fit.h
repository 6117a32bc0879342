// SPDX-License-Identifier: Apache-2.0
/// @file
/// Fit of the direction of a tag's wire, together with its position, to the phases reported by
/// circularly polarized antennas.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/height_model.h"

namespace tagfield {

/// One tag's reads, with the orientation and handedness of their antennas.
struct PolarizedReads {
  TagPhases phases;
  HeightModel height;
  std::vector<Eigen::Matrix3d> R_WA;  ///< By read.
  std::vector<double> hand;           ///< By read: 1 right, −1 left, 0 not circular.
  double multiple = 1.0;              ///< Factor by which phases were multiplied.
};

/// The reads of the antennas that moved or whose offset is known, thinned to at most about 300.
PolarizedReads polarized_reads(const LocalizationProblem& problem, const std::string& tag);

/// Handedness and track of an antenna. known_hand() returns nullopt if the handedness or the
/// orientation is unknown.
struct KnownHand {
  Hand hand;
  const BelievedTrack* track;
};
std::optional<KnownHand> known_hand(const LocalizationProblem& problem, const std::string& antenna);

/// 1 for right-handed, −1 for left-handed.
inline double sign_of(Hand hand) { return hand == Hand::kRight ? 1.0 : -1.0; }

/// Field E of the crossed wires in the direction of the unit vector `u_W`, projected onto a tag's
/// wire: E·e. As it is linear in the wire's direction, it also gives the change of E·e with that
/// direction.
std::complex<double> crossed_wires_on(double hand, const Eigen::Matrix3d& R_WA,
                                      const Eigen::Vector3d& u_W, const Eigen::Vector3d& axis_W);

/// Position (x, y and the unknown of the height), and the wire's direction along two tangents
/// [rad].
using WireUnknowns = Eigen::Matrix<double, 5, 1>;

/// A position and a direction of the wire, with the residuals.
struct WirePoint {
  PositionVector place = PositionVector::Zero();
  Eigen::Vector3d axis_W = Eigen::Vector3d::UnitZ();
  Eigen::Matrix<double, 5, 5> normal =
      Eigen::Matrix<double, 5, 5>::Zero();  ///< [1/m² …], offsets eliminated.
  /// Right-hand side of the normal equations: along it the misfit decreases.
  WireUnknowns gradient = WireUnknowns::Zero();
  Eigen::ArrayXd errors;  ///< [m]
  double cost = 0.0;      ///< Σ errors² [m²].
};

/// Fits near a candidate.
struct WireFits {
  std::vector<WirePoint> fits;  ///< Best first; empty if none converged nearby.
  double noise_m2 = 0.0;        ///< Noise variance of an independent read.
};

/// Least squares started from the position, with wire directions all around; and from beside it if
/// the height is estimated and none of these is clean.
WireFits fit_wire(const PolarizedReads& reads, const Eigen::Vector3d& p_WT);

/// Whether the fit leaves nothing but noise, and little of it. Reflections and pose errors bias
/// phases as wires do, and a wire must not be fitted to those. Differences of neighbours alone
/// don't suffice, because the effect of distant reflectors changes from read to read.
bool is_clean(const PolarizedReads& reads, const WirePoint& fit);

/// Mean square shift of the position [m²] due to a wire of unknown direction, over equally likely
/// directions all around. Vertical entries are 0 if the height is known.
Eigen::Matrix3d added_by_any_wire(const PolarizedReads& reads, const Eigen::Vector3d& p_WT);

/// Increase of the position's covariance [m²] due to the unknown direction of the wire, and to
/// other fits that are nearly as good. Vertical entries are 0 if the height is known.
Eigen::Matrix3d added_by_wire(const HeightModel& height, const WireFits& all);

}  // namespace tagfield
