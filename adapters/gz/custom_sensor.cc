// SPDX-License-Identifier: Apache-2.0
#include "adapters/gz/custom_sensor.h"

#include <fmt/format.h>

#include "adapters/gazebo_common/sdf_elements.h"

namespace tagfield {
namespace {

constexpr const char* kPrefixes[] = {"gz:", "ignition:"};

}  // namespace

std::string type_of(const sdf::Sensor& sensor) {
  const sdf::ElementPtr element = sensor.Element();
  if (!element) return "";
  for (const std::string prefix : kPrefixes) {
    const sdf::ParamPtr type = element->GetAttribute(prefix + "type");
    if (type) return type->GetAsString();
  }
  return "";
}

sdf::ElementPtr described_in(const sdf::ElementPtr& sensor, const std::string& type) {
  for (const std::string prefix : kPrefixes) {
    const std::string name = prefix + type;
    if (sensor->HasElement(name)) return sensor->GetElement(name);
  }
  return std::make_shared<sdf::Element>();
}

std::vector<RawParameter> parameters_of(const sdf::ElementPtr& sensor, const std::string& type) {
  std::vector<RawParameter> parameters = parameters_in(described_in(sensor, type));
  // SDF's own default of 0 means as often as possible, which no reader does.
  for (const sdf::ElementPtr& rate : children(sensor, "update_rate")) {
    if (rate->Get<double>() != 0.0) {
      parameters.push_back({"update_rate", rate->GetValue()->GetAsString(), {}});
    }
  }
  return parameters;
}

void warn_of_silent(const sdf::ElementPtr& sensor, Diagnostics& diagnostics) {
  for (const char* const name : {"topic", "enable_metrics"}) {
    if (children(sensor, name).empty()) continue;
    diagnostics.warn(fmt::format("<{}> has no effect: reads are on /rfid/reads", name));
  }
}

}  // namespace tagfield
