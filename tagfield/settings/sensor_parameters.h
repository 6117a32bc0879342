// SPDX-License-Identifier: Apache-2.0
/// @file
/// Antennas and tags as described by an SDF sensor's plugin: the published plugin's parameters, and
/// those added by Tagfield.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"
#include "tagfield/reader/antenna.h"

namespace tagfield {

struct TagModel;

/// The parameters of an `rfid` sensor's plugin.
///
/// The published parameters, with their published defaults: `frequency` [Hz] 865.7e6, `noisephi`
/// [rad] 0.1, `noiserssi` (amplitude) 0.005, `range` [m] 5, `communication_gain` 250,
/// `optional_distribution` none, `optional_distribution_params` (numbers separated by spaces); and
/// the sensor's `update_rate` [Hz] 15.
///
/// Tagfield's own: `model` paper | link_budget | multipath (default paper), `antenna` (its name,
/// unique; default: the sensor's), `reader` (the name of its reader; default: the antenna's),
/// `phase_offset` [rad] 0, `range_sigma` (relative spread of the range) 0.05, `sensitivity_dbm`
/// (minimum RSSI that is reported) none.
///
/// In Gazebo only: `seed` (of all random draws) 1, `robotNamespace` (of the topics) none,
/// `frame_id` (of the messages; default: the antenna's name), `parent_frame` (the link of the same
/// model that the frame is published as a child of; default: none).
///
/// With a physical model `parameters.model` is built by sensor_radio() from the settings in
/// radio_settings.h; of the published parameters only `frequency` and `update_rate` then have an
/// effect.
struct SensorAntenna {
  AntennaParameters parameters;
  std::uint64_t seed = 1;
  std::string name_space;
  std::string frame_id;
  std::string parent_frame;
};

/// Reads an antenna's parameters; `sensor` is the sensor's name. Throws Error on a value that is
/// not a number or out of range, naming the parameter and, if known, its location in the file.
/// Warns about each unknown parameter, and once about all published ones that are missing.
SensorAntenna antenna_from(const std::string& sensor, const std::vector<RawParameter>& parameters,
                           const Location& location, Diagnostics& diagnostics);

/// The parameters of an `rfidtag` sensor's plugin.
struct SensorTag {
  std::optional<std::string> epc;         ///< Its ID, if one is given.
  std::shared_ptr<const TagModel> model;  ///< Its kind for physical models; null if not given.
};

/// Reads a tag's `epc` and its settings of radio_settings.h. Throws Error on an empty ID and on an
/// invalid setting, naming it. Warns about unknown parameters.
SensorTag tag_from(const std::vector<RawParameter>& parameters, const Location& location,
                   Diagnostics& diagnostics);

/// The numbers in `parameter`'s value, separated by white space. Throws Error if one of them is not
/// a number.
std::vector<double> numbers_of(const RawParameter& parameter);

}  // namespace tagfield
