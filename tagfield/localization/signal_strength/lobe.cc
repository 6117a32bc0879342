// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/lobe.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {

AimedLobe aimed(const Lobe& lobe, const Eigen::Vector3d& boresight_W) {
  if (lobe.beam_width_deg <= 0.0) return {};
  // At half the width, cosⁿ is half the power.
  const double n = std::log(0.5) / std::log(std::cos(0.5 * radians(lobe.beam_width_deg)));
  return {boresight_W.normalized(), n, -lobe.front_to_back_db};
}

double lobe_db(const AimedLobe& lobe, const Eigen::Vector3d& way_W) {
  if (lobe.exponent == 0.0) return 0.0;
  const double cosine = lobe.boresight_W.dot(way_W.normalized());
  if (!(cosine > 0.0)) return 2.0 * lobe.least_db;
  return 2.0 * std::max(10.0 * lobe.exponent * std::log10(cosine), lobe.least_db);
}

double lobe_db(const Lobe& lobe, const Eigen::Vector3d& boresight_W, const Eigen::Vector3d& way_W) {
  return lobe_db(aimed(lobe, boresight_W), way_W);
}

}  // namespace tagfield
