// SPDX-License-Identifier: Apache-2.0
/// @file
/// Rows of the tables that Python gets: plain numbers, with names as numbers of their own, so that
/// NumPy takes them as they lie in memory.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

namespace tagfield::python {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Names by number, in the order in which they first came.
class Names {
 public:
  std::int32_t number_of(const std::string& name) {
    const auto [found, is_new] = numbers_.emplace(name, static_cast<std::int32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return found->second;
  }
  [[nodiscard]] const std::vector<std::string>& all() const { return names_; }

 private:
  std::unordered_map<std::string, std::int32_t> numbers_;
  std::vector<std::string> names_;
};

struct ReadRow {
  std::int64_t stamp_ns;
  std::int32_t reader, antenna, tag;
  double frequency_hz, phase_rad, rssi_dbm, doppler_hz;  ///< The last NaN where it is not reported.
};

/// An antenna or a robot.
struct PoseRow {
  std::int64_t stamp_ns;
  std::int32_t name;
  double position_m[3];
  double quaternion_xyzw[4];
  double covariance[3][3];  ///< Of x, y, yaw [m², m·rad, rad²]; NaN where it is not stated.
};

struct TagRow {
  std::int64_t stamp_ns;
  std::int32_t tag;
  double position_m[3];
};

struct DistanceRow {
  std::int64_t stamp_ns;
  std::int32_t antenna, tag;
  double distance_m;
};

struct EstimateRow {
  std::int32_t tag, verdict, reason;
  std::int64_t reads, reads_used;
  double position_m[3];  ///< Of a located tag, else NaN.
  double covariance_m2[3][3];
  double expected_error_m, rms_m;
  double truth_m[3];          ///< NaN where nobody knows it, or the tag moved.
  double error_m;             ///< Of a located tag whose place is known, in space.
  double horizontal_error_m;  ///< The same without its part in z, as expected_error_m.
  bool reference;             ///< Its position was given.
};

struct CandidateRow {
  std::int32_t tag, number;
  double position_m[3];
  double covariance_m2[3][3];
  double expected_error_m, rms_m;
};

struct SampleRow {
  std::int64_t stamp_ns;
  std::int32_t antenna;
  double phase_rad, frequency_hz, rssi_dbm;
  double position_m[3];  ///< Of the antenna, as believed.
};

struct TrackRow {
  std::int32_t tag, verdict, reason, number;
  std::int64_t reads, points;
  double rms_rad, coherence, expected_error_m;
};

struct TrackPointRow {
  std::int64_t stamp_ns;
  std::int32_t tag, number;
  double position_m[3];
  double velocity_m_s[3];
  double covariance[6][6];
};

struct PassingRow {
  std::int64_t stamp_ns;
  std::int32_t place, tag;
  double sigma_s;
};

struct TagCoverageRow {
  std::int32_t tag, verdict, nearest, antenna;
  double position_m[3];
  double nearest_m, power_dbm, reply_dbm, margin_db, probability;
};

struct LinkRow {
  double distance_m, tag_dbm, reply_dbm, phase_rad;
  bool readable;
};

}  // namespace tagfield::python
