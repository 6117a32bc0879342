// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of a recording to a run's folder and its page, for `localize` and for `report` of a
/// bag.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/ros_options.h"
#include "tagfield/experiment/odometry_csv.h"
#include "tagfield/localization/locate.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {

/// Contents of the files of --tag-heights, --reference and --odometry.
struct KnownTables {
  std::map<std::string, double> heights;              ///< [m]
  std::map<std::string, Eigen::Vector3d> references;  ///< [m, world]
  OdometryByAntenna odometry;
};

struct LocalizeArguments {
  std::string recording;  ///< Reads as CSV, or a bag.
  std::string poses;      ///< For CSV reads a file; for a bag one of kPoseWords, or "".
  std::string format;     ///< Format of third-party tables (YAML), or "".
  std::string method;     ///< "" for the scenario's, or "auto" without one.
  std::string out;        ///< "" for the default.
  std::string scenario;   ///< File, or "".
  RosOptions ros{};
  std::string heights_file;          ///< CSV, or "".
  std::string height_side;           ///< "above", "below", or "".
  std::string old_height_side;       ///< Same, by the option's former name.
  std::string circular;              ///< "right" or "left" polarized antennas, or "".
  std::string side;                  ///< Side of the path that tags are on, or "".
  std::vector<double> box;           ///< X0 Y0 X1 Y1 that contains the tags, or empty.
  std::string references_file;       ///< CSV, or "".
  std::string odometry_file;         ///< CSV of antennas on wheel odometry, or "".
  std::vector<std::string> offsets;  ///< "RAD" or "ANTENNA=RAD".
  std::optional<double> pose_sigma_m;
  std::optional<double> pose_yaw_sigma_deg;
  std::optional<double> pose_time_constant_s;
  std::optional<double> map_sigma_m;
  std::optional<double> world_sigma_m;
  std::optional<double> map_yaw_sigma_deg;
  std::string calibration;  ///< Profile, or "".
  std::optional<double> tag_height_m;
  std::vector<std::string> settings;      ///< "KEY=VALUE", of the method.
  std::optional<std::size_t> part_reads;  ///< See part_of_table().
  int threads = default_threads();
  bool as_json = false;
  WorldOptions world{};  ///< Of the scenario.
  KnownTables tables{};  ///< Read from its files, once.
};

/// Values of `--poses` for a bag.
inline constexpr const char* kPoseWords = "auto, true, tf or odometry";

/// Locates the tags, writes the folder and the page, prints the table; returns the exit code.
int localize(const LocalizeArguments& arguments);

}  // namespace tagfield
