// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/read_json.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>

#include "tagfield/base/units.h"
#include "tagfield/base/utc.h"
#include "tagfield/files/json_text.h"

namespace tagfield {
namespace {

TagRead shelf_read() {
  TagRead read;
  read.stamp = time_from_seconds(0.25);
  read.reader = "dock";
  read.antenna = "left";
  read.tag = "3074257bf7194e4000001a85";
  read.frequency_hz = 866.9e6;
  read.phase_rad = kPi / 2.0;
  read.rssi_dbm = -52.345;
  return read;
}

const Time kStart = utc_from_text("2020-01-01");

TEST(ReadToJsonLine, HasTheNamesAndUnitsOfReaders) {
  AntennaPorts ports;
  TagRead read = shelf_read();
  EXPECT_EQ(read_to_json_line(read, kStart, ports),
            R"({"timestamp":"2020-01-01T00:00:00.250000000Z","reader":"dock","antennaPort":1,)"
            R"("antennaName":"left","epc":"3074257bf7194e4000001a85",)"
            R"("epcHex":"3074257BF7194E4000001A85","peakRssiCdbm":-5235,"phaseAngle":90.0000,)"
            R"("frequency":866900})"
            "\n");
  read.antenna = "right";
  read.tag = "pallet \"7\"";
  read.doppler_hz = -1.5;
  EXPECT_EQ(read_to_json_line(read, kStart, ports),
            R"({"timestamp":"2020-01-01T00:00:00.250000000Z","reader":"dock","antennaPort":2,)"
            R"("antennaName":"right","epc":"pallet \"7\"","peakRssiCdbm":-5235,)"
            R"("phaseAngle":90.0000,"frequency":866900,"dopplerHz":-1.5000})"
            "\n");
}

TEST(ReadToJsonLine, TellsTheBitsOfUris) {
  AntennaPorts ports;
  TagRead read = shelf_read();
  read.tag = "urn:epc:tag:sgtin-96:3.0614141.812345.6789";
  const std::string line = read_to_json_line(read, kStart, ports);
  EXPECT_NE(line.find(R"("epcHex":"3074257BF7194E4000001A85")"), std::string::npos) << line;
}

TEST(AntennaPorts, CountAtEachReaderByItself) {
  AntennaPorts ports;
  EXPECT_EQ(ports.port_of("a", "one"), 1);
  EXPECT_EQ(ports.port_of("a", "two"), 2);
  EXPECT_EQ(ports.port_of("b", "three"), 1);
  EXPECT_EQ(ports.port_of("a", "one"), 1);
}

TEST(JsonString, EscapesWhatJsonDoesNotTake) {
  EXPECT_EQ(json_string("a\"b\\c\n\x01"), R"("a\"b\\c\u000a\u0001")");
  EXPECT_EQ(json_string("größer €😀"), "\"größer €😀\"");
}

// Overlong forms, surrogates, characters above U+10FFFF and truncated ones.
TEST(JsonString, ReplacesWhatIsNoUtf8) {
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(json_string("a\xFFz"), "\"a" + bad + "z\"");
  EXPECT_EQ(json_string("\xC0\xAF"), '"' + bad + bad + '"');
  EXPECT_EQ(json_string("\xED\xA0\x80"), '"' + bad + bad + bad + '"');
  EXPECT_EQ(json_string("\xF4\x90\x80\x80"), '"' + bad + bad + bad + bad + '"');
  EXPECT_EQ(json_string("\xE2\x82"), '"' + bad + bad + '"');
}

/// Decodes escapes independently of the code under test.
std::string unquoted(const std::string& json) {
  std::string text;
  for (std::size_t i = 1; i + 1 < json.size(); ++i) {
    if (json[i] != '\\') {
      text += json[i];
    } else if (json[++i] == 'u') {
      text += static_cast<char>(std::strtol(json.substr(i + 1, 4).c_str(), nullptr, 16));
      i += 4;
    } else {
      text += json[i];
    }
  }
  return text;
}

RC_GTEST_PROP(JsonString, KeepsAllAscii, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::inRange<char>(1, 127));
  const std::string json = json_string(text);
  RC_ASSERT(unquoted(json) == text);
  for (const char c : json) RC_ASSERT(c >= 0x20);
}

}  // namespace
}  // namespace tagfield
