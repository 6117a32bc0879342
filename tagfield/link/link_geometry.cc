#include "tagfield/link/link_geometry.h"

#include <algorithm>

namespace tagfield {

LinkGeometry link_between(const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT) {
  constexpr double kLeastDistance = 1e-6;
  return {std::max((p_WT - p_WA).norm(), kLeastDistance)};
}

}  // namespace tagfield
