// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/orientations.h"

#include "tagfield/base/units.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

std::vector<Eigen::Quaterniond> orientations_along_axes() {
  std::vector<Eigen::Quaterniond> all;
  for (const double roll : {0.0, 0.5 * kPi}) {
    for (const double yaw : {0.0, 0.5 * kPi, kPi, 1.5 * kPi}) {
      all.push_back(from_xyz_rpy({0, 0, 0}, {roll, 0.0, yaw}).rotation);
    }
    for (const double pitch : {-0.5 * kPi, 0.5 * kPi}) {
      all.push_back(from_xyz_rpy({0, 0, 0}, {roll, pitch, 0.0}).rotation);
    }
  }
  return all;
}

}  // namespace tagfield
