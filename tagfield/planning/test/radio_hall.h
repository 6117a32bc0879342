// SPDX-License-Identifier: Apache-2.0
/// @file
/// Small physical scenarios whose links have closed-form solutions.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "tagfield/base/units.h"
#include "tagfield/channel/radio_world.h"
#include "tagfield/reader/channel_plan.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield {

inline constexpr double kTestCarrier_hz = 865.7e6;

/// Power gain between two isotropic antennas in free space, H. T. Friis, A Note on a Simple
/// Transmission Formula, Proc. IRE 34, 1946 [dB].
inline double friis_db(double distance_m) {
  return 20.0 * std::log10(kSpeedOfLight / kTestCarrier_hz / (4.0 * kPi * distance_m));
}

/// An isotropic antenna, 30 dBm, link budget only, without polarization.
inline RadioModel isotropic_model() {
  RadioModel model;
  model.plan = fixed_plan(kTestCarrier_hz);
  model.effects.polarization = false;
  model.effects.reflections = false;
  return model;
}

inline AntennaSpec physical_antenna(const std::string& name, const Eigen::Vector3d& p_WA,
                                    const RadioModel& model) {
  AntennaSpec antenna;
  antenna.parameters.name = name;
  antenna.parameters.reader = name;
  antenna.parameters.model = std::make_shared<const RadioModel>(model);
  antenna.X_PA = from_translation(p_WA);
  return antenna;
}

/// Isotropic, −18 dBm.
inline std::shared_ptr<const TagModel> isotropic_tag() {
  TagModel tag;
  tag.name = "isotropic";
  return std::make_shared<const TagModel>(tag);
}

inline TagSpec physical_tag(const std::string& id, const Eigen::Vector3d& p_WT) {
  TagSpec tag;
  tag.id = id;
  tag.model = isotropic_tag();
  tag.motion = {{Time{}, from_translation(p_WT)}};
  return tag;
}

inline Scenario hall_with(const AntennaSpec& antenna, const TagSpec& tag) {
  Scenario scenario;
  scenario.name = "hall";
  scenario.duration_s = 2.0;
  scenario.antennas = {antenna};
  scenario.tags = {tag};
  return scenario;
}

/// Adds a box of a material to the scenario's world.
inline void add_box(Scenario& scenario, const std::string& material, const Eigen::Vector3d& middle,
                    const Eigen::Vector3d& size) {
  Scene scene;
  scene.collisions = {{"crate::link::collision", Box{size}, from_translation(middle)}};
  RadioWorldOptions options;
  options.rules = {{"crate", find_material(known_materials(), material), {}}};
  Diagnostics unheard;
  scenario.radio_world = std::make_shared<const RadioWorld>(radio_world(scene, options, unheard));
}

}  // namespace tagfield
