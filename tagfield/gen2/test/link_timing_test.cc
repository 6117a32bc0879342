// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/link_timing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

constexpr double kPicosecond = 1e-12;

/// The fastest link allowed by the standard.
LinkSettings fastest() {
  LinkSettings link;
  link.tari_s = 6.25e-6;
  link.data1_tari = 2.0;
  link.blf_hz = 640e3;
  link.encoding = Encoding::kFm0;
  link.pilot = false;
  return link;
}

// All sums below are computed by hand, in microseconds.

TEST(LinkTiming, FastestLinksCommandsByHand) {
  const LinkSettings link = fastest();
  check(link);
  // RTcal 6.25 + 12.5; frame-sync 12.5 + 6.25 + 18.75; TRcal 64/3/0.64.
  EXPECT_NEAR(rtcal_s(link), 18.75e-6, kPicosecond);
  EXPECT_NEAR(trcal_s(link), 33.33333333e-6, kPicosecond);
  EXPECT_NEAR(frame_sync_s(link), 37.5e-6, kPicosecond);
  EXPECT_NEAR(preamble_s(link), 70.83333333e-6, kPicosecond);
  // 1000, DR 1, M 00, TRext 0, Sel 00, S0 00: 2 ones in 12 bits; half of the other 10: 7 of 22.
  EXPECT_NEAR(query_s(link, Session::kS0), (70.83333333 + 15 * 6.25 + 7 * 12.5) * 1e-6,
              kPicosecond);
  EXPECT_NEAR(query_adjust_s(link, Session::kS0), (37.5 + 5 * 6.25 + 4 * 12.5) * 1e-6, kPicosecond);
  EXPECT_NEAR(query_rep_s(link, Session::kS0), (37.5 + 4 * 6.25) * 1e-6, kPicosecond);
  EXPECT_NEAR(query_rep_s(link, Session::kS3), (37.5 + 2 * 6.25 + 2 * 12.5) * 1e-6, kPicosecond);
  EXPECT_NEAR(ack_s(link), (37.5 + 9 * 6.25 + 9 * 12.5) * 1e-6, kPicosecond);
}

TEST(LinkTiming, FastestLinksRepliesAndSlotsByHand) {
  const LinkSettings link = fastest();
  // 1.5625 per bit; 6 symbols before and 1 after.
  EXPECT_NEAR(rn16_s(link), 35.9375e-6, kPicosecond);
  EXPECT_NEAR(epc_reply_s(link), 210.9375e-6, kPicosecond);
  EXPECT_NEAR(t1_s(link), 18.75e-6, kPicosecond);
  EXPECT_NEAR(t2_s(link), 15.625e-6, kPicosecond);
  EXPECT_NEAR(t4_s(link), 37.5e-6, kPicosecond);
  // T1 + T3 = 34.375 is less than T4.
  EXPECT_NEAR(empty_slot_s(link), 37.5e-6, kPicosecond);
  EXPECT_NEAR(collided_slot_s(link), 70.3125e-6, kPicosecond);
  EXPECT_NEAR(epc_begins_s(link), (70.3125 + 206.25 + 18.75) * 1e-6, kPicosecond);
  EXPECT_NEAR(read_slot_s(link), 521.875e-6, kPicosecond);
}

