// SPDX-License-Identifier: Apache-2.0
/// @file
/// A small world for tests of autonomous robots.
#pragma once

#include "tagfield/navigation/monte_carlo_localizer.h"
#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// An upright box given by centre and size [m]; `low` and `high` are the heights of its bottom and
/// top.
inline Collision box_at(double x, double y, double size_x, double size_y, double low = 0.0,
                        double high = 2.0) {
  return {"box", Box{{size_x, size_y, high - low}}, from_translation({x, y, 0.5 * (low + high)})};
}

/// A room of 6 m by 4 m centred on the origin, with boxes that make its corners distinguishable.
inline Scene small_room() {
  Scene scene;
  scene.collisions = {box_at(0.0, 2.1, 6.4, 0.2), box_at(0.0, -2.1, 6.4, 0.2),
                      box_at(3.1, 0.0, 0.2, 4.4), box_at(-3.1, 0.0, 0.2, 4.4),
                      box_at(2.6, 1.7, 0.8, 0.6), box_at(-2.7, -1.75, 0.6, 0.5),
                      box_at(-2.8, 1.4, 0.4, 1.2)};
  return scene;
}

/// A robot that navigates by laser in small_room(), with a tag and an antenna that cost next to no
/// time.
inline Scenario small_drive() {
  Scenario scenario;
  scenario.name = "small_drive";
  scenario.world.path = "small_room";
  scenario.time_step_s = 0.02;
  scenario.pose.source = PoseSource::kSlam;
  NavigationSpec& navigation = own_navigation(scenario);
  navigation.laser.beams = 181;
  navigation.laser.rate_hz = 15.0;
  // Few particles and updates suffice in a room this small.
  LocalizerSettings& localizer = navigation.localizer;
  localizer.first_particles = 3000;
  localizer.min_searching = 1000;
  localizer.update_turn_rad = 0.5;
  localizer.update_distance_m = 0.15;
  localizer.point_spacing_m = 0.15;
  RobotSpec robot;
  robot.name = "robot";
  robot.waypoints = {{1.5, 0.0}};
  scenario.robots = {robot};
  AntennaSpec antenna;
  antenna.parameters.name = "antenna";
  antenna.parameters.rate_hz = 1.0;
  scenario.antennas = {antenna};
  TagSpec tag;
  tag.id = "tag";
  tag.motion = {{Time{}, from_translation({0.0, 0.0, 1.0})}};
  scenario.tags = {tag};
  return scenario;
}

}  // namespace tagfield
