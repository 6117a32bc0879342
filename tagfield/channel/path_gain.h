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

/// What is taken into account. Each can be left out by itself, so that an error can be traced to
/// its cause.
struct ChannelEffects {
  bool patterns = true;      ///< Gain over direction; else the greatest gain everywhere.
  bool polarization = true;  ///< Of both ends; else they are taken to fit.
};

/// An antenna at one end of a link.
struct RadioEnd {
  const AntennaPattern& pattern;
  const RigidTransform& X_WA;
};

/// The world at one carrier.
struct Carrier {
  double lambda_m = 0.0;
  double wave_number = 0.0;                        ///< 2π/λ [rad/m].
  std::vector<std::complex<double>> permittivity;  ///< Of the world's materials.
};

Carrier carrier_in(const RadioWorld& world, double frequency_hz);

/// Complex amplitude gain h_i of one path, antennas included: received over transmitted power is
/// |Σ h_i|², and its phase is the received field's, −2πd/λ for a free way. Reciprocal.
std::complex<double> path_gain(const RadioPath& path, const RadioEnd& antenna, const RadioEnd& tag,
                               const RadioWorld& world, const Carrier& carrier,
                               const ChannelEffects& effects);

/// Likewise of the straight way through free space, without a RadioPath. 0 where both ends are in
/// one place.
std::complex<double> free_space_gain(const RadioEnd& antenna, const RadioEnd& tag,
                                     const Carrier& carrier, const ChannelEffects& effects);

/// Σ of path_gain() over the paths that are not blocked.
std::complex<double> one_way_gain(const std::vector<RadioPath>& paths, const RadioEnd& antenna,
                                  const RadioEnd& tag, const RadioWorld& world,
                                  const Carrier& carrier, const ChannelEffects& effects);

/// A path's budget: what its gain is made of [dB]. Their sum is the gain's.
struct PathBudget {
  double spreading_db = 0.0;        ///< (λ/4πd)².
  double antenna_db = 0.0;          ///< Antenna's gain towards where the path leaves.
  double tag_db = 0.0;              ///< Tag's gain towards where it comes from.
  std::vector<double> bounce_db;    ///< Of each bounce, as what it does to the field's length.
  std::vector<double> crossing_db;  ///< Of each crossing.
  double polarization_db = 0.0;     ///< What the tag does not take in of the field that arrives.
};

PathBudget path_budget(const RadioPath& path, const RadioEnd& antenna, const RadioEnd& tag,
                       const RadioWorld& world, const Carrier& carrier,
                       const ChannelEffects& effects);

}  // namespace tagfield
