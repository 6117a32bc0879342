// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/reports.h"

#include <gtest/gtest.h>

#include "tagfield/base/units.h"

namespace tagfield::llrp {
namespace {

TagReport report_of(std::uint16_t epc, double rssi_dbm = -60.0) {
  TagReport report;
  report.epc = {epc, 0, 0, 0, 0, 1};
  report.antenna = 2;
  report.peak_rssi_dbm = rssi_dbm;
  report.first_us = report.last_us = 0x0102030405060708;
  return report;
}

ReportSpec nothing_selected() {
  ReportSpec spec;
  for (bool* selected :
       {&spec.ro_spec, &spec.spec_index, &spec.inventory_spec, &spec.antenna, &spec.channel,
        &spec.peak_rssi, &spec.first_seen, &spec.last_seen, &spec.seen_count, &spec.access_spec}) {
    *selected = false;
  }
  return spec;
}

Bytes written(const TagReport& report, const ReportSpec& spec) {
  ByteWriter writer;
  write_report(report, spec, writer);
  return writer.written();
}

/// TagReportData (240) with EPC-96 (13), AntennaID (1), PeakRSSI (6), FirstSeenTimestampUTC (2) and
/// TagSeenCount (8), assembled by hand from §16.2.7.3.
TEST(Reports, AreOfTheseBytes) {
  ReportSpec spec = nothing_selected();
  spec.antenna = spec.peak_rssi = spec.first_seen = spec.seen_count = true;
  EXPECT_EQ(written(report_of(0x3074), spec),
            (Bytes{0,    240,  0,    34,                             //
                   0x8d, 0x30, 0x74, 0,  0, 0, 0, 0, 0, 0, 0, 0, 1,  //
                   0x81, 0,    2,                                    //
                   0x86, 0xc4,                                       //
                   0x82, 1,    2,    3,  4, 5, 6, 7, 8,              //
                   0x88, 0,    1}));
}

/// EPCData (241), with its length in bits, for EPCs of other than 96 bits.
TEST(Reports, OtherEpcsTellTheirLength) {
  TagReport report;
  report.epc = {0xabcd};
  EXPECT_EQ(written(report, nothing_selected()),
            (Bytes{0, 240, 0, 12, 0, 241, 0, 8, 0, 16, 0xab, 0xcd}));
}

/// The vendor's parameters: 14 bytes each with their header; a quarter cycle that increases with
/// distance is three quarters of a cycle that decreases.
TEST(Reports, PhaseFallsInTheVendorsWay) {
  ReportSpec spec = nothing_selected();
  spec.phase = spec.fine_rssi = spec.doppler = true;
  TagReport report;
  report.epc = {0xabcd};
  report.phase_rad = kPi / 2.0;
  report.peak_rssi_dbm = -61.25;
  report.doppler_hz = -2.0;
  const Bytes bytes = written(report, spec);
  ASSERT_EQ(bytes.size(), 12U + 3U * 14U);
  const auto value_at = [&](std::size_t at) { return bytes[at] << 8 | bytes[at + 1]; };
  EXPECT_EQ(Bytes(bytes.begin() + 12, bytes.begin() + 24),
            (Bytes{0x03, 0xff, 0, 14, 0, 0, 0x65, 0x1a, 0, 0, 0, 56}));
  EXPECT_EQ(value_at(24), 3072);
  EXPECT_EQ(static_cast<std::int16_t>(value_at(38)), -6125);
  EXPECT_EQ(static_cast<std::int16_t>(value_at(52)), -32);
}

TEST(Reports, PhaseZeroStaysWithinATurn) {
  ReportSpec spec = nothing_selected();
  spec.phase = true;
  TagReport report;
  report.phase_rad = 1e-9;
  const Bytes bytes = written(report, spec);
  EXPECT_EQ(bytes[bytes.size() - 2] << 8 | bytes.back(), 0);
}

TEST(Reports, ReadsOfOneTagAddUp) {
  ReportSpec spec;
  spec.n = 3;
  spec.trigger = 2;
  ReportGathering gathering(spec);
  gathering.add(report_of(1, -60.0));
  TagReport later = report_of(1, -50.0);
  later.last_us = 0x0102030405060809;
  gathering.add(later);
  gathering.add(report_of(2));
  EXPECT_FALSE(gathering.is_full());
  TagReport elsewhere = report_of(1);
  elsewhere.antenna = 3;
  gathering.add(elsewhere);
  EXPECT_TRUE(gathering.is_full());

  TagReport sum = report_of(1, -50.0);
  sum.last_us = later.last_us;
  sum.seen = 2;
  const std::vector<Bytes> all = gathering.take();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0], written(sum, spec));
  EXPECT_EQ(all[1], written(report_of(2), spec));
  EXPECT_TRUE(gathering.take().empty());
}

TEST(Reports, AntennasThatAreNotReportedMakeNoDifference) {
  ReportSpec spec = nothing_selected();
  ReportGathering gathering(spec);
  gathering.add(report_of(1));
  TagReport elsewhere = report_of(1);
  elsewhere.antenna = 3;
  gathering.add(elsewhere);
  EXPECT_EQ(gathering.take().size(), 1U);
}

TEST(Reports, ResultsOfOperationsStandAlone) {
  ReportGathering gathering{ReportSpec{}};
  TagReport operated = report_of(1);
  operated.op_results = {1};
  gathering.add(report_of(1));
  gathering.add(operated);
  gathering.add(report_of(1));
  EXPECT_EQ(gathering.take().size(), 2U);
}

}  // namespace
}  // namespace tagfield::llrp
