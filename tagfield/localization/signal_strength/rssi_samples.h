// SPDX-License-Identifier: Apache-2.0
/// @file
/// Signal strengths of a tag, averaged over short stretches of the antennas' ways or of time, for
/// the methods that go by RSSI.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Mean over the reads of one antenna while it went a short way.
struct RssiBin {
  Time stamp;             ///< Of the first read.
  Eigen::Vector3d p_WA;   ///< Mean place [m].
  double rssi_dbm = 0.0;  ///< Mean; of whole decibels that vary this is finer than they are.
  double reads = 0.0;
};

/// Whether it was reported.
bool has_rssi(const PhaseSample& sample);

/// Bins of at most `length` [m] of travel, by antenna, in order of time. Reads without RSSI
/// (kNoRssi or not finite) are left out, antennas without any too.
std::map<std::string, std::vector<RssiBin>> rssi_along_paths(const SamplesOfTag& samples,
                                                             double length);

/// Mean RSSI [dBm] by antenna and number of the time bin, of `bin_s` seconds each.
using RssiVector = std::map<std::pair<std::string, std::int64_t>, double>;

RssiVector rssi_over_time(const SamplesOfTag& samples, double bin_s);

}  // namespace tagfield
