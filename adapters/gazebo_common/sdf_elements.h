// SPDX-License-Identifier: Apache-2.0
/// @file
/// A plugin's or a sensor's parameters from SDF.
#pragma once

#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"

namespace tagfield {

/// The children of `parent` (which may be null) named `name`.
std::vector<sdf::ElementPtr> children(const sdf::ElementPtr& parent, const std::string& name);

/// The elements in `parent`; nested ones (`<path><waypoint>`) are parameters of their own.
std::vector<RawParameter> parameters_in(const sdf::ElementPtr& parent);

}  // namespace tagfield
