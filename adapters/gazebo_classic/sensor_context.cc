#include "adapters/gazebo_classic/sensor_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

#include "adapters/gazebo_classic/plugin_elements.h"
#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// Names of the tags on a link.
std::vector<std::string> tags_on(const sdf::ElementPtr& link) {
  std::vector<std::string> names;
  if (!link->HasElement("sensor")) return names;
  for (sdf::ElementPtr sensor = link->GetElement("sensor"); sensor;
       sensor = sensor->GetNextElement("sensor")) {
    if (sensor->Get<std::string>("type") == "rfidtag") {
      names.push_back(sensor->Get<std::string>("name"));
    }
  }
  return names;
}

/// Names of the tags on all links of a model, models inside it excepted.
std::vector<std::string> tags_on_links_of(const gazebo::physics::Model& model) {
  std::vector<std::string> names;
  for (const gazebo::physics::LinkPtr& link : model.GetLinks()) {
    const std::vector<std::string> more = tags_on(link->GetSDF());
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

}  // namespace

std::string place_of(const gazebo::sensors::Sensor& sensor) {
  const std::string parent = sensor.ParentName();
  const std::size_t end_of_model = parent.rfind("::");
  const std::string model = parent.substr(0, end_of_model);
  const std::string link = end_of_model == std::string::npos ? "" : parent.substr(end_of_model + 2);
  return fmt::format("model '{}', link '{}', sensor '{}'", model, link, sensor.Name());
}

gazebo::physics::LinkPtr link_of(const gazebo::sensors::Sensor& sensor) {
  const gazebo::physics::WorldPtr world = gazebo::physics::get_world(sensor.WorldName());
  const auto link =
      boost::dynamic_pointer_cast<gazebo::physics::Link>(world->EntityByName(sensor.ParentName()));
  if (!link) throw Error(fmt::format("'{}' is no link to be on", sensor.ParentName()));
  return link;
}

std::vector<RawParameter> parameters_of(const gazebo::sensors::Sensor& sensor,
                                        const sdf::ElementPtr& plugin) {
  std::vector<RawParameter> parameters = parameters_in(plugin);
  // Gazebo's own default of 0 means as often as it can, which no reader does.
  if (sensor.UpdateRate() != 0.0) {
    parameters.push_back({"update_rate", fmt::format("{}", sensor.UpdateRate()), {}});
  }
  return parameters;
}

std::string tag_id_of(const gazebo::sensors::Sensor& sensor, gazebo::physics::Link& link) {
  const gazebo::physics::ModelPtr model = link.GetModel();
  const std::string model_name = model->GetScopedName();
  const std::vector<std::string> tags = tags_on_links_of(*model);
  if (tags.size() == 1) return model_name;
  if (std::count(tags.begin(), tags.end(), sensor.Name()) == 1) {
    return fmt::format("{}::{}", model_name, sensor.Name());
  }
  return fmt::format("{}::{}::{}", model_name, link.GetName(), sensor.Name());
}

std::string published_name_of(const gazebo::sensors::Sensor& sensor, gazebo::physics::Link& link) {
  if (tags_on(link.GetSDF()).size() <= 1) return sensor.ParentName();
  return fmt::format("{}::{}", sensor.ParentName(), sensor.Name());
}

}  // namespace tagfield
