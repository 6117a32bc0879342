// SPDX-License-Identifier: Apache-2.0
/// @file
/// One-way gain of a link: the sum over its paths in eq. (1) of the paper. See docs/multipath.md.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "tagfield/channel/antenna_pattern.h"
#include "tagfield/channel/radio_world.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/propagation/radio_path.h"

namespace tagfield {

/// The simulated effects. Each can be switched off independently, so that an error can be traced to
/// its cause.
struct ChannelEffects {
  bool patterns = true;      ///< Directional gain; else the peak gain in all directions.
  bool polarization = true;  ///< Of both ends; else assumed to match.
};

/// An antenna at one end of a link.
struct RadioEnd {
  const AntennaPattern& pattern;
  const RigidTransform& X_WA;
};

/// The world at one carrier frequency.
struct Carrier {
  double lambda_m = 0.0;
  double wave_number = 0.0;                        ///< 2π/λ [rad/m].
  std::vector<std::complex<double>> permittivity;  ///< Of each of the world's materials.
};

Carrier carrier_in(const RadioWorld& world, double frequency_hz);

/// Complex amplitude gain h_i of one path, including antennas: received over transmitted power is
/// |Σ h_i|², and the phase is that of the received field, −2πd/λ in free space. Reciprocal.
std::complex<double> path_gain(const RadioPath& path, const RadioEnd& antenna, const RadioEnd& tag,
                               const RadioWorld& world, const Carrier& carrier,
                               const ChannelEffects& effects);

/// Same for the direct path in free space, without a RadioPath. 0 if both ends coincide.
std::complex<double> free_space_gain(const RadioEnd& antenna, const RadioEnd& tag,
                                     const Carrier& carrier, const ChannelEffects& effects);

/// Σ of path_gain() over the unblocked paths.
std::complex<double> one_way_gain(const std::vector<RadioPath>& paths, const RadioEnd& antenna,
                                  const RadioEnd& tag, const RadioWorld& world,
                                  const Carrier& carrier, const ChannelEffects& effects);

/// Link budget of a path: the factors of its gain [dB], whose sum is the gain.
struct PathBudget {
  double spreading_db = 0.0;        ///< (λ/4πd)².
  double antenna_db = 0.0;          ///< The antenna's gain in the path's direction of departure.
  double tag_db = 0.0;              ///< The tag's gain in the path's direction of arrival.
  std::vector<double> bounce_db;    ///< Of each reflection: its effect on the field's magnitude.
  std::vector<double> crossing_db;  ///< Of each crossing.
  double polarization_db = 0.0;     ///< Polarization loss of the arriving field at the tag.
};

PathBudget path_budget(const RadioPath& path, const RadioEnd& antenna, const RadioEnd& tag,
                       const RadioWorld& world, const Carrier& carrier,
                       const ChannelEffects& effects);

}  // namespace tagfield
