// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pi_ambiguity.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kFrequency = 865.7e6;

/// Reads by an antenna that passes a tag in steps of `step_m`.
SamplesByTag passing(double step_m, double noise_rad, bool pi_ambiguity, std::uint64_t seed) {
  SamplesByTag samples;
  RandomStream stream(seed, Purpose::kReadNoise);
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d p(step_m * (i - 200), 0.0, 1.0);
    const double distance = (p - Eigen::Vector3d(0.3, 2.0, 1.2)).norm();
    double phase = 4.0 * kPi * distance / wavelength(kFrequency);
    phase += noise_rad * standard_normal(stream);
    if (pi_ambiguity && (stream() & 1U) != 0) phase += kPi;
    samples["tag"]["antenna"].push_back({Time(Duration(i)), wrap_to_two_pi(phase), kFrequency, p});
  }
  return samples;
}

RC_GTEST_PROP(PiAmbiguity, AreFoundWhereTheyAreAndNowhereElse, ()) {
  const double step = 0.0001 * *rc::gen::inRange(10, 210);
  const double noise = 0.01 * *rc::gen::inRange(0, 31);
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  RC_ASSERT(has_pi_ambiguity(passing(step, noise, true, seed)));
  RC_ASSERT(!has_pi_ambiguity(passing(step, noise, false, seed)));
}

TEST(PiAmbiguity, AreNotClaimedWhereStepsAreTooLongToTell) {
  EXPECT_FALSE(has_pi_ambiguity(passing(0.05, 0.1, true, 1)));
  EXPECT_FALSE(has_pi_ambiguity({}));
}

TEST(DoublePhases, GivesThePhaseOfHalfTheWavelengthWhateverThePiAmbiguity) {
  SamplesByTag with = passing(0.01, 0.0, true, 3);
  double_phases(with);
  for (const PhaseSample& sample : with["tag"]["antenna"]) {
    const double distance = (sample.p_WA - Eigen::Vector3d(0.3, 2.0, 1.2)).norm();
    const double expected = 4.0 * kPi * distance / wavelength(2.0 * kFrequency);
    EXPECT_EQ(sample.frequency_hz, 2.0 * kFrequency);
    EXPECT_NEAR(wrap_to_pi(sample.phase_rad - expected), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace tagfield
