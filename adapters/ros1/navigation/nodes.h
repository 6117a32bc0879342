// SPDX-License-Identifier: Apache-2.0
/// @file
/// The nodes' programs. docs/ros_navigation.md describes their topics and parameters.
#pragma once

namespace tagfield {

/// Takes the role of gmapping.
int run_mapping(int argc, char** argv);
/// Takes the role of amcl.
int run_localization(int argc, char** argv);
/// Takes the role of move_base.
int run_driving(int argc, char** argv);
/// Sends a robot to areas that are not on its map yet.
int run_exploring(int argc, char** argv);

}  // namespace tagfield
