// SPDX-License-Identifier: Apache-2.0
// libtagfield-gz.so, tagfield::systems::Rfid: tags and antennas of a gz-sim world. In <world>:
//
//     <plugin filename="tagfield-gz" name="tagfield::systems::Rfid">
//       <made_of name="rack*">metal</made_of>    <!-- and more: docs/gz.md, "Physical models" -->
//       <ros2>true</ros2>                        <!-- publish to ROS 2; true if built in -->
//       <domain>0</domain>                       <!-- of ROS 2; ROS_DOMAIN_ID, else 0 -->
//       <clock>false</clock>                     <!-- publish /clock too; false -->
//       <mcap>run.mcap</mcap>                    <!-- record the same; none -->
//     </plugin>
#define TAGFIELD_FIRST_SYSTEM
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <sdf/Element.hh>

#include "adapters/gazebo_common/sdf_elements.h"
#include "adapters/gazebo_common/window_markers.h"
#include "adapters/gazebo_common/world_materials.h"
#include "adapters/gz/gz_field.h"
#include "adapters/gz/transport_publisher.h"
#include "adapters/ros2/dds_sink.h"
#include "adapters/ros2/domain.h"
#include "adapters/ros2/mcap_file.h"
#include "adapters/ros2/ros2_outlet.h"
#include "tagfield/base/error.h"

