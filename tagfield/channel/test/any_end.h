// SPDX-License-Identifier: Apache-2.0
/// @file
/// Ends of links at random.
#pragma once

#include <array>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/antenna_pattern.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

inline double between(RandomStream& stream, double low, double high) {
  return low + (high - low) * uniform(stream);
}

inline RigidTransform any_pose(RandomStream& stream) {
  const Eigen::Vector3d p(between(stream, -9.0, 9.0), between(stream, -9.0, 9.0),
                          between(stream, 0.0, 3.0));
  const Eigen::Vector3d rpy(between(stream, -kPi, kPi), between(stream, -1.5, 1.5),
                            between(stream, -kPi, kPi));
  return from_xyz_rpy(p, rpy);
}

inline AntennaPattern any_pattern(RandomStream& stream) {
  AntennaPattern pattern;
  const std::array shapes = {PatternShape::kIsotropic, PatternShape::kPatch, PatternShape::kDipole,
                             PatternShape::kTable};
  const std::array kinds = {PolarizationKind::kLinear, PolarizationKind::kRightCircular,
                            PolarizationKind::kLeftCircular};
  pattern.shape = shapes[stream() % shapes.size()];
  pattern.polarization = kinds[stream() % kinds.size()];
  pattern.gain_dbi = between(stream, -3.0, 12.0);
  pattern.beam_width_rad = radians(between(stream, 10.0, 120.0));
  pattern.vertical_beam_width_rad =
      stream() % 2 == 0 ? pattern.beam_width_rad : radians(between(stream, 10.0, 120.0));
  pattern.tilt_rad = between(stream, -kPi, kPi);
  pattern.table = {{0.0, 8.0, 8.0}, {0.5, 5.0, 3.0}, {kPi, -12.0, -9.0}};
  return pattern;
}

}  // namespace tagfield
