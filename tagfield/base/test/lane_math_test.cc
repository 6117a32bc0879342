// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/lane_math.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/base/random.h"

namespace tagfield {
namespace {

constexpr int kDraws = 200'000;

std::uint64_t any_word() { return *rc::gen::arbitrary<std::uint64_t>(); }
double any_in(RandomStream& stream, double low, double high) {
  return low + (high - low) * uniform(stream);
}

/// The error of `value` against `exact`, in units of the last place of a double there.
double units_off(double value, long double exact) {
  const double nearest = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) /
                             static_cast<long double>(unit));
}

TEST(LaneLog, IsTheLogarithmWithinOneUnit) {
  RandomStream stream(1, Purpose::kReadNoise);
  double worst = 0.0;
  double worst_10 = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    // Over all exponents, near 1, and over (0, 1], as needed for noise.
    const double spread =
        std::ldexp(1.0 + uniform(stream), static_cast<int>(stream() % 2045) - 1022);
    for (const double x : {spread, any_in(stream, 0.7, 1.5), uniform_above_0(stream)}) {
      const auto exact = static_cast<long double>(x);
      worst = std::max(worst, units_off(lane_log(x), std::log(exact)));
      worst_10 = std::max(worst_10, units_off(lane_log10(x), std::log10(exact)));
    }
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_LT(worst_10, 3.0);
  EXPECT_EQ(lane_log(1.0), 0.0);
  EXPECT_EQ(lane_log10(1.0), 0.0);
}

TEST(LaneLog, IsTheLogarithmWithinTwoUnitsInSinglePrecision) {
  RandomStream stream(2, Purpose::kReadNoise);
  constexpr float kMost = std::numeric_limits<float>::infinity();
  double worst = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double spread = std::ldexp(1.0 + uniform(stream), static_cast<int>(stream() % 253) - 126);
    for (const double at : {spread, any_in(stream, 0.7, 1.5), 1e-30 + uniform_above_0(stream)}) {
      const auto x = static_cast<float>(at);
      const double exact = std::log(static_cast<double>(x));
      const auto nearest = static_cast<float>(std::abs(exact));
      const double unit = static_cast<double>(std::nextafter(nearest, kMost) - nearest);
      worst = std::max(worst, std::abs(static_cast<double>(lane_log(x)) - exact) / unit);
    }
  }
  EXPECT_LT(worst, 2.0);
  EXPECT_EQ(lane_log(1.0f), 0.0f);
}

TEST(LaneExp, IsTheExponentialWithinTwoUnits) {
  RandomStream stream(4, Purpose::kReadNoise);
  double worst = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    for (const double x : {any_in(stream, -700.0, 700.0), any_in(stream, -1.0, 1.0)}) {
      worst = std::max(worst, units_off(lane_exp(x), std::exp(static_cast<long double>(x))));
    }
  }
  EXPECT_LT(worst, 2.0);
  EXPECT_EQ(lane_exp(0.0), 1.0);
  EXPECT_EQ(lane_exp(-1e9), lane_exp(-700.0));
}

TEST(LaneExp, IsTheExponentialWithinTwoUnitsInSinglePrecision) {
  RandomStream stream(4, Purpose::kReadNoise);
  constexpr float kMost = std::numeric_limits<float>::infinity();
  double worst = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    for (const double at : {any_in(stream, -80.0, 80.0), any_in(stream, -1.0, 1.0)}) {
      const auto x = static_cast<float>(at);
      const double exact = std::exp(static_cast<double>(x));
      const auto nearest = static_cast<float>(exact);
      const double unit = static_cast<double>(std::nextafter(nearest, kMost) - nearest);
      worst = std::max(worst, std::abs(static_cast<double>(lane_exp(x)) - exact) / unit);
    }
  }
  EXPECT_LT(worst, 2.0);
  EXPECT_EQ(lane_exp(0.0f), 1.0f);
  EXPECT_EQ(lane_exp(-1e9f), lane_exp(-80.0f));
}

