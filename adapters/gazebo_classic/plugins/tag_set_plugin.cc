#include "adapters/gazebo_classic/plugins/tag_set_plugin.h"

#include <fmt/format.h>

#include <algorithm>
#include <gazebo/common/SystemPaths.hh>
#include <gazebo/physics/physics.hh>

#include "adapters/gazebo_classic/plugin_elements.h"
#include "adapters/gazebo_classic/plugins/shared_world.h"
#include "tagfield/base/error.h"
#include "tagfield/files/csv.h"
#include "tagfield/settings/sensor_parameters.h"
#include "tagfield/settings/sensor_radio.h"

namespace gazebo {
namespace {

using tagfield::Error;
using tagfield::from_xyz_rpy;
using tagfield::TagOnLink;

TagOnLink tag_in_row(const sdf::ElementPtr& row, std::size_t number) {
  const std::string epc = row->HasAttribute("epc") ? row->Get<std::string>("epc") : "";
  if (epc.empty()) throw Error(fmt::format("<tag> {} has no epc=\"…\"", number));
  const std::string key = fmt::format("tag epc=\"{}\"", epc);
  const sdf::ParamPtr value = row->GetValue();
  const std::vector<double> n = tagfield::numbers_of({key, value ? value->GetAsString() : "", {}});
  if (n.size() != 3 && n.size() != 6) {
    throw Error(
        fmt::format("<{}> has {} numbers, expected x y z, or x y z roll pitch yaw", key, n.size()));
  }
  const Eigen::Vector3d rpy =
      n.size() == 6 ? Eigen::Vector3d(n[3], n[4], n[5]) : Eigen::Vector3d::Zero();
  return {epc, epc, from_xyz_rpy({n[0], n[1], n[2]}, rpy), nullptr};
}

std::vector<TagOnLink> tags_in_rows(const sdf::ElementPtr& plugin) {
  std::vector<TagOnLink> tags;
  if (!plugin->HasElement("tag")) return tags;
  for (sdf::ElementPtr row = plugin->GetElement("tag"); row; row = row->GetNextElement("tag")) {
    tags.push_back(tag_in_row(row, tags.size() + 1));
  }
  return tags;
}

std::vector<TagOnLink> tags_in_table(const std::string& uri) {
  const std::string file = common::SystemPaths::Instance()->FindFileURI(uri);
  if (file.empty()) throw Error(fmt::format("<table> '{}' is not found", uri));
  const tagfield::CsvTable table = tagfield::read_csv(file);
  const std::size_t epc = table.column("epc");
  const auto place = table.position_columns();
  std::vector<TagOnLink> tags;
  for (const tagfield::CsvRow& row : table.rows) {
    const std::string& id = table.text(row, epc);
    tags.push_back({id, id, tagfield::from_translation(table.position(row, place)), nullptr});
  }
  return tags;
}

/// Whether the plugin has more to say about an element than that it is not known.
bool is_known(const std::string& element) {
  const std::vector<std::string> settings = tagfield::tag_setting_keys();
  return element == "tag" || element == "link" ||
         std::find(settings.begin(), settings.end(), element) != settings.end();
}

/// The tables named in the plugin; warns of what it does not know there.
std::vector<std::string> tables_in(physics::Model& model, const sdf::ElementPtr& plugin) {
  std::vector<std::string> tables;
  for (sdf::ElementPtr child = plugin->GetFirstElement(); child; child = child->GetNextElement()) {
    const std::string name = child->GetName();
    if (name == "table") {
      tables.push_back(child->Get<std::string>());
    } else if (!is_known(name)) {
      gzwarn << tagfield::place_of(model, plugin) << ": <" << name
             << "> is not known and left out\n";
    }
  }
  return tables;
}

physics::LinkPtr link_in(const physics::Model& model, const sdf::ElementPtr& plugin) {
  if (!plugin->HasElement("link")) {
    const physics::LinkPtr link = model.GetLink();
    if (!link) throw Error("the model has no link for tags to be on");
    return link;
  }
  const auto name = plugin->Get<std::string>("link");
  const physics::LinkPtr link = model.GetLink(name);
  if (!link) throw Error(fmt::format("<link> is '{}', expected a link of the model", name));
  return link;
}

}  // namespace

RfidTagSetPlugin::~RfidTagSetPlugin() {
  if (world_) world_->remove_tags(handle_);
}

void RfidTagSetPlugin::Load(physics::ModelPtr model, sdf::ElementPtr plugin) {
  try {
    load(model, plugin);
  } catch (const std::exception& error) {
    gzerr << tagfield::place_of(*model, plugin) << ": " << error.what() << "; left out\n";
  }
}

void RfidTagSetPlugin::load(const physics::ModelPtr& model, const sdf::ElementPtr& plugin) {
  std::vector<TagOnLink> tags = tags_in_rows(plugin);
  for (const std::string& table : tables_in(*model, plugin)) {
    const std::vector<TagOnLink> more = tags_in_table(table);
    tags.insert(tags.end(), more.begin(), more.end());
  }
  tagfield::Diagnostics diagnostics;
  const auto kind = tagfield::sensor_tag_model(tagfield::parameters_in(plugin), {}, diagnostics);
  for (TagOnLink& tag : tags) tag.model = kind;
  for (const std::string& warning : diagnostics.warnings()) {
    gzwarn << tagfield::place_of(*model, plugin) << ": " << warning << "\n";
  }
  if (tags.empty()) gzwarn << tagfield::place_of(*model, plugin) << ": has no tags\n";
  const physics::LinkPtr link = link_in(*model, plugin);
  const auto world = tagfield::shared_rfid_world(model->GetWorld());
  handle_ = world->add_tags({tagfield::place_of(*model, plugin), link->GetScopedName(),
                             [tags](physics::Link&) { return tags; }});
  world_ = world;
}

GZ_REGISTER_MODEL_PLUGIN(RfidTagSetPlugin)

}  // namespace gazebo
