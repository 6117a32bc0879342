// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/lobe.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {

double lobe_db(const Lobe& lobe, const Eigen::Vector3d& boresight_W, const Eigen::Vector3d& way_W) {
  if (lobe.beam_width_deg <= 0.0) return 0.0;
  const double cosine = boresight_W.normalized().dot(way_W.normalized());
  // At half the width, cosⁿ is half the power.
  const double n = std::log(0.5) / std::log(std::cos(0.5 * radians(lobe.beam_width_deg)));
  const double least = -lobe.front_to_back_db;
  if (!(cosine > 0.0)) return 2.0 * least;
  return 2.0 * std::max(10.0 * n * std::log10(cosine), least);
}

}  // namespace tagfield