TEST(LaneSineCosine, AreThoseWithinOneUnit) {
  RandomStream stream(2, Purpose::kReadNoise);
  double worst = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double near_quarter = 0.5 * kPi * static_cast<double>(stream() % 64'000) - 1.6e4 * kPi;
    for (const double x : {any_in(stream, -kPi, kPi), any_in(stream, -1e5, 1e5), near_quarter,
                           any_in(stream, -1e-9, 1e-9)}) {
      const auto exact = static_cast<long double>(x);
      const SineCosine found = lane_sine_cosine(x);
      // Near its zeros, the x87's own sine has an error of 2⁻⁶⁴ of the angle, because its π is not
      // exact.
      const double blur = std::abs(x) * 0x1p-64;
      const auto off = [&](double value, long double reference) {
        const auto error =
            static_cast<double>(std::abs(static_cast<long double>(value) - reference));
        return error <= blur ? 0.0 : units_off(value, reference);
      };
      worst =
          std::max({worst, off(found.sine, std::sin(exact)), off(found.cosine, std::cos(exact))});
    }
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_EQ(lane_sine_cosine(0.0).sine, 0.0);
  EXPECT_EQ(lane_sine_cosine(0.0).cosine, 1.0);
}

TEST(LaneArcTangent, IsTheAngleWithinFourUnits) {
  RandomStream stream(4, Purpose::kReadNoise);
  double worst = 0.0;
  const auto see = [&](double y, double x) {
    const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    worst = std::max(worst, units_off(lane_arc_tangent(y, x), exact));
  };
  for (int i = 0; i < kDraws; ++i) {
    const double size = std::pow(10.0, any_in(stream, -290.0, 290.0));
    const double tiny = std::pow(10.0, any_in(stream, -17.0, 0.0));
    // Everywhere, close to the axes, and on both sides of the bounds of the pieces.
    const double bound = (i % 2 == 0 ? std::sqrt(5.0) - 2.0 : 0.72075922005612644);
    for (const double y : {any_in(stream, -1.0, 1.0), tiny, bound - tiny, bound + tiny}) {
      for (const double x : {any_in(stream, -1.0, 1.0), 1.0, -1.0, y}) {
        see(size * y, size * x);
        see(size * x, -size * y);
      }
    }
  }
  EXPECT_LT(worst, 4.0);
}

TEST(LaneArcTangent, HasTheStandardsSignsAtZeros) {
  for (const double y : {0.0, -0.0, 1.0, -1.0}) {
    for (const double x : {0.0, -0.0, 2.0, -2.0}) {
      if (std::abs(y) > 0.0 && std::abs(x) > 0.0) continue;
      EXPECT_EQ(bits_of(lane_arc_tangent(y, x)), bits_of(std::atan2(y, x))) << y << " " << x;
    }
  }
}

RC_GTEST_PROP(LaneDouble, IsTheConversion, ()) {
  const std::uint64_t word = any_word() >> (*rc::gen::inRange(0, 64));
  RC_ASSERT(lane_double(word) == static_cast<double>(word));
  RC_ASSERT(lane_double(~word) == static_cast<double>(~word));
  RC_ASSERT(lane_double_signed(word) == static_cast<double>(static_cast<std::int64_t>(word)));
  RC_ASSERT(lane_double_signed(~word) == static_cast<double>(static_cast<std::int64_t>(~word)));
}

RC_GTEST_PROP(LaneRound, IsTheStandardLibrarys, ()) {
  const double halves = 0.5 * (*rc::gen::inRange(-20'000, 20'000));
  for (const double x : {halves, std::nextafter(halves, 1e9), std::nextafter(halves, -1e9),
                         halves + 1e-3 * (*rc::gen::inRange(-500, 500))}) {
    RC_ASSERT(lane_round(x) == std::round(x));
    RC_ASSERT(lane_round(x) != 0.0 || !std::signbit(lane_round(x)));
  }
}

RC_GTEST_PROP(LaneRemainder, IsFmodToTheLastBit, ()) {
  RandomStream stream(any_word(), Purpose::kReadNoise);
  for (int i = 0; i < 100; ++i) {
    const double y = any_in(stream, 1e-3, 10.0);
    const double whole = std::floor(any_in(stream, 0.0, i % 2 == 0 ? 8.0 : 0x1p20 - 1.0));
    for (const double x :
         {any_in(stream, 0.0, 0x1p20 * y), whole * y, std::nextafter(whole * y, 1e300),
          std::max(0.0, std::nextafter(whole * y, -1.0))}) {
      if (x >= 0x1p20 * y) continue;
      RC_ASSERT(lane_remainder(x, y) == std::fmod(x, y));
    }
  }
}

RC_GTEST_PROP(LaneWrapToTwoPi, IsWrapToTwoPiWithinItsTurns, ()) {
  RandomStream stream(any_word(), Purpose::kReadNoise);
  const double at = kTwoPi * (*rc::gen::inRange(0, 3));
  for (const double x : {any_in(stream, -0.999 * kTwoPi, 2.999 * kTwoPi), at, 0.0, -0.0,
                         std::nextafter(at, 100.0), std::nextafter(at, -100.0), -1e-300}) {
    RC_ASSERT(bits_of(lane_wrap_to_two_pi(x)) == bits_of(wrap_to_two_pi(x)));
  }
}

// Against the Box-Muller method with the system's functions; radii are at most 9.5.
RC_GTEST_PROP(LaneNormalPair, IsStandardNormalPair, ()) {
  const std::uint64_t seed = any_word();
  RandomStream words(seed, Purpose::kReadNoise);
  RandomStream stream(seed, Purpose::kReadNoise);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t first = words();
    const std::uint64_t second = words();
    const NormalPair lane = lane_normal_pair(first, second);
    const auto [x, y] = standard_normal_pair(stream);
    RC_ASSERT(std::abs(lane.first - x) <= 8e-16 * std::max(1.0, std::abs(x)));
    RC_ASSERT(std::abs(lane.second - y) <= 8e-16 * std::max(1.0, std::abs(y)));
  }
}

