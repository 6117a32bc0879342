// SPDX-License-Identifier: Apache-2.0
/// @file
/// RFID sensors in SDF as gz-sim has sensors that it does not know itself:
///
///     <sensor name="gate" type="custom" gz:type="rfid_antenna">
///       <update_rate>15</update_rate>
///       <gz:rfid_antenna><range>5</range></gz:rfid_antenna>
///     </sensor>
///
/// The prefix may also be `ignition:`, as Fortress' own examples have it.
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

/// What kind of custom sensor it is; "" where it does not say.
std::string type_of(const sdf::Sensor& sensor);

/// The element `<gz:TYPE>` in the sensor's; an empty one where there is none.
sdf::ElementPtr described_in(const sdf::ElementPtr& sensor, const std::string& type);

/// The parameters in `<gz:TYPE>`, and the sensor's own update rate where it has one.
std::vector<RawParameter> parameters_of(const sdf::ElementPtr& sensor, const std::string& type);

/// Warns of what SDF lets a sensor say and has no effect here.
void warn_of_silent(const sdf::ElementPtr& sensor, Diagnostics& diagnostics);

}  // namespace tagfield