TEST(LinkTiming, DenseReadersLinkByHand) {
  const LinkSettings link;  // Tari 25, data-1 of 1.5, 250 kHz, Miller 4, pilot.
  check(link);
  EXPECT_NEAR(preamble_s(link), (12.5 + 25 + 62.5 + 85.33333333) * 1e-6, kPicosecond);
  // 1000, DR 1, M 10, TRext 1, Sel 00, S2 10: 5 ones in 12 bits; 10 of 22.
  EXPECT_NEAR(query_s(link, Session::kS2), (185.33333333 + 12 * 25 + 10 * 37.5) * 1e-6,
              kPicosecond);
  EXPECT_NEAR(query_adjust_s(link, Session::kS1), 387.5e-6, kPicosecond);
  EXPECT_NEAR(query_rep_s(link, Session::kS1), 212.5e-6, kPicosecond);
  EXPECT_NEAR(ack_s(link), 662.5e-6, kPicosecond);
  EXPECT_NEAR(rn16_s(link), (22 + 16 + 1) * 16e-6, kPicosecond);
  EXPECT_NEAR(epc_reply_s(link), (22 + 128 + 1) * 16e-6, kPicosecond);
  EXPECT_NEAR(t1_s(link), 62.5e-6, kPicosecond);
  EXPECT_NEAR(empty_slot_s(link), 125e-6, kPicosecond);
  EXPECT_NEAR(collided_slot_s(link), 726.5e-6, kPicosecond);
  EXPECT_NEAR(read_slot_s(link), 3907.5e-6, kPicosecond);
}

TEST(LinkTiming, SlowestLinkWaitsForTheSubcarrier) {
  LinkSettings link;
  link.blf_hz = 40e3;
  link.divide_ratio = DivideRatio::k8;
  link.encoding = Encoding::kFm0;
  link.data1_tari = 2.0;
  check(link);
  EXPECT_NEAR(trcal_s(link), 200e-6, kPicosecond);
  EXPECT_NEAR(t1_s(link), 250e-6, kPicosecond);
  EXPECT_NEAR(rn16_s(link), (18 + 16 + 1) * 25e-6, kPicosecond);
}

TEST(LinkTiming, LongerEpcsTakeTheirBits) {
  LinkSettings longer;
  longer.epc_bits = 496;
  EXPECT_NEAR(read_slot_s(longer) - read_slot_s({}), 400 * 16e-6, kPicosecond);
}

// Table 6.9: the frequencies of each divide ratio over TRcal's whole range, 17.2 to 225 µs.
TEST(LinkTiming, DivideRatiosReachTheirFrequenciesAndNoMore) {
  LinkSettings link = fastest();
  link.data1_tari = 1.5;
  link.divide_ratio = DivideRatio::k8;
  link.blf_hz = 465e3;
  EXPECT_NO_THROW(check(link));
  link.blf_hz = 466e3;
  EXPECT_THROW(check(link), Error);
  link = {};
  link.data1_tari = 2.0;
  link.blf_hz = 95e3;
  EXPECT_NO_THROW(check(link));
  link.blf_hz = 94e3;
  EXPECT_THROW(check(link), Error);
}

std::string complaint(const LinkSettings& link) {
  return error_of([&] { check(link); });
}

TEST(LinkTiming, BadParametersAreNamedWithTheirRange) {
  const auto with = [](double LinkSettings::*member, double value) {
    LinkSettings link;
    link.*member = value;
    return complaint(link);
  };
  EXPECT_EQ(with(&LinkSettings::tari_s, 30e-6), "tari must be from 6.25 to 25 us, is 30");
  EXPECT_EQ(with(&LinkSettings::data1_tari, 2.5), "data1 must be from 1.5 to 2 Tari, is 2.5");
  EXPECT_EQ(with(&LinkSettings::blf_hz, 700e3), "blf must be from 40 to 640 kHz, is 700");
  EXPECT_EQ(with(&LinkSettings::blf_hz, 400e3),
            "TRcal (the divide ratio over blf) must be from 68.75 to 187.5 us (1.1 to 3 RTcal), is "
            "53.3333");
  EXPECT_EQ(with(&LinkSettings::t2_tpri, 2.0), "t2 must be from 3 to 20 Tpri, is 2");
  EXPECT_EQ(with(&LinkSettings::t3_tpri, -1.0), "t3 must be from 0 to 1000 Tpri, is -1");
  EXPECT_NE(with(&LinkSettings::tari_s, std::nan("")), "(no error)");
  LinkSettings link;
  link.epc_bits = 100;
  EXPECT_EQ(complaint(link), "epc_bits must be a multiple of 16 from 0 to 496, is 100");
}

}  // namespace
}  // namespace tagfield