namespace tagfield::systems {
namespace {

constexpr const char* kPlace = "Tagfield";
constexpr const char* kNodeName = "tagfield_gz";

/// The plugin's own elements; the others are materials.
struct Settings {
  bool ros2 = ros2::kHasDds;
  std::optional<std::uint32_t> domain;
  bool clock = false;
  std::string mcap;
};

bool truth_in(const RawParameter& parameter) {
  if (parameter.value == "true" || parameter.value == "1") return true;
  if (parameter.value == "false" || parameter.value == "0") return false;
  throw Error(fmt::format("<{}> is '{}', expected true or false", parameter.key, parameter.value));
}

constexpr std::array<const char*, 4> kOwn = {"ros2", "domain", "clock", "mcap"};

/// Removes the plugin's own elements and returns them, so that materials are left.
std::vector<RawParameter> take_own(const sdf::ElementPtr& plugin) {
  std::vector<RawParameter> own;
  for (const char* const key : kOwn) {
    for (const sdf::ElementPtr& element : children(plugin, key)) {
      const sdf::ParamPtr value = element->GetValue();
      own.push_back({key, value ? value->GetAsString() : "", {}});
      element->RemoveFromParent();
    }
  }
  return own;
}

Settings settings_in(const std::vector<RawParameter>& own) {
  Settings settings;
  for (const RawParameter& parameter : own) {
    if (parameter.key == "ros2") settings.ros2 = truth_in(parameter);
    if (parameter.key == "domain") settings.domain = ros2::domain_in(parameter.value, "<domain>");
    if (parameter.key == "clock") settings.clock = truth_in(parameter);
    if (parameter.key == "mcap") settings.mcap = parameter.value;
  }
  if (!settings.ros2 && (settings.domain || settings.clock)) {
    report_warning(fmt::format("{}: <domain> and <clock> have no effect without <ros2>", kPlace));
  }
  return settings;
}

/// Runs one part of the set-up; if it fails, that part is left out and the server continues.
template <class Task>
void attempt(const char* consequence, const Task& task) {
  try {
    task();
  } catch (const std::exception& error) {
    tell_error(fmt::format("{}: {}; {}", kPlace, error.what(), consequence));
  }
}

}  // namespace

/// One per world.
class Rfid final : public gz_sim::System,
                   public gz_sim::ISystemConfigure,
                   public gz_sim::ISystemPostUpdate,
                   public ISystemReset {
 public:
  Rfid() = default;
  Rfid(const Rfid&) = delete;
  Rfid& operator=(const Rfid&) = delete;
  ~Rfid() override {
    if (!field_) return;
    report_cost(field_->finish());
    field_.reset();
    for (const auto& sink : sinks_) attempt("", [&] { sink->finish(); });
  }

  void Configure(const gz_sim::Entity& /*world*/, const std::shared_ptr<const sdf::Element>& sdf,
                 gz_sim::EntityComponentManager& /*ecm*/,
                 gz_sim::EventManager& /*events*/) override {
    const sdf::ElementPtr plugin = sdf->Clone();
    const std::vector<RawParameter> own = take_own(plugin);
    Settings settings{false, {}, false, ""};  // If invalid, none is used.
    attempt("ROS 2 and MCAP stay off", [&] { settings = settings_in(own); });
    RadioWorldOptions materials;
    attempt("left out", [&] { materials = materials_of(plugin); });
    Outlets outlets;
    attach(std::make_shared<TransportPublisher>(), outlets);
    attach(std::make_shared<WindowMarkers>(), outlets);
    attempt("ROS 2 stays off", [&] { attach_ros2(settings, outlets); });
    attempt("nothing is recorded", [&] { attach_mcap(settings, outlets); });
    field_ = std::make_unique<GzField>(std::move(outlets), std::move(materials));
  }

  void PostUpdate(const gz_sim::UpdateInfo& info,
                  const gz_sim::EntityComponentManager& ecm) override {
    field_->after_step(Time(info.simTime), info.paused, ecm);
  }

  void Reset(const gz_sim::UpdateInfo& /*info*/, gz_sim::EntityComponentManager& /*ecm*/) override {
    field_->forget_sensors();
  }

 private:
  static RadioWorldOptions materials_of(const sdf::ElementPtr& plugin) {
    Diagnostics diagnostics;
    RadioWorldOptions materials = materials_in(plugin, diagnostics);
    for (const std::string& warning : diagnostics.warnings()) {
      report_warning(fmt::format("{}: {}", kPlace, warning));
    }
    return materials;
  }

  void attach_ros2(const Settings& settings, Outlets& outlets) {
    if (!settings.ros2) return;
    const std::uint32_t domain = settings.domain ? *settings.domain : ros2::domain_of_environment();
    attach_sink(std::make_shared<ros2::DdsSink>(domain, kNodeName), settings.clock, outlets);
  }

  void attach_mcap(const Settings& settings, Outlets& outlets) {
    if (!settings.mcap.empty()) attach_sink(ros2::mcap_file(settings.mcap), true, outlets);
  }

  void attach_sink(const std::shared_ptr<ros2::MessageSink>& sink, bool clock, Outlets& outlets) {
    sinks_.push_back(sink);
    attach(std::make_shared<ros2::Ros2Outlet>(sink, clock), outlets);
    attach(std::make_shared<ros2::Ros2Markers>(sink), outlets);
  }

  /// For benchmarks: reports the cost of an update.
  static void report_cost(const GzField::Cost& cost) {
    if (std::getenv("TAGFIELD_REPORT_COST") == nullptr) return;
    const double updates = static_cast<double>(std::max<std::int64_t>(cost.updates, 1));
    std::cout << fmt::format(
        "{{\"updates\": {}, \"physics_ms\": {:.4f}, \"reads_ms\": {:.4f}, \"reads\": {}}}\n",
        cost.updates, 1e3 * cost.step_s / updates, 1e3 * cost.work.busy_s / updates,
        cost.work.reads);
  }

  std::vector<std::shared_ptr<ros2::MessageSink>> sinks_;
  std::unique_ptr<GzField> field_;
};

}  // namespace tagfield::systems

TAGFIELD_ADD_SYSTEM(tagfield::systems::Rfid, tagfield::systems::Rfid::ISystemConfigure,
                    tagfield::systems::Rfid::ISystemPostUpdate,
                    tagfield::systems::Rfid::ISystemReset)
