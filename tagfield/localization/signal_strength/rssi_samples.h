// SPDX-License-Identifier: Apache-2.0
/// @file
/// RSSI of a tag, averaged over short sections of the antennas' paths or over short times, for the
/// methods that use RSSI.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Mean over the reads of one antenna on a short section of its path.
struct RssiBin {
  Time stamp;             ///< Of the first read.
  Eigen::Vector3d p_WA;   ///< Mean position [m].
  double rssi_dbm = 0.0;  ///< Mean; finer than the whole decibels averaged.
  double reads = 0.0;
};

/// Whether the sample has an RSSI.
bool has_rssi(const PhaseSample& sample);

/// Bins spanning at most `length` [m], by antenna, in time order. Reads without RSSI (kNoRssi or
/// not finite) are left out, as are antennas without any.
std::map<std::string, std::vector<RssiBin>> rssi_along_paths(const SamplesOfTag& samples,
                                                             double length);

/// Mean RSSI [dBm] by antenna and index of the time bin of `bin_s` seconds.
using RssiVector = std::map<std::pair<std::string, std::int64_t>, double>;

RssiVector rssi_over_time(const SamplesOfTag& samples, double bin_s);

}  // namespace tagfield
