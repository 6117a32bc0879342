// SPDX-License-Identifier: Apache-2.0
/// @file
/// RFID sensors in SDF, in gz-sim's form for custom sensors:
///
///     <sensor name="gate" type="custom" gz:type="rfid_antenna">
///       <update_rate>15</update_rate>
///       <gz:rfid_antenna><range>5</range></gz:rfid_antenna>
///     </sensor>
///
/// The prefix may also be `ignition:`, as in Fortress' own examples.
#pragma once

#include <sdf/Sensor.hh>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"

namespace tagfield {

inline constexpr const char* kAntennaType = "rfid_antenna";
inline constexpr const char* kTagType = "rfid_tag";
inline constexpr const char* kTagSetType = "rfid_tag_set";

/// Type of a custom sensor; "" if not stated.
std::string type_of(const sdf::Sensor& sensor);

/// The sensor's element `<gz:TYPE>`; an empty one if missing.
sdf::ElementPtr described_in(const sdf::ElementPtr& sensor, const std::string& type);

/// The parameters in `<gz:TYPE>`, and the sensor's own update rate if it has one.
std::vector<RawParameter> parameters_of(const sdf::ElementPtr& sensor, const std::string& type);

/// Warns of SDF sensor elements that are valid but have no effect here.
void warn_of_silent(const sdf::ElementPtr& sensor, Diagnostics& diagnostics);

}  // namespace tagfield
