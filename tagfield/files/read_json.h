// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads as JSON, one per line, with the key names of readers that stream over HTTP and MQTT
/// themselves.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Port numbers of antennas at their readers, from 1 on, in the order in which they are first
/// requested.
class AntennaPorts {
 public:
  /// The port as set, or else the reader's next one.
  int port_of(const std::string& reader, const std::string& antenna);
  void set(const std::string& reader, const std::string& antenna, int port);

 private:
  std::map<std::pair<std::string, std::string>, int> ports_;
  std::map<std::string, int> counts_;
};

/// Appends the read to `json`, without a line end:
/// - `timestamp`: `start`, since 1970, plus its stamp, in UTC with nine decimals;
/// - `reader`, `antennaPort` (1, 2, …), `antennaName`;
/// - `epc`: the tag's ID as it is, and, if it has a binary form, `epcHex`, in upper case;
/// - `peakRssiCdbm` [dBm/100], `phaseAngle` [deg], `frequency` [kHz], and `dopplerHz` if reported.
void append_json(const TagRead& read, Time start, AntennaPorts& ports, std::string& json);

/// Same, as a new string with a line end.
std::string read_to_json_line(const TagRead& read, Time start, AntennaPorts& ports);

}  // namespace tagfield
