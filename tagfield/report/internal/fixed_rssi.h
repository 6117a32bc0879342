// SPDX-License-Identifier: Apache-2.0
/// @file
/// RSSI of all tags at the fixed antenna, for the two figures that show it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/report/run_files.h"

namespace tagfield {

/// One tag at the fixed antenna.
struct TagStrength {
  std::string tag;
  std::vector<double> rssi_dbm;         ///< In chronological order; never empty.
  double mean_dbm = 0.0;                ///< Mean of the dBm values.
  std::optional<Eigen::Vector3d> p_WT;  ///< True position, or else the estimate.
};

/// All values of all tags together.
std::vector<double> all_values(const std::vector<TagStrength>& strengths);

/// The tags at the antenna of `track`, in natural order.
std::vector<TagStrength> strengths_at(const RunFiles& run, const AntennaTrack& track);

/// Minimum and maximum of all values [dBm]; `strengths` must not be empty.
std::pair<double, double> range_of(const std::vector<TagStrength>& strengths);

/// The fixed antenna with the most reads; null if there is none with reads, with the reason in
/// `missing`.
const AntennaTrack* fixed_track(const RunFiles& run, std::string& missing);

}  // namespace tagfield
