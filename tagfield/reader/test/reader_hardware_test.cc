// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/reader_hardware.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr ReceiverEffects kNothing{false, false, false};

RandomStream stream(std::uint64_t number) { return {1, Purpose::kMeasuring, number}; }

TEST(NoisePower, IsThermalNoiseInTheBandwidthAndTheFigure) {
  ReaderHardware hardware;
  hardware.bandwidth_hz = 250e3;
  hardware.noise_figure_db = 25.0;
  // 10 log10(1.380649e-23 · 290 · 250e3 / 1e-3) + 25.
  EXPECT_NEAR(noise_dbm(hardware), -94.997, 0.01);
}

TEST(PhaseSigma, FallsWithTheSquareRootOfTheSignalDownToItsFloor) {
  ReaderHardware hardware;
  hardware.phase_floor_rad = 0.0;
  const double weak = phase_sigma(hardware, -80.0);
  EXPECT_NEAR(weak / phase_sigma(hardware, -60.0), 10.0, 1e-9);
  hardware.phase_floor_rad = 0.05;
  EXPECT_NEAR(phase_sigma(hardware, 10.0), 0.05, 1e-4);
}

TEST(PhaseSigma, IsThatOfASignalInComplexWhiteNoise) {
  // Phase of the mean of n complex samples 1 + w, where w has variance 1/SNR: simulated.
  ReaderHardware hardware;
  hardware.phase_floor_rad = 0.0;
  const double reply_dbm = noise_dbm(hardware) + 12.0;
  const double snr = std::pow(10.0, 1.2);
  RandomStream noise = stream(5);
  double sum = 0.0;
  constexpr int kTrials = 20000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::complex<double> mean = 0.0;
    for (int i = 0; i < 16; ++i) {
      const auto [re, im] = standard_normal_pair(noise);
      mean += (1.0 + std::complex<double>(re, im) * std::sqrt(0.5 / snr)) / 16.0;
    }
    sum += std::arg(mean) * std::arg(mean);
  }
  // The relative standard error of a standard deviation from this many trials is 0.5 %; five of
  // those.
  EXPECT_NEAR(std::sqrt(sum / kTrials) / phase_sigma(hardware, reply_dbm), 1.0, 0.025);
}

TEST(DecodeProbability, IsThatOfOrthogonalSignals) {
  ReaderHardware hardware;
  // SNR 10 dB: BER = ½ erfc(√5) = 7.827e-4; 144 bits are decoded with probability 0.8934.
  EXPECT_NEAR(decode_probability(hardware, noise_dbm(hardware) + 10.0, 144), 0.8934, 1e-4);
  EXPECT_NEAR(decode_probability(hardware, noise_dbm(hardware) + 30.0, 144), 1.0, 1e-12);
  EXPECT_LT(decode_probability(hardware, noise_dbm(hardware) - 20.0, 144), 1e-30);
}

TEST(Measure, WithNothingOnIsTheReplyItself) {
  RandomStream noise = stream(1);
  const Measured measured = measure({}, kNothing, {-1.0, -55.123, 2.71}, noise);
  EXPECT_DOUBLE_EQ(measured.phase_rad, kTwoPi - 1.0);
  EXPECT_EQ(measured.rssi_dbm, -55.123);
  EXPECT_EQ(measured.doppler_hz, 2.71);
}

TEST(Measure, QuantizesInTheReadersSteps) {
  RandomStream noise = stream(1);
  const Measured measured = measure({}, {false, true, false}, {1.0, -55.3, 2.71}, noise);
  const double step = kTwoPi / 4096.0;
  EXPECT_NEAR(measured.phase_rad / step, std::round(1.0 / step), 1e-9);
  EXPECT_EQ(measured.rssi_dbm, -55.5);
  EXPECT_EQ(measured.doppler_hz, 2.6875);
  // Less than half a step below a full turn, the phase rounds up to a full turn, which is 0.
  EXPECT_EQ(measure({}, {false, true, false}, {kTwoPi - 0.1 * step, 0, 0}, noise).phase_rad, 0.0);
}

TEST(Measure, NoiseIsNormalWithTheSigmaOfTheSignal) {
  const ReaderHardware hardware;
  const Reply reply{2.0, -70.0, 0.0};
  const double sigma = phase_sigma(hardware, reply.power_dbm);
  constexpr int kReads = 20000;
  std::vector<double> errors;
  for (int i = 0; i < kReads; ++i) {
    RandomStream noise = stream(static_cast<std::uint64_t>(i));
    errors.push_back((measure(hardware, {true, false, false}, reply, noise).phase_rad - 2.0) /
                     sigma);
  }
  std::sort(errors.begin(), errors.end());
  double worst = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double share = (static_cast<double>(i) + 0.5) / kReads;
    worst = std::max(worst, std::abs(0.5 * std::erfc(-errors[i] / std::sqrt(2.0)) - share));
  }
  // Kolmogorov-Smirnov at 1e-6: √(ln(2/1e-6)/2n).
  EXPECT_LT(worst, std::sqrt(std::log(2e6) / (2.0 * kReads)));
}

