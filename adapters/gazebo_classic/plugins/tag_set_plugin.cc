#include "adapters/gazebo_classic/plugins/tag_set_plugin.h"

#include <fmt/format.h>

#include <gazebo/common/SystemPaths.hh>
#include <gazebo/physics/physics.hh>

#include "adapters/gazebo_classic/plugin_elements.h"
#include "adapters/gazebo_classic/plugins/shared_world.h"
#include "tagfield/base/error.h"
#include "tagfield/reader/sensor_parameters.h"
#include "tagfield/stream/csv.h"

namespace gazebo {
namespace {

using tagfield::Error;
using tagfield::TagOnLink;

TagOnLink tag_in_row(const sdf::ElementPtr& row, std::size_t number) {
  const std::string epc = row->HasAttribute("epc") ? row->Get<std::string>("epc") : "";
  if (epc.empty()) throw Error(fmt::format("<tag> {} has no epc=\"…\"", number));
  const std::string key = fmt::format("tag epc=\"{}\"", epc);
  const sdf::ParamPtr value = row->GetValue();
  const std::vector<double> xyz =
      tagfield::numbers_of({key, value ? value->GetAsString() : "", {}});
  if (xyz.size() != 3) {
    throw Error(fmt::format("<{}> has {} numbers, expected x y z", key, xyz.size()));
  }
  return {epc, epc, {xyz[0], xyz[1], xyz[2]}};
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
    tags.push_back({id, id, table.position(row, place)});
  }
  return tags;
}

/// The tables named in the plugin; warns of what it does not know there.
std::vector<std::string> tables_in(physics::Model& model, const sdf::ElementPtr& plugin) {
  std::vector<std::string> tables;
  for (sdf::ElementPtr child = plugin->GetFirstElement(); child; child = child->GetNextElement()) {
    const std::string name = child->GetName();
    if (name == "table") {
      tables.push_back(child->Get<std::string>());
    } else if (name != "tag" && name != "link") {
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
  if (tags.empty()) gzwarn << tagfield::place_of(*model, plugin) << ": has no tags\n";
  const physics::LinkPtr link = link_in(*model, plugin);
  const auto world = tagfield::shared_rfid_world(model->GetWorld());
  handle_ = world->add_tags({tagfield::place_of(*model, plugin), link->GetScopedName(),
                             [tags](physics::Link&) { return tags; }});
  world_ = world;
}

GZ_REGISTER_MODEL_PLUGIN(RfidTagSetPlugin)

}  // namespace gazebo
