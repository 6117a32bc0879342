// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/read_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tagfield/base/units.h"
#include "tagfield/base/utc.h"
#include "tagfield/epc/epc.h"
#include "tagfield/files/json_text.h"

namespace tagfield {
int AntennaPorts::port_of(const std::string& reader, const std::string& antenna) {
  int& port = ports_[{reader, antenna}];
  if (port == 0) port = ++counts_[reader];
  return port;
}

void AntennaPorts::set(const std::string& reader, const std::string& antenna, int port) {
  ports_[{reader, antenna}] = port;
  counts_[reader] = std::max(counts_[reader], port);
}

void append_json(const TagRead& read, Time start, AntennaPorts& ports, std::string& json) {
  const auto out = std::back_inserter(json);
  fmt::format_to(out, R"({{"timestamp":"{}","reader":)",
                 utc_text(start + read.stamp.time_since_epoch(), 9));
  append_quoted(read.reader, json);
  fmt::format_to(out, R"(,"antennaPort":{},"antennaName":)",
                 ports.port_of(read.reader, read.antenna));
  append_quoted(read.antenna, json);
  json += R"(,"epc":)";
  append_quoted(read.tag, json);
  const std::string bits = bits_of_id(read.tag);
  if (!bits.empty()) fmt::format_to(out, R"(,"epcHex":"{}")", bits);
  fmt::format_to(out, R"(,"peakRssiCdbm":{},"phaseAngle":{:.4f},"frequency":{:.10g})",
                 std::lround(100.0 * read.rssi_dbm), degrees(read.phase_rad),
                 1e-3 * read.frequency_hz);
  if (read.doppler_hz) fmt::format_to(out, R"(,"dopplerHz":{:.4f})", *read.doppler_hz);
  json += '}';
}

std::string read_to_json_line(const TagRead& read, Time start, AntennaPorts& ports) {
  std::string json;
  append_json(read, start, ports, json);
  return json += '\n';
}

}  // namespace tagfield
