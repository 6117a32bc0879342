// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a reader reports: the one record type delivered by both simulated and real readers.
#pragma once

#include <optional>
#include <string>

#include "tagfield/base/time.h"

namespace tagfield {

/// One read of one tag.
struct TagRead {
  Time stamp;                 ///< When the tag answered.
  std::string reader;         ///< Name of the reader.
  std::string antenna;        ///< Name of the antenna, unique over all readers.
  std::string tag;            ///< The tag's ID (its EPC).
  double frequency_hz = 0.0;  ///< Carrier.
  double phase_rad = 0.0;     ///< In [0, 2π), growing with distance (eq. 3 of the paper).
  double rssi_dbm = 0.0;
  std::optional<double> doppler_hz{};  ///< If the reader reports it; positive when approaching.
};

}  // namespace tagfield
