// SPDX-License-Identifier: Apache-2.0
/// @file
/// People, robots and things that move, as waves see them: upright and simple of shape. See
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
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();     ///< Its middle [m].
  Eigen::Vector3d half_m = Eigen::Vector3d::Ones();  ///< Half of length, width and height.
  double yaw_rad = 0.0;                              ///< Of the length against x.
  bool is_round = false;                             ///< A cylinder, of radius half_m.x().
};

/// What of a wave from `from_W` to `to_W` [m] gets past the body, as a factor of its field: an
/// absorbing screen as wide and as high as the body looks, across the way, by Kirchhoff's integral;
/// what the body lets through besides. 1 where an end is in the body, as one that it carries.
std::complex<double> past_body(const MovingBody& body, const Eigen::Vector3d& from_W,
                               const Eigen::Vector3d& to_W, const Carrier& carrier);

/// The product over all legs of a path between these ends, and all bodies.
std::complex<double> past_bodies(const std::vector<MovingBody>& bodies, const RadioPath& path,
                                 const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
                                 const Carrier& carrier);
std::complex<double> past_bodies(const std::vector<MovingBody>& bodies, const DiffractedPath& path,
                                 const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
                                 const Carrier& carrier);

}  // namespace tagfield
