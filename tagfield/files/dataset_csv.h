// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads in third-party tables: the columns' meanings and units, and the sign of the phase.
/// docs/datasets.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/files/csv.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Format of the time.
struct StampForm {
  std::string column;          ///< "" if there is no time.
  double seconds = 1.0;        ///< Unit of the column [s].
  bool iso = false;            ///< Dates like 2024-05-01T12:30:00.25, with or without a Z; UTC.
  double rows_apart_s = 1e-3;  ///< Without a column: interval between rows.
};

/// Format of antenna names.
struct AntennaForm {
  std::string column;  ///< "" if all reads are by one antenna.
  std::string name = "antenna";
};

/// Format of positions.
struct PositionForm {
  std::array<std::string, 3> columns;  ///< For x, y and z; that of z may be "".
  double metres = 1.0;                 ///< Unit of the columns [m].
  double z_m = 0.0;                    ///< If there is no column for z.
};

/// Format of the carrier.
struct FrequencyForm {
  std::string column;               ///< "" if it is always `hertz`.
  double hertz = 1.0;               ///< Unit of the column, or the carrier [Hz].
  std::vector<double> channels_hz;  ///< If not empty, the column has the number of one of these,
  int first_channel = 1;            ///< and this is the number of the first.
};

/// Format of the phase.
struct PhaseForm {
  std::string column;    ///< "" if there is none; phases are then 0.
  double radians = 1.0;  ///< Unit of the column [rad].
  bool falls = false;    ///< It decreases with distance.
};

/// Format of a separate table of antenna poses.
struct PoseTableForm {
  CsvForm csv;
  StampForm stamp;
  AntennaForm antenna;
  PositionForm position;
};

/// Format of a table of reads.
struct DatasetForm {
  CsvForm csv;
  StampForm stamp;
  std::string tag_column;  ///< Spaces within an EPC are removed.
  AntennaForm antenna;
  PhaseForm phase;
  std::string rssi_column;  ///< "" if there is none: RSSI is then −200 dBm, as missing.
  double decibels = 1.0;    ///< Unit of the RSSI [dB].
  FrequencyForm frequency;
  std::optional<PositionForm> position;             ///< Of the antenna, in the rows of its reads.
  std::optional<PoseTableForm> poses;               ///< Of a separate table.
  std::map<std::string, Eigen::Vector3d> antennas;  ///< Positions of antennas at rest [m].
};

/// Contents of a dataset.
struct Dataset {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;  ///< One per stamp and antenna, without rotation.
};

/// Reads a table of reads, with the antennas' positions if it has any; or all tables (*.csv) of a
/// folder, one after the other in the order of their names, in which numbers are sorted by value.
/// Throws Error "FILE:LINE: …".
Dataset read_dataset_csv(const std::string& path, const DatasetForm& form);

/// Reads a table of antenna poses. Throws Error "FILE:LINE: …".
std::vector<AntennaPose> read_dataset_poses_csv(const std::string& path, const PoseTableForm& form);

}  // namespace tagfield