TEST(Measure, PiAmbiguityComeInHalfOfTheReads) {
  int turned = 0;
  constexpr int kReads = 10000;
  for (int i = 0; i < kReads; ++i) {
    RandomStream noise = stream(static_cast<std::uint64_t>(i));
    const double phase = measure({}, {false, false, true}, {1.0, -50.0, 0.0}, noise).phase_rad;
    const bool is_turned = std::abs(phase - 1.0 - kPi) < 1e-9;
    EXPECT_TRUE(is_turned || std::abs(phase - 1.0) < 1e-9);
    turned += is_turned ? 1 : 0;
  }
  EXPECT_NEAR(turned, kReads / 2, 5 * 50);
}

TEST(Measure, StaysFiniteForRepliesThatDrown) {
  RandomStream noise = stream(2);
  const Measured measured = measure({}, {}, {1e9, -5000.0, 1e9}, noise);
  EXPECT_TRUE(std::isfinite(measured.phase_rad) && std::isfinite(measured.rssi_dbm));
  EXPECT_GE(measured.phase_rad, 0.0);
  EXPECT_LT(measured.phase_rad, kTwoPi);
}

TEST(CheckHardware, NamesTheRange) {
  ReaderHardware hardware;
  hardware.phase_steps = -1.0;
  try {
    check(hardware);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "phase_steps must be from 0 to 1e+09, is -1");
  }
  hardware = {};
  hardware.bandwidth_hz = std::nan("");
  EXPECT_THROW(check(hardware), Error);
}

TEST(SinrDb, CountsOtherReadersAsNoise) {
  const ReaderHardware hardware;
  const double noise = noise_dbm(hardware);
  EXPECT_NEAR(sinr_db(hardware, noise + 20.0), 20.0, 1e-12);
  EXPECT_NEAR(sinr_db(hardware, noise + 20.0, std::pow(10.0, noise / 10.0)), 20.0 - 3.0103, 1e-4);
}

TEST(PhaseSigma, GrowsWithNoiseAndInterference) {
  ReaderHardware hardware;
  hardware.phase_floor_rad = 0.0;
  const double noise_mw = std::pow(10.0, noise_dbm(hardware) / 10.0);
  EXPECT_NEAR(phase_sigma(hardware, -60.0, 99.0 * noise_mw) / phase_sigma(hardware, -60.0), 10.0,
              1e-9);
}

TEST(RequiredSinr, LetsHalfOfAllRepliesThrough) {
  const ReaderHardware hardware;
  const double noise = noise_dbm(hardware);
  for (const int bits : {2, 16, 144, 1000}) {
    const double reply_dbm = noise + required_sinr_db(bits) + 7.0;
    // Noise plus interference is 7 dB above the noise.
    const double interference_mw = (from_db(7.0) - 1.0) * from_db(noise);
    EXPECT_NEAR(decode_probability(hardware, reply_dbm, bits, interference_mw), 0.5, 1e-6) << bits;
  }
  // ½ erfc √(SNR/2) = 1 − 2^(−1/144) = 0.004802: 2.590 standard deviations, 8.27 dB.
  EXPECT_NEAR(required_sinr_db(144), 8.27, 0.01);
}

TEST(Measure, AmplitudeAndDopplerScatterAsTheSignalsNoiseSays) {
  // For a signal A + n with σ_n/A = σ along it, the RSSI has a standard deviation of σ · 20/ln 10
  // dB about the truth. Doppler is the phase difference between halves of a reply, each with √2 σ,
  // T/2 apart: √2 · √2 σ / (2π T/2) = 2σ/(πT).
  ReaderHardware hardware;
  hardware.phase_floor_rad = 0.0;
  const double sigma = 0.02;
  const double reply_dbm =
      noise_dbm(hardware) + 10.0 * std::log10(1.0 / (2.0 * hardware.averaged_bits * sigma * sigma));
  ASSERT_NEAR(phase_sigma(hardware, reply_dbm), sigma, 1e-9);
  constexpr int kReads = 40000;
  double rssi = 0.0;
  double rssi_squares = 0.0;
  double doppler_squares = 0.0;
  RandomStream noise = stream(9);
  for (int i = 0; i < kReads; ++i) {
    const Measured read =
        measure(hardware, {true, false, false}, {1.0, reply_dbm, 3.0, 0.0}, noise);
    rssi += (read.rssi_dbm - reply_dbm) / kReads;
    rssi_squares += std::pow(read.rssi_dbm - reply_dbm, 2) / kReads;
    doppler_squares += std::pow(read.doppler_hz - 3.0, 2) / kReads;
  }
  const double of_rssi = sigma * 20.0 / std::log(10.0);
  // Five standard errors: of a mean σ/√n, of a standard deviation σ/√2n.
  EXPECT_NEAR(rssi, 0.0, 5.0 * of_rssi / std::sqrt(1.0 * kReads) + of_rssi * sigma);
  EXPECT_NEAR(std::sqrt(rssi_squares) / of_rssi, 1.0, 5.0 / std::sqrt(2.0 * kReads) + sigma);
  const double of_doppler = 2.0 * sigma / (kPi * hardware.reply_s);
  EXPECT_NEAR(std::sqrt(doppler_squares) / of_doppler, 1.0, 5.0 / std::sqrt(2.0 * kReads));
}

}  // namespace
}  // namespace tagfield
