// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/plugins/tag_set_plugin.h"

#include <fmt/format.h>

#include <gazebo/common/SystemPaths.hh>
#include <gazebo/physics/physics.hh>

#include "adapters/gazebo_classic/plugin_elements.h"
#include "adapters/gazebo_classic/plugins/shared_world.h"
#include "tagfield/base/error.h"

namespace gazebo {
namespace {

using tagfield::Error;
using tagfield::TagOnLink;

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
  tagfield::Diagnostics diagnostics;
  const auto find = [](const std::string& uri) {
    return common::SystemPaths::Instance()->FindFileURI(uri);
  };
  const std::vector<TagOnLink> tags = tagfield::tag_set_in(plugin, {"link"}, find, diagnostics);
  for (const std::string& warning : diagnostics.warnings()) {
    gzwarn << tagfield::place_of(*model, plugin) << ": " << warning << "\n";
  }
  const physics::LinkPtr link = link_in(*model, plugin);
  const auto world = tagfield::shared_rfid_world(model->GetWorld());
  handle_ = world->add_tags({tagfield::place_of(*model, plugin), link->GetScopedName(),
                             [tags](physics::Link&) { return tags; }});
  world_ = world;
}

GZ_REGISTER_MODEL_PLUGIN(RfidTagSetPlugin)

}  // namespace gazebo