TEST(LaneNormalPair, IsFiniteForTheWordsAtTheEnds) {
  for (const std::uint64_t first : {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 63U}) {
    for (const std::uint64_t second : {std::uint64_t{0}, ~std::uint64_t{0}}) {
      const NormalPair pair = lane_normal_pair(first, second);
      EXPECT_TRUE(std::isfinite(pair.first) && std::isfinite(pair.second));
    }
  }
}

/// All functions applied to the same numbers, one after the other.
std::vector<double> all_in_lanes(InstructionSet set, const std::vector<std::uint64_t>& words,
                                 std::size_t count) {
  std::vector<double> found(6 * count);
  in_lanes(set, [&] {
    double* const out = found.data();
    const std::uint64_t* const in = words.data();
    for (std::size_t i = 0; i < count; ++i) {
      const NormalPair pair = lane_normal_pair(in[i], in[i + 1]);
      out[6 * i] = pair.first;
      out[6 * i + 1] = pair.second;
      out[6 * i + 2] = lane_round(40.0 * lane_log10(std::abs(pair.first) + 1e-300));
      out[6 * i + 3] = lane_wrap_to_two_pi(lane_remainder(1e5 * std::abs(pair.second), 0.173));
      const auto single = static_cast<float>(std::abs(pair.first) + 1e-30);
      out[6 * i + 4] = static_cast<double>(lane_log(single) + lane_exp(-single));
      out[6 * i + 5] = lane_arc_tangent(pair.first, pair.second);
    }
  });
  return found;
}

TEST(InLanes, GivesTheSameBitsInEveryInstructionSetAndForEveryCount) {
  RandomStream stream(3, Purpose::kReadNoise);
  std::vector<std::uint64_t> words(1001);
  for (std::uint64_t& word : words) word = stream();
  const std::vector<double> all = all_in_lanes(InstructionSet::kBaseline, words, 1000);
  for (const InstructionSet set : instruction_sets()) {
    for (const std::size_t count : {1U, 2U, 3U, 7U, 8U, 9U, 64U, 999U, 1000U}) {
      const std::vector<double> some = all_in_lanes(set, words, count);
      for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(bits_of(some[i]), bits_of(all[i]));
    }
  }
  EXPECT_EQ(instruction_sets().front(), InstructionSet::kBaseline);
}

}  // namespace
}  // namespace tagfield
