// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads in the forms of other people's tables: which column is what, in which unit, and which way
/// phases turn. docs/datasets.md.
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

/// How a table tells when.
struct StampForm {
  std::string column;          ///< "" where it tells no time.
  double seconds = 1.0;        ///< One unit of the column [s].
  bool iso = false;            ///< Dates as 2024-05-01T12:30:00.25, with or without a Z; UTC.
  double rows_apart_s = 1e-3;  ///< Without a column: from row to row.
};

/// How a table names antennas.
struct AntennaForm {
  std::string column;  ///< "" where all are of one.
  std::string name = "antenna";
};

/// How a table tells places.
struct PositionForm {
  std::array<std::string, 3> columns;  ///< Of x, y and z; that of z may be "".
  double metres = 1.0;                 ///< One unit of the columns [m].
  double z_m = 0.0;                    ///< Where there is no column of z.
};

/// How a table tells the carrier.
struct FrequencyForm {
  std::string column;               ///< "" where it is always `hertz`.
  double hertz = 1.0;               ///< One unit of the column, or the carrier [Hz].
  std::vector<double> channels_hz;  ///< Not empty: the column has the number of one of these,
  int first_channel = 1;            ///< of which the first is this.
};

/// How a table tells the phase.
struct PhaseForm {
  std::string column;    ///< "" where there is none; phases are then 0.
  double radians = 1.0;  ///< One unit of the column [rad].
  bool falls = false;    ///< It falls with distance.
};

/// A table of antenna poses by themselves.
struct PoseTableForm {
  CsvForm csv;
  StampForm stamp;
  AntennaForm antenna;
  PositionForm position;
};

/// A table of reads.
struct DatasetForm {
  CsvForm csv;
  StampForm stamp;
  std::string tag_column;  ///< Spaces within an EPC are left out.
  AntennaForm antenna;
  PhaseForm phase;
  std::string rssi_column;  ///< "" where there is none: then it is −200 dBm, which stands for that.
  double decibels = 1.0;    ///< One unit of the RSSI [dB].
  FrequencyForm frequency;
  std::optional<PositionForm> position;             ///< Of the antenna, in the rows of its reads.
  std::optional<PoseTableForm> poses;               ///< Of a table beside.
  std::map<std::string, Eigen::Vector3d> antennas;  ///< Places of antennas that stood [m].
};

/// What a dataset has.
struct Dataset {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;  ///< One a stamp and antenna, without turning.
};

/// Reads a table of reads, with the antennas' places where it has any; or all tables (*.csv) of a
/// folder, one after the other in the order of their names, in which numbers go by value. Throws
/// Error "FILE:LINE: …".
Dataset read_dataset_csv(const std::string& path, const DatasetForm& form);

/// Reads a table of antenna poses. Throws Error "FILE:LINE: …".
std::vector<AntennaPose> read_dataset_poses_csv(const std::string& path, const PoseTableForm& form);

}  // namespace tagfield
