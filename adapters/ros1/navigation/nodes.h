// SPDX-License-Identifier: Apache-2.0
/// @file
/// The nodes' programs. docs/ros_navigation.md has their topics and parameters.
#pragma once

namespace tagfield {

/// Stands where gmapping stands.
int run_mapping(int argc, char** argv);
/// Stands where amcl stands.
int run_localization(int argc, char** argv);
/// Stands where move_base stands.
int run_driving(int argc, char** argv);
/// Sends a robot to whatever is not on its map yet.
int run_exploring(int argc, char** argv);

}  // namespace tagfield
