// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/wave_slopes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "made_reads.h"

namespace tagfield {
namespace {

TagPhases phases_drawn(made::Rng& rng, Eigen::Index count) {
  TagPhases phases;
  resize(phases, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    phases.x[i] = made::uniform(rng, -8.0, 8.0);
    phases.y[i] = made::uniform(rng, -8.0, 8.0);
    phases.z[i] = made::uniform(rng, 0.2, 2.0);
    phases.value[i] = made::uniform(rng, 0.0, 12.0);
    phases.wavenumber[i] = made::uniform(rng, 34.0, 80.0);
  }
  return phases;
}

struct OnePosition {
  TagPhases phases;
  Aperture part;
  HeightModel height;
  PositionVector place;
};

OnePosition drawn_position() {
  made::Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto count = *rc::gen::inRange<Eigen::Index>(1, 60);
  OnePosition one{phases_drawn(rng, count), {}, {}, {}};
  one.part.begin = *rc::gen::inRange<Eigen::Index>(0, count);
  one.part.count = *rc::gen::inRange<Eigen::Index>(0, count - one.part.begin + 1);
  one.height.kind = *rc::gen::element(HeightModel::Kind::kKnown, HeightModel::Kind::kLevel,
                                      HeightModel::Kind::kFree);
  one.height.z = made::uniform(rng, 0.0, 2.0);
  one.place << made::uniform(rng, -8.0, 8.0), made::uniform(rng, -8.0, 8.0),
      made::uniform(rng, 0.1, 3.0);
  if (*rc::gen::inRange(0, 3) == 0) {  // So near that the direction is undefined.
    one.place.head<2>() << one.phases.x[0] + 1e-3, one.phases.y[0];
  }
  if (one.height.kind == HeightModel::Kind::kKnown) one.place[2] = 0.0;
  return one;
}

RC_GTEST_PROP(WaveSlopes, AreThoseOfOneReadAfterTheOther, ()) {
  const OnePosition one = drawn_position();
  WaveSlopes expected;
  for (Eigen::Index i = one.part.begin; i < one.part.begin + one.part.count; ++i) {
    const TagPhases& phases = one.phases;
    const Range range = range_to(one.height, one.place, phases.x[i], phases.y[i], phases.z[i]);
    const double angle = phases.wavenumber[i] * (phases.value[i] - range.r);
    const PositionVector slope = phases.wavenumber[i] * range.gradient;
    expected.sum += std::polar(1.0, angle);
    expected.in_phase += std::cos(angle) * slope;
    expected.quadrature += std::sin(angle) * slope;
    expected.slopes += slope;
    expected.squares += slope * slope.transpose();
  }
  const WaveSlopes slopes = wave_slopes(one.phases, one.part, one.height, one.place);
  // For up to sixty reads with up to 80 rad/m, or 4,000 with respect to q if the range is 1 cm.
  RC_ASSERT(std::abs(slopes.sum - expected.sum) < 1e-11);
  RC_ASSERT((slopes.in_phase - expected.in_phase).norm() < 1e-9);
  RC_ASSERT((slopes.quadrature - expected.quadrature).norm() < 1e-9);
  RC_ASSERT((slopes.slopes - expected.slopes).norm() < 1e-9);
  RC_ASSERT((slopes.squares - expected.squares).norm() <= 1e-12 * expected.squares.norm());
  RC_ASSERT(wave_sum(one.phases, one.part, one.height, one.place) == slopes.sum);
}

RC_GTEST_PROP(WaveSlopes, AreTheSameBitsForEachSetOfInstructions, ()) {
  const OnePosition one = drawn_position();
  const auto by = [&](InstructionSet set) {
    return wave_slopes(one.phases, one.part, one.height, one.place, set);
  };
  const WaveSlopes plain = by(InstructionSet::kBaseline);
  for (const InstructionSet set : instruction_sets()) {
    const WaveSlopes slopes = by(set);
    RC_ASSERT(slopes.sum == plain.sum);
    RC_ASSERT(slopes.in_phase == plain.in_phase);
    RC_ASSERT(slopes.quadrature == plain.quadrature);
    RC_ASSERT(slopes.slopes == plain.slopes);
    RC_ASSERT(slopes.squares == plain.squares);
    RC_ASSERT(wave_sum(one.phases, one.part, one.height, one.place, set) == plain.sum);
  }
}

}  // namespace
}  // namespace tagfield
