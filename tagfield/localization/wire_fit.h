// SPDX-License-Identifier: Apache-2.0
/// @file
/// The direction of a tag's wire, fitted with its place to the phases that circular antennas
/// report.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/height_model.h"

namespace tagfield {

/// One tag's reads, and what of their antennas it takes to turn phases.
struct PolarizedReads {
  TagPhases phases;
  HeightModel height;
  std::vector<Eigen::Matrix3d> R_WA;  ///< By read.
  std::vector<double> hand;           ///< By read: 1 right, −1 left, 0 not circular.
  double multiple = 1.0;              ///< By which phases were multiplied.
};

/// The reads of the antennas that moved or whose offset is known, some 300 of many.
PolarizedReads polarized_reads(const LocalizationProblem& problem, const std::string& tag);

/// The antenna's hand, and its way; nothing where one of them is not known.
struct KnownHand {
  Hand hand;
  const BelievedTrack* track;
};
std::optional<KnownHand> known_hand(const LocalizationProblem& problem, const std::string& antenna);

/// 1 of the right hand, −1 of the left.
inline double sign_of(Hand hand) { return hand == Hand::kRight ? 1.0 : -1.0; }

/// E·e of the crossed wires in the direction of the unit vector `u_W`, of a tag's wire or, as it is
/// linear in that, of a change of it.
std::complex<double> crossed_wires_on(double hand, const Eigen::Matrix3d& R_WA,
                                      const Eigen::Vector3d& u_W, const Eigen::Vector3d& axis_W);

/// Place (x, y and the height's unknown), and the wire's direction along two tangents [rad].
using WireUnknowns = Eigen::Matrix<double, 5, 1>;

/// A place and a direction of the wire, with what they leave.
struct WirePoint {
  PlaceVector place = PlaceVector::Zero();
  Eigen::Vector3d axis_W = Eigen::Vector3d::UnitZ();
  Eigen::Matrix<double, 5, 5> normal =
      Eigen::Matrix<double, 5, 5>::Zero();       ///< [1/m² …], offsets eliminated.
  WireUnknowns gradient = WireUnknowns::Zero();  ///< Along which the misfit falls.
  Eigen::ArrayXd errors;                         ///< [m]
  double cost = 0.0;                             ///< Σ errors² [m²].
};

/// Of a candidate: the best fit near it, and those that are as good.
struct WireFits {
  std::vector<WirePoint> fits;  ///< Best first; empty where none is near.
  double noise_m2 = 0.0;        ///< Of an independent read.
};

/// Least squares from the place, with directions of the wire all around.
WireFits fit_wire(const PolarizedReads& reads, const Eigen::Vector3d& p_WT);

/// Whether the fit leaves no more than noise, little of it: reflections and pose errors bend phases
/// as wires do, and no wire is to be learnt from those. Differences of neighbours alone don't tell,
/// as what is reflected far away changes from read to read.
bool is_clean(const PolarizedReads& reads, const WirePoint& fit);

/// By where the place would be for directions all around, each as likely, against where no turn
/// puts it: mean square in x and y.
Eigen::Matrix2d added_by_any_wire(const PolarizedReads& reads, const Eigen::Vector3d& p_WT);

/// By how much the covariance of x and y grows [m²] with the wire's direction unknown, and by fits
/// that are as good elsewhere.
Eigen::Matrix2d added_by_wire(const WireFits& all);

}  // namespace tagfield
