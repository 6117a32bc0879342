// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a Gazebo world is made of, from SDF.
#pragma once

#include <sdf/sdf.hh>

#include "tagfield/channel/radio_world.h"

namespace tagfield {

/// Reads the elements of a plugin: `made_of` (attribute `name`, text a material) any number,
/// `default_material` (concrete), `least_facet_m2` [m²] (0.1), `material` (attribute `name`, with
/// `permittivity` 1, `permittivity_exponent` 0, `conductivity_s_m` 0, `conductivity_exponent` 0,
/// `wall_m` [m], `crossing_db` [dB], `opaque` false) any number. Throws Error that names the
/// element which is wrong. Unknown elements are warned of.
RadioWorldOptions materials_in(const sdf::ElementPtr& plugin, Diagnostics& diagnostics);

}  // namespace tagfield
