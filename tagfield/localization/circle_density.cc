// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/circle_density.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/units.h"

namespace tagfield {

OnCircle log_density(const PhaseDifference& of, InstructionSet set) {
  constexpr auto kCount = static_cast<std::size_t>(kCircleBins);
  constexpr auto kTurn = static_cast<float>(kTwoPi);
  constexpr float kToWhole = 0x1.8p23f;
  const float step = kTurn / static_cast<float>(kCount);
  const float scale = (1.0f - of.arbitrary) / (of.sigma * std::sqrt(kTurn));
  const float any = of.arbitrary / kTurn;
  const float inverse = 1.0f / of.sigma;
  const float rad = of.rad;
  OnCircle density;
  double* const out = density.data();
  in_lanes(set, [&] {
#pragma GCC ivdep
    for (std::size_t i = 0; i < kCount; ++i) {
      const float off = step * static_cast<float>(static_cast<int>(i)) - rad;
      const float turns = (off * (1.0f / kTurn) + kToWhole) - kToWhole;
      const float sigmas = (off - kTurn * turns) * inverse;
      const float sum = scale * lane_exp(-0.5f * sigmas * sigmas) + any;
      out[i] = static_cast<double>(lane_log(sum));
    }
  });
  return density;
}

}  // namespace tagfield
