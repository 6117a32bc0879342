// SPDX-License-Identifier: Apache-2.0
/// @file
/// The materials of a Gazebo world, from SDF.
#pragma once

#include <sdf/sdf.hh>

#include "tagfield/channel/radio_world.h"

namespace tagfield {

/// Reads the elements of a plugin: any number of `made_of` (attribute `name`; its text is a
/// material), `default_material` (concrete), `min_facet_m2` [m²] (0.1), and any number of
/// `material` (attribute `name`, with `permittivity` 1, `permittivity_exponent` 0,
/// `conductivity_s_m` 0, `conductivity_exponent` 0, `wall_m` [m], `crossing_db` [dB], `opaque`
/// false). Throws Error naming the invalid element. Warns of unknown elements.
RadioWorldOptions materials_in(const sdf::ElementPtr& plugin, Diagnostics& diagnostics);

}  // namespace tagfield
