// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/sensor_context.h"

#include <fmt/format.h>

#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

#include "adapters/gazebo_common/sdf_elements.h"
#include "adapters/gazebo_common/sensor_names.h"

namespace tagfield {
namespace {

/// Names of the tags on a link.
std::vector<std::string> tags_on(const sdf::ElementPtr& link) {
  std::vector<std::string> names;
  for (const sdf::ElementPtr& sensor : children(link, "sensor")) {
    if (sensor->Get<std::string>("type") == "rfidtag") {
      names.push_back(sensor->Get<std::string>("name"));
    }
  }
  return names;
}

/// Names of the tags on all links of a model, without nested models.
std::vector<std::string> tags_on_links_of(const gazebo::physics::Model& model) {
  std::vector<std::string> names;
  for (const gazebo::physics::LinkPtr& link : model.GetLinks()) {
    const std::vector<std::string> more = tags_on(link->GetSDF());
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

std::string link_name_of(const gazebo::sensors::Sensor& sensor) {
  const std::string parent = sensor.ParentName();
  const std::size_t end_of_model = parent.rfind("::");
  return end_of_model == std::string::npos ? "" : parent.substr(end_of_model + 2);
}

}  // namespace

std::string model_name_of(const gazebo::sensors::Sensor& sensor) {
  const std::string parent = sensor.ParentName();
  return parent.substr(0, parent.rfind("::"));
}

std::string place_of(const gazebo::sensors::Sensor& sensor) {
  return place_of({model_name_of(sensor), link_name_of(sensor), sensor.Name()});
}

std::vector<RawParameter> parameters_of(const sdf::ElementPtr& plugin) {
  std::vector<RawParameter> parameters = parameters_in(plugin);
  // Gazebo's own default of 0 means as often as possible, which no reader does. Passed on as text,
  // because Gazebo itself treats negative values as 0.
  for (const sdf::ElementPtr& rate : children(plugin->GetParent(), "update_rate")) {
    if (rate->Get<double>() != 0.0) {
      parameters.push_back({"update_rate", rate->GetValue()->GetAsString(), {}});
    }
  }
  return parameters;
}

std::string tag_id_of(const std::string& sensor, gazebo::physics::Link& link) {
  const gazebo::physics::ModelPtr model = link.GetModel();
  return tag_id_of({model->GetScopedName(), link.GetName(), sensor}, tags_on_links_of(*model));
}

std::string published_name_of(const std::string& sensor, gazebo::physics::Link& link) {
  if (tags_on(link.GetSDF()).size() <= 1) return link.GetScopedName();
  return fmt::format("{}::{}", link.GetScopedName(), sensor);
}

}  // namespace tagfield
