// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/reads_csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "odd_names.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

const char* const kReadsHeader = "stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n";

std::vector<TagRead> reads_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_reads_csv(folder.with("r.csv", text));
}

TagRead read_with(const std::string& phase) {
  return reads_of(std::string(kReadsHeader) + "1,r,a,t,865700000," + phase + ",-60\n").at(0);
}

TagRead any_read() {
  TagRead read;
  read.stamp = Time(Duration(*rc::gen::arbitrary<std::int64_t>() / 2));
  read.reader = *rc::gen::elementOf(std::vector<std::string>{"", "r", " r,\"1\" "});
  read.antenna = odd_name();
  read.tag = odd_name();
  read.frequency_hz = 1e9 * (*rc::gen::inRange(1, 1'000'000)) / 999'983.0;
  read.phase_rad = kTwoPi * (*rc::gen::inRange(0, 1'000'000'000)) / 1e9;
  read.rssi_dbm = 0.01 * (*rc::gen::inRange(-20'000, 3000));
  return read;
}

TEST(ReadsToCsv, WritesADocumentedRow) {
  const TagRead read = {Time(Duration(66'666'667)), "r", "a", "t,1", 865.7e6, 1.25, -62.0};
  EXPECT_EQ(reads_to_csv({read}),
            std::string(kReadsHeader) + "0.066666667,r,a,\"t,1\",865700000,1.250000,-62\n");
  EXPECT_EQ(reads_to_csv({}), kReadsHeader);
}

RC_GTEST_PROP(ReadsCsv, ReadsBackWhatItWrote, ()) {
  const TagRead read = any_read();
  const auto reads = reads_of(reads_to_csv({read, read}));
  RC_ASSERT(reads.size() == 2u);
  RC_ASSERT(reads[1].stamp == read.stamp);
  RC_ASSERT(reads[1].reader == read.reader);
  RC_ASSERT(reads[1].antenna == read.antenna);
  RC_ASSERT(reads[1].tag == read.tag);
  RC_ASSERT(reads[1].frequency_hz == read.frequency_hz);
  RC_ASSERT(std::abs(reads[1].phase_rad - read.phase_rad) <= 0.51e-6);
  RC_ASSERT(reads[1].rssi_dbm == read.rssi_dbm);
}

TEST(ReadsCsv, KeepsThePhaseBelowTwoPi) {
  TagRead read = {Time(), "r", "a", "t", 865.7e6, std::nextafter(kTwoPi, 0.0), -60.0};
  EXPECT_NEAR(reads_of(reads_to_csv({read})).at(0).phase_rad, kTwoPi, 1e-6);
}

TEST(ReadReadsCsv, WrapsThePhase) {
  EXPECT_NEAR(read_with("-1").phase_rad, kTwoPi - 1.0, 1e-14);
  EXPECT_NEAR(read_with("7").phase_rad, 7.0 - kTwoPi, 1e-14);
  EXPECT_EQ(read_with("1.5").phase_rad, 1.5);
  EXPECT_GE(read_with("-1e300").phase_rad, 0.0);
  EXPECT_LT(read_with("-1e-300").phase_rad, kTwoPi);
}

TEST(ReadReadsCsv, DoesWithoutReaderAndInAnyOrder) {
  const auto reads =
      reads_of("tag,more,rssi_dbm,phase_rad,frequency_hz,antenna,stamp_s\nt,?,-60.5,1,9e8,a,2\n");
  ASSERT_EQ(reads.size(), 1u);
  EXPECT_EQ(reads[0].reader, "");
  EXPECT_EQ(reads[0].antenna, "a");
  EXPECT_EQ(reads[0].tag, "t");
  EXPECT_EQ(reads[0].frequency_hz, 9e8);
  EXPECT_EQ(reads[0].phase_rad, 1.0);
  EXPECT_EQ(reads[0].rssi_dbm, -60.5);
  EXPECT_EQ(reads[0].stamp, Time(Duration(2'000'000'000)));
}

/// By the paper's law RSSI is 40 log₁₀ of an amplitude that noise may cancel.
TEST(ReadReadsCsv, TakesRssiOfAVanishingAmplitude) {
  const auto reads = reads_of(std::string(kReadsHeader) + "1,r,a,t,9e8,1,-12304\n");
  ASSERT_EQ(reads.size(), 1u);
  EXPECT_EQ(reads[0].rssi_dbm, -12304.0);
}

TEST(ReadReadsCsv, NamesColumnAndLineOfBadInput) {
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"1,r,a,t,0,1,-60", "frequency_hz must be greater than 0"},
      {"1,r,a,t,-9e8,1,-60", "frequency_hz must be greater than 0"},
      {"1,r,a,t,nan,1,-60", "frequency_hz is 'nan'"},
      {"1,r,a,t,9e8,inf,-60", "phase_rad is 'inf'"},
      {"1,r,a,t,9e8,1,loud", "rssi_dbm is 'loud'"},
      {"1,r,a,t,9e8,1,1e300", "rssi_dbm must be at most 300 dBm, is 1e+300"},
      {"1,r,,t,9e8,1,-60", "antenna is empty"},
      {"1,r,a,,9e8,1,-60", "tag is empty"},
      {"never,r,a,t,9e8,1,-60", "stamp_s: 'never'"},
  };
  for (const auto& [row, complaint] : bad) {
    const std::string text = std::string(kReadsHeader) + "1,r,a,t,9e8,1,-60\n" + row + "\n";
    const std::string message = error_of([&] { reads_of(text); });
    EXPECT_TRUE(contains(message, "r.csv:3: " + complaint)) << message;
  }
  EXPECT_TRUE(contains(error_of([] { reads_of("stamp_s,antenna\n1,a\n"); }), "no column 'tag'"));
}

std::vector<std::string> warnings_of(const std::string& rows) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  read_reads_csv(folder.with("r.csv", kReadsHeader + rows), {}, &diagnostics);
  std::vector<std::string> warnings = diagnostics.warnings();
  for (std::string& warning : warnings) warning = warning.substr(warning.find("r.csv"));
  return warnings;
}

using Warnings = std::vector<std::string>;

TEST(ReadReadsCsv, WarnsOfCarriersThatCannotBeInHertz) {
  EXPECT_EQ(warnings_of("1,r,a,t,865700000,1,-60\n"), Warnings{});
  EXPECT_EQ(warnings_of("1,r,a,t,865700000,1,-60\n2,r,a,t,866.3,1,-60\n3,r,a,t,867.5,1,-60\n"),
            Warnings{"r.csv:3: frequency_hz is 866.3, expected a carrier in Hz, from 1e+06 to "
                     "1e+11: is it in MHz? (2 rows are like that)"});
  EXPECT_EQ(warnings_of("1,r,a,t,865700,1,-60\n"),
            Warnings{"r.csv:2: frequency_hz is 865700, expected a carrier in Hz, from 1e+06 to "
                     "1e+11: is it in kHz?"});
  EXPECT_EQ(warnings_of("1,r,a,t,0.9157,1,-60\n"),
            Warnings{"r.csv:2: frequency_hz is 0.9157, expected a carrier in Hz, from 1e+06 to "
                     "1e+11: is it in GHz?"});
  EXPECT_EQ(warnings_of("1,r,a,t,1e15,1,-60\n"),
            Warnings{"r.csv:2: frequency_hz is 1e+15, expected a carrier in Hz, from 1e+06 to "
                     "1e+11"});
}

TEST(ReadReadsCsv, WarnsOfPhasesThatAreHardlyInRadians) {
  EXPECT_EQ(warnings_of("1,r,a,t,9e8,12.56,-60\n2,r,a,t,9e8,-3.1,-60\n"), Warnings{});
  EXPECT_EQ(warnings_of("1,r,a,t,9e8,90,-60\n2,r,a,t,9e8,-270.5,-60\n3,r,a,t,9e8,180,-60\n"),
            Warnings{"r.csv:3: phase_rad is -270.5: whole cycles are dropped, which is right for "
                     "unwrapped phases in radians, but not for degrees or steps of a cycle, which "
                     "a --format tells"});
}

TEST(ReadReadsCsv, RefusesATableFromAnotherSourceAsAWhole) {
  EXPECT_TRUE(contains(error_of([] { reads_of("EPC,Timestamp,RSSI\na,1,-60\n"); }),
                       "r.csv:1: not in Tagfield's own format (stamp_s,reader,antenna,tag,"
                       "frequency_hz,phase_rad,rssi_dbm), as its columns are EPC,Timestamp,RSSI;"));
}

}  // namespace
}  // namespace tagfield
