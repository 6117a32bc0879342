// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads as JSON, a line each, with the names that readers give them which stream over HTTP and
/// MQTT by themselves.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Numbers of antennas at their readers, from 1 on, in the order in which they were first asked
/// for.
class AntennaPorts {
 public:
  /// As it was told, or else the next of the reader's.
  int port_of(const std::string& reader, const std::string& antenna);
  void set(const std::string& reader, const std::string& antenna, int port);

 private:
  std::map<std::pair<std::string, std::string>, int> ports_;
  std::map<std::string, int> counts_;
};

/// The read at the end of `json`, without a line's end:
/// - `timestamp`: `start`, since 1970, plus its stamp, in UTC with nine decimals;
/// - `reader`, `antennaPort` (1, 2, …), `antennaName`;
/// - `epc`: the tag's ID as it is, and where it has bits `epcHex`, in upper case;
/// - `peakRssiCdbm` [dBm/100], `phaseAngle` [deg], `frequency` [kHz], and `dopplerHz` where told.
void append_json(const TagRead& read, Time start, AntennaPorts& ports, std::string& json);

/// The same by itself, with a line's end.
std::string read_to_json_line(const TagRead& read, Time start, AntennaPorts& ports);

}  // namespace tagfield
