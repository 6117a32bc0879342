// SPDX-License-Identifier: Apache-2.0
/// @file
/// Antennas and tags as an SDF sensor's plugin describes them: the published plugin's parameters,
/// and those that Tagfield adds.
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

/// What the plugin of an `rfid` sensor says.
///
/// The published parameters, with their published defaults: `frequency` [Hz] 865.7e6, `noisephi`
/// [rad] 0.1, `noiserssi` (amplitude) 0.005, `range` [m] 5, `communication_gain` 250,
/// `optional_distribution` none, `optional_distribution_params` (numbers between spaces); and the
/// sensor's `update_rate` [Hz] 15.
///
/// Tagfield's own: `model` paper | link_budget | multipath (default paper), `antenna` (its name,
/// unique; default: the sensor's), `reader` (the name of its reader; default: the antenna's),
/// `phase_offset` [rad] 0, `range_sigma` (relative spread of the range) 0.05, `sensitivity_dbm`
/// (least RSSI that is reported) none.
///
/// In Gazebo alone: `seed` (of all random draws) 1, `robotNamespace` (of the topics) none,
/// `frame_id` (of the messages; default: the antenna's name), `parent_frame` (the link of the same
/// model that the frame is told to hang from; none where it is not told).
///
/// With a physical model `parameters.model` is made by sensor_radio() from all settings of
/// radio_settings.h, and of the published parameters only `frequency` and `update_rate` count.
struct SensorAntenna {
  AntennaParameters parameters;
  std::uint64_t seed = 1;
  std::string name_space;
  std::string frame_id;
  std::string parent_frame;
};

/// Reads an antenna's parameters; `sensor` is the sensor's name. Throws Error on a value that is no
/// number or out of its range, naming the parameter, with the place in the file where it is known.
/// Unknown parameters are warned of, and the published ones that are missing in one warning.
SensorAntenna antenna_from(const std::string& sensor, const std::vector<RawParameter>& parameters,
                           const Location& location, Diagnostics& diagnostics);

/// What the plugin of an `rfidtag` sensor says.
struct SensorTag {
  std::optional<std::string> epc;         ///< Its ID, where one is given.
  std::shared_ptr<const TagModel> model;  ///< Its kind for physical models; null where not told.
};

/// Reads a tag's `epc` and its settings of radio_settings.h. Throws Error on an ID that is empty
/// and on a setting that is wrong, naming it. Unknown parameters are warned of.
SensorTag tag_from(const std::vector<RawParameter>& parameters, const Location& location,
                   Diagnostics& diagnostics);

/// The numbers in `parameter`'s value, between white space. Throws Error if one is none.
std::vector<double> numbers_of(const RawParameter& parameter);

}  // namespace tagfield
