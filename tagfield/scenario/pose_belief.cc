// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/robot_spec.h"

namespace tagfield {

std::string to_string(PoseSource source) {
  switch (source) {
    case PoseSource::kTrue:
      return "true";
    case PoseSource::kNoisy:
      return "noisy";
    case PoseSource::kOdometry:
      return "odometry";
    case PoseSource::kSlam:
      return "slam";
  }
  return "";
}

}  // namespace tagfield
