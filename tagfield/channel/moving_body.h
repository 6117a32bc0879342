// SPDX-License-Identifier: Apache-2.0
/// @file
/// Moving people, robots and objects as obstacles to waves: upright and of simple shape. See
/// docs/moving_bodies.md.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "tagfield/channel/material.h"
#include "tagfield/channel/path_gain.h"
#include "tagfield/propagation/diffraction.h"

namespace tagfield {

/// An upright cylinder, or a box.
struct MovingBody {
  std::string name;
  Material material;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();     ///< Its centre [m].
  Eigen::Vector3d half_m = Eigen::Vector3d::Ones();  ///< Half of length, width and height.
  double yaw_rad = 0.0;                              ///< Rotation of the length axis from x.
  bool is_round = false;                             ///< A cylinder, of radius half_m.x().
};

/// The factor by which the body changes the field of a wave from `from_W` to `to_W` [m]: an
/// absorbing screen across the path with the body's apparent width and height, by Kirchhoff's
/// integral, plus transmission through the body. 1 if an end is inside the body, e.g. because the
/// body carries it.
std::complex<double> past_body(const MovingBody& body, const Eigen::Vector3d& from_W,
                               const Eigen::Vector3d& to_W, const Carrier& carrier);

/// The product over all legs of a path between these ends, and over all bodies.
std::complex<double> past_bodies(const std::vector<MovingBody>& bodies, const RadioPath& path,
                                 const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
                                 const Carrier& carrier);
std::complex<double> past_bodies(const std::vector<MovingBody>& bodies, const DiffractedPath& path,
                                 const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
                                 const Carrier& carrier);

}  // namespace tagfield
