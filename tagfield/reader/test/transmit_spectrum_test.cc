// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/transmit_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

LinkSettings link_of(Encoding encoding, double blf_hz) {
  LinkSettings link;
  link.encoding = encoding;
  link.blf_hz = blf_hz;
  return link;
}

/// Density integrated in small steps, over both bands.
double summed_up(const TransmitSpectrum& spectrum, double offset_hz, const LinkSettings& link,
                 double bandwidth_hz) {
  const double half = link.blf_hz / static_cast<int>(link.encoding);
  constexpr int kSteps = 100000;
  double sum = 0.0;
  for (const double middle : {-link.blf_hz, link.blf_hz}) {
    for (int i = 0; i < kSteps; ++i) {
      const double f = middle - half + 2.0 * half * (i + 0.5) / kSteps - offset_hz;
      const int channel = static_cast<int>(std::floor(std::abs(f) / spectrum.channel_hz + 0.5));
      sum += from_db(mask_db(spectrum.mask, channel)) / spectrum.channel_hz;
    }
  }
  return bandwidth_hz * sum / (2.0 * kSteps);
}

TEST(MaskDb, IsTheStandardsIntegratedPowerInEachChannel) {
  const double multiple[] = {0.0, -20.0, -50.0, -60.0, -65.0, -65.0};
  const double dense[] = {0.0, -30.0, -60.0, -65.0, -65.0, -65.0};
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(mask_db(SpectrumMask::kMultiple, i), multiple[i]) << i;
    EXPECT_EQ(mask_db(SpectrumMask::kDense, i), dense[i]) << i;
  }
}

TEST(ShareInReplies, IsTheMeanDensityInTheirBands) {
  for (const Encoding encoding : {Encoding::kFm0, Encoding::kMiller2, Encoding::kMiller8}) {
    for (const double offset_hz : {0.0, 200e3, -250e3, 600e3, 2e6}) {
      for (const TransmitSpectrum& spectrum : {TransmitSpectrum{SpectrumMask::kDense, 100e3},
                                               TransmitSpectrum{SpectrumMask::kMultiple, 200e3}}) {
        const LinkSettings link = link_of(encoding, 250e3);
        const double expected = summed_up(spectrum, offset_hz, link, 250e3);
        EXPECT_NEAR(share_in_replies(spectrum, offset_hz, link, 250e3) / expected, 1.0, 1e-3)
            << static_cast<int>(encoding) << " " << offset_hz;
      }
    }
  }
}

TEST(ShareInReplies, IsFarLessOfMillerThanOfFm0OnTheSameCarrier) {
  const TransmitSpectrum spectrum{SpectrumMask::kDense, 100e3};
  const auto share_db = [&](Encoding encoding) {
    return to_db(share_in_replies(spectrum, 0.0, link_of(encoding, 250e3), 250e3));
  };
  // FM0's band extends to the carrier: half of the own channel lies in each of its two bands of 500
  // kHz, and a receiver of 250 kHz bandwidth receives a quarter of that power.
  EXPECT_NEAR(share_db(Encoding::kFm0), -6.02, 0.02);
  // Miller 4's band, 187.5 to 312.5 kHz, lies half in the mask's second, half in its third channel.
  EXPECT_NEAR(share_db(Encoding::kMiller4), to_db(2.0 * (0.625e-6 + 0.625 * from_db(-65.0))), 0.02);
}

TEST(ShareInReplies, IsAsMuchOnBothSidesOfTheCarrier) {
  const TransmitSpectrum spectrum{SpectrumMask::kMultiple, 200e3};
  const LinkSettings link = link_of(Encoding::kMiller2, 320e3);
  for (const double offset_hz : {50e3, 400e3, 900e3}) {
    EXPECT_NEAR(share_in_replies(spectrum, offset_hz, link, 250e3),
                share_in_replies(spectrum, -offset_hz, link, 250e3), 1e-15);
  }
}

}  // namespace
}  // namespace tagfield
