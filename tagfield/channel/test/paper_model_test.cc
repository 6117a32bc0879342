// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/paper_model.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tagfield/base/random.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/statistics.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/test/any_paper_model.h"

namespace tagfield {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::size_t kReads = 20'000;

PaperModel noiseless(double frequency_hz = 865.7e6) {
  PaperModel model;
  model.frequency_hz = frequency_hz;
  model.phase_noise_rad = 0.0;
  model.rssi_noise = 0.0;
  return model;
}

std::vector<Signal> signals_of(const PaperModel& model, double distance_m) {
  std::vector<Signal> signals;
  for (std::size_t i = 0; i < kReads; ++i) {
    RandomStream noise(3, Purpose::kReadNoise, 1, 2, i);
    RandomStream optional(3, Purpose::kOptionalNoise, 1, 2, i);
    signals.push_back(paper_signal(model, {distance_m}, noise, optional));
  }
  return signals;
}

/// Phases minus eq. (4) without noise, in [-π, π).
std::vector<double> phase_residuals(const PaperModel& model, double distance_m) {
  const double expected =
      model.phase_offset_rad + 2.0 * kPi / (kSpeedOfLight / model.frequency_hz) * 2.0 * distance_m;
  std::vector<double> residuals;
  for (const Signal& signal : signals_of(model, distance_m)) {
    residuals.push_back(std::remainder(signal.phase_rad - expected, kTwoPi));
  }
  return residuals;
}

TEST(PaperPhase, GrowsByTwoPiEachHalfWavelength) {
  const PaperModel model = noiseless();
  const double half = 0.5 * kSpeedOfLight / 865.7e6;
  for (const double distance : {0.01, 1.0, 6.9}) {
    const double phase = paper_phase(model, distance, 0.0);
    for (int turns = 1; turns < 50; ++turns) {
      EXPECT_NEAR(paper_phase(model, distance + turns * half, 0.0), phase, 1e-11);
    }
    // λ/4 is half a turn, λ/8 a quarter.
    EXPECT_NEAR(std::abs(paper_phase(model, distance + half / 2.0, 0.0) - phase), kPi, 1e-12);
    EXPECT_NEAR(wrap_to_pi(paper_phase(model, distance + half / 4.0, 0.0) - phase), kPi / 2.0,
                1e-12);
  }
}

TEST(PaperPhase, HasThePublishedSlope) {
  // 4π/λ [rad/m].
  for (const auto& [frequency, slope] : {std::pair{865.7e6, 36.287}, {915e6, 38.354}}) {
    const PaperModel model = noiseless(frequency);
    const double step = 0.001;
    const double change = paper_phase(model, 1.0 + step, 0.0) - paper_phase(model, 1.0, 0.0);
    EXPECT_NEAR(wrap_to_pi(change) / step, slope, 5e-4);
  }
}

TEST(PaperPhase, StepsOfARealReaderAreThoseOfTheTable) {
  // One step of 4096: 0.0423 mm at 865.7 MHz, 0.0400 mm at 915 MHz. A phase of π: 8.66 and 8.19 cm.
  for (const auto& [frequency, step_m, half_turn_m] :
       {std::tuple{865.7e6, 0.0423e-3, 0.0866}, {915e6, 0.0400e-3, 0.0819}}) {
    const PaperModel model = noiseless(frequency);
    EXPECT_NEAR(paper_phase(model, step_m, 0.0) * 4096.0 / kTwoPi, 1.0, 2e-3);
    EXPECT_NEAR(paper_phase(model, half_turn_m, 0.0), kPi, 2e-3);
  }
}

TEST(PaperPhase, AddsOffsetAndNoise) {
  PaperModel model = noiseless();
  const double phase = paper_phase(model, 2.0, 0.0);
  model.phase_offset_rad = -0.7;
  EXPECT_NEAR(wrap_to_pi(paper_phase(model, 2.0, 0.2) - phase), -0.5, 1e-12);
  model.phase_offset_rad = 100.0 * kTwoPi + 1.0;
  EXPECT_NEAR(wrap_to_pi(paper_phase(model, 2.0, 0.0) - phase), 1.0, 1e-12);
}

RC_GTEST_PROP(PaperPhase, IsEquationFour, ()) {
  PaperModel model = noiseless(1e6 * (*rc::gen::inRange(300, 3000)));
  model.phase_offset_rad = 0.001 * (*rc::gen::inRange(-10'000, 10'000));
  const double distance = 0.0001 * (*rc::gen::inRange(1, 200'000));
  const double noise = 0.001 * (*rc::gen::inRange(-5000, 5000));
  const auto frequency = static_cast<long double>(model.frequency_hz);
  const long double expected = static_cast<long double>(model.phase_offset_rad) +
                               static_cast<long double>(noise) +
                               4.0L * std::numbers::pi_v<long double> *
                                   static_cast<long double>(distance) * frequency / 299'792'458.0L;
  const auto difference = static_cast<long double>(paper_phase(model, distance, noise)) - expected;
  RC_ASSERT(std::abs(static_cast<double>(
                std::remainder(difference, 2.0L * std::numbers::pi_v<long double>))) < 1e-11);
}

TEST(PaperRssi, IsEquationFiveWithoutNoise) {
  // Published example: gains 1 and 3 at 865.7 MHz; computed by hand from 40·log10(Gλ/(4πD)).
  for (const double gain : {1.0, 3.0}) {
    for (const double distance : {0.1, 0.5, 1.0, 1.0173, 2.0, 3.0, 5.0, 7.0, 14.05}) {
      PaperModel model = noiseless();
      model.communication_gain = gain;
      const double loss = std::log10(gain) + std::log10(299'792'458.0 / 865.7e6) -
                          std::log10(4.0 * kPi) - std::log10(distance);
      EXPECT_EQ(paper_rssi_dbm(model, distance, 0.0), std::round(40.0 * loss)) << distance;
    }
  }
  EXPECT_EQ(paper_rssi_dbm(noiseless(), 1.0, 0.0), -62.0);  // 40·log10(0.027558) = -62.39
  EXPECT_EQ(paper_rssi_dbm(noiseless(), 7.0, 0.0), -96.0);  // -62.39 - 33.80 = -96.19
}

TEST(PaperRssi, LosesTwelveDecibelsEachDoubling) {
  for (const double distance : {0.2, 0.5, 1.7}) {
    const double step =
        paper_rssi_dbm(noiseless(), distance, 0.0) - paper_rssi_dbm(noiseless(), 2 * distance, 0.0);
    EXPECT_NEAR(step, 12.04, 1.0);  // Both are rounded.
  }
}

TEST(PaperRssi, FoldsANegativeSum) {
  const PaperModel model = noiseless();
  const double amplitude = kSpeedOfLight / 865.7e6 / (4.0 * kPi * 7.0);
  EXPECT_EQ(paper_rssi_dbm(model, 7.0, -3.0 * amplitude), paper_rssi_dbm(model, 7.0, amplitude));
}

TEST(PaperRssi, IsFiniteWhereTheSumVanishes) {
  PaperModel model = noiseless();
  const double amplitude = kSpeedOfLight / 865.7e6 / (4.0 * kPi * 7.0);
  EXPECT_TRUE(std::isfinite(paper_rssi_dbm(model, 7.0, -amplitude)));
  EXPECT_TRUE(std::isfinite(paper_rssi_dbm(model, 1e308, 0.0)));
}

TEST(PaperRssi, NeverBecomesNanAtTheEndsOfDouble) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  PaperModel model = noiseless(1e6);
  for (const double gain : {kTiny, 1.0, kHuge}) {
    for (const double distance : {kTiny, 1.0, kHuge}) {
      for (const double noise : {-kInfinite, -kHuge, 0.0, kHuge, kInfinite}) {
        model.communication_gain = gain;
        EXPECT_TRUE(std::isfinite(paper_rssi_dbm(model, distance, noise)))
            << gain << ' ' << distance << ' ' << noise;
      }
    }
  }
}

TEST(PaperRssi, GivesPlainZero) {
  PaperModel model = noiseless();
  model.communication_gain = 0.99 * 4.0 * kPi * 865.7e6 / kSpeedOfLight;  // -0.17 dB at 1 m
  EXPECT_EQ(paper_rssi_dbm(model, 1.0, 0.0), 0.0);
  EXPECT_FALSE(std::signbit(paper_rssi_dbm(model, 1.0, 0.0)));
}

struct RssiCase {
  double gain;
  double noise;
  double distance_m;
};

class PaperSignalRssi : public testing::TestWithParam<RssiCase> {};

TEST_P(PaperSignalRssi, MeanFollowsEquationFive) {
  const double gain = GetParam().gain;
  const double noise = GetParam().noise;
  const double distance = GetParam().distance_m;
  PaperModel model = noiseless();
  model.communication_gain = gain;
  model.rssi_noise = noise;
  const double amplitude = gain * kSpeedOfLight / 865.7e6 / (4.0 * kPi * distance);
  // E and Var of round(40·log10|a+n|), n ~ N(0, noise²), summed over its possible values.
  const auto below = [&](double size) {  // P(|a+n| < size)
    return statistics::normal_cdf((size - amplitude) / noise) -
           statistics::normal_cdf((-size - amplitude) / noise);
  };
  double mean = 0.0;
  double square = 0.0;
  for (int level = -600; level <= 100; ++level) {
    const double probability =
        below(std::pow(10.0, (level + 0.5) / 40.0)) - below(std::pow(10.0, (level - 0.5) / 40.0));
    mean += probability * level;
    square += probability * level * level;
  }
  std::vector<double> rssi;
  for (const Signal& signal : signals_of(model, distance)) {
    ASSERT_TRUE(std::isfinite(signal.rssi_dbm));
    ASSERT_EQ(signal.rssi_dbm, std::round(signal.rssi_dbm));
    rssi.push_back(signal.rssi_dbm);
  }
  const double error = std::sqrt((square - mean * mean) / kReads);
  EXPECT_NEAR(statistics::mean(rssi), mean, statistics::kNormalBound * error);
}

INSTANTIATE_TEST_SUITE_P(PublishedAntennas, PaperSignalRssi,
                         testing::Values(RssiCase{3.0, 0.01, 0.5}, RssiCase{3.0, 0.01, 2.0},
                                         RssiCase{3.0, 0.01, 7.0}, RssiCase{1.0, 0.008, 1.0},
                                         RssiCase{1.0, 0.008, 3.0}, RssiCase{1.0, 0.008, 7.0}));

class PaperSignalPhase : public testing::TestWithParam<double> {};

TEST_P(PaperSignalPhase, NoiseIsNormalAroundEquationFour) {
  PaperModel model;
  model.phase_offset_rad = 4.0;
  model.phase_noise_rad = GetParam();
  for (const double distance : {0.3, 1.0173, 6.5}) {
    const auto cdf = [](double residual) { return statistics::normal_cdf(residual / GetParam()); };
    EXPECT_LT(statistics::kolmogorov(phase_residuals(model, distance), cdf),
              statistics::kKolmogorovBound);
  }
}

INSTANTIATE_TEST_SUITE_P(Sigmas, PaperSignalPhase, testing::Values(1e-6, 0.01, 0.1, 0.5));

TEST(PaperSignal, WithoutNoiseIsTheEquations) {
  PaperModel model = noiseless();
  model.phase_offset_rad = 1.0;
  RandomStream noise(1, Purpose::kReadNoise);
  RandomStream optional(1, Purpose::kOptionalNoise);
  const Signal signal = paper_signal(model, {2.5}, noise, optional);
  EXPECT_EQ(signal.phase_rad, paper_phase(model, 2.5, 0.0));
  EXPECT_EQ(signal.rssi_dbm, paper_rssi_dbm(model, 2.5, 0.0));
}

TEST(PaperSignal, PhaseAndRssiNoiseAreIndependent) {
  PaperModel model;
  model.rssi_noise = 0.001;
  std::vector<double> rssi;
  for (const Signal& signal : signals_of(model, 1.0)) rssi.push_back(signal.rssi_dbm);
  EXPECT_GT(statistics::variance(rssi), 0.1);
  EXPECT_LT(std::abs(statistics::correlation_deviate(phase_residuals(model, 1.0), rssi)),
            statistics::kNormalBound);
}

TEST(PaperSignal, OptionalDistributionDoesNotChangeTheOtherNoise) {
  PaperModel model;
  const auto plain = signals_of(model, 2.0);
  model.optional = make_distribution("uniform_real_distribution", {1.0, 1.0 + 1e-9});
  const auto shifted = signals_of(model, 2.0);
  for (std::size_t i = 0; i < kReads; i += 97) {
    EXPECT_EQ(plain[i].rssi_dbm, shifted[i].rssi_dbm);
    EXPECT_NEAR(wrap_to_pi(shifted[i].phase_rad - plain[i].phase_rad), 1.0, 1e-8);
  }
}

TEST(PaperSignal, OptionalUniformAddsItsMeanAndVariance) {
  PaperModel model;
  model.phase_noise_rad = 0.1;
  model.optional = make_distribution("uniform_real_distribution", {-0.5, 1.0});
  const auto residuals = phase_residuals(model, 1.3);
  // Mean ¼, variance 1.5²/12 + 0.1²; fourth moment 1.5⁴/80 + 6·(1.5²/12)·0.1² + 3·0.1⁴.
  const double variance = 0.1875 + 0.01;
  const double fourth = 0.06328125 + 0.01125 + 0.0003;
  EXPECT_NEAR(statistics::mean(residuals), 0.25,
              statistics::kNormalBound * std::sqrt(variance / kReads));
  EXPECT_NEAR(statistics::variance(residuals), variance,
              statistics::kNormalBound * std::sqrt((fourth - variance * variance) / kReads));
}

TEST(PaperSignal, OptionalExponentialWrapsRoundTheCircle) {
  PaperModel model = noiseless();
  model.optional = make_distribution("exponential_distribution", {0.2});
  std::vector<double> residuals = phase_residuals(model, 1.3);
  for (double& residual : residuals) residual = residual < 0.0 ? residual + kTwoPi : residual;
  // The wrapped exponential distribution (Jammalamadaka and Kozubowski 2004).
  const auto cdf = [](double angle) {
    return std::expm1(-0.2 * angle) / std::expm1(-0.2 * kTwoPi);
  };
  EXPECT_LT(statistics::kolmogorov(residuals, cdf), statistics::kKolmogorovBound);
}

TEST(PaperSignal, OptionalCauchyHasTheWrappedCauchysMoments) {
  PaperModel model = noiseless();
  model.optional = make_distribution("cauchy_distribution", {0.4, 0.7});
  std::vector<double> along;
  std::vector<double> across;
  for (const double residual : phase_residuals(model, 1.3)) {
    along.push_back(std::cos(residual - 0.4));
    across.push_back(std::sin(residual - 0.4));
  }
  // E cos = e^-γ, E sin = 0; neither's variance is above 1.
  const double error = statistics::kNormalBound / std::sqrt(kReads);
  EXPECT_NEAR(statistics::mean(along), std::exp(-0.7), error);
  EXPECT_NEAR(statistics::mean(across), 0.0, error);
}

TEST(PaperSignal, HugeOptionalDrawsKeepThePhaseInItsTurn) {
  PaperModel model;
  for (const double width : {1e3, 1e17, 1e300, 1e308}) {
    model.optional = make_distribution("cauchy_distribution", {0.0, width});
    for (const Signal& signal : signals_of(model, 3.0)) {
      ASSERT_GE(signal.phase_rad, 0.0);
      ASSERT_LT(signal.phase_rad, kTwoPi);
    }
  }
}

RC_GTEST_PROP(PaperSignal, IsAlwaysFiniteAndInItsTurn, ()) {
  PaperModel model;
  model.frequency_hz = power_of_ten(60, 110);
  model.phase_offset_rad = *rc::gen::inRange(-1'000'000, 1'000'001);
  model.phase_noise_rad = *rc::gen::elementOf(std::vector<double>{0.0, 0.1, 1e6, 1e300, 1.7e308});
  model.rssi_noise = *rc::gen::elementOf(std::vector<double>{0.0, 0.01, 1e6, 1e300, 1.7e308});
  model.communication_gain = power_of_ten(-3000, 3000);
  model.optional = any_distribution();
  check(model);
  const double distance = power_of_ten(-3000, 3000);
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  RandomStream noise(seed, Purpose::kReadNoise);
  RandomStream optional(seed, Purpose::kOptionalNoise);
  const Signal signal = paper_signal(model, {distance}, noise, optional);
  RC_ASSERT(signal.phase_rad >= 0.0);
  RC_ASSERT(signal.phase_rad < kTwoPi);
  RC_ASSERT(std::isfinite(signal.rssi_dbm));
  RC_ASSERT(signal.rssi_dbm == std::round(signal.rssi_dbm));
}

using Change = std::function<void(PaperModel&)>;

std::string complaint(const Change& change) {
  PaperModel model;
  change(model);
  return error_of([&] { check(model); });
}

TEST(CheckPaperModel, TakesTheDefaultsAndTheEdges) {
  EXPECT_EQ(complaint([](PaperModel& /*model*/) {}), "(no error)");
  EXPECT_EQ(complaint([](PaperModel& model) { model = noiseless(); }), "(no error)");
  EXPECT_EQ(complaint([](PaperModel& model) { model.frequency_hz = 1e300; }), "(no error)");
  EXPECT_EQ(complaint([](PaperModel& model) { model.phase_offset_rad = -1e6; }), "(no error)");
}

TEST(CheckPaperModel, NamesTheParameterThatIsBad) {
  for (const double bad : {kNan, kInfinite, -kInfinite}) {
    EXPECT_TRUE(contains(complaint([&](auto& m) { m.frequency_hz = bad; }), "frequency_hz must"));
    EXPECT_TRUE(
        contains(complaint([&](auto& m) { m.phase_offset_rad = bad; }), "phase_offset_rad"));
    EXPECT_TRUE(contains(complaint([&](auto& m) { m.phase_noise_rad = bad; }), "phase_noise_rad"));
    EXPECT_TRUE(contains(complaint([&](auto& m) { m.rssi_noise = bad; }), "rssi_noise must"));
    EXPECT_TRUE(contains(complaint([&](auto& m) { m.communication_gain = bad; }), "communication"));
  }
  for (const double bad : {0.0, -1.0}) {
    EXPECT_TRUE(contains(complaint([&](auto& m) { m.frequency_hz = bad; }), "frequency_hz must"));
    EXPECT_TRUE(contains(complaint([&](auto& m) { m.communication_gain = bad; }), "communication"));
  }
  EXPECT_TRUE(contains(complaint([](auto& m) { m.phase_noise_rad = -0.1; }), "is -0.1"));
  EXPECT_TRUE(contains(complaint([](auto& m) { m.rssi_noise = -1e-9; }), "rssi_noise must"));
  // So low that the wavelength exceeds the largest double.
  EXPECT_TRUE(contains(complaint([](auto& m) { m.frequency_hz = 1e-305; }), "wavelength must"));
}

}  // namespace
}  // namespace tagfield
