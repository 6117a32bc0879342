// SPDX-License-Identifier: Apache-2.0
/// @file
/// Sets of tags on one link, as described in SDF.
#pragma once

#include <functional>
#include <memory>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

struct TagModel;

/// A tag fixed to a link.
struct TagOnLink {
  std::string id;
  std::string label;
  RigidTransform X_LT;
  std::shared_ptr<const TagModel> model;  ///< Its kind, if given.
};

/// Finds a table's file by its URI; returns "" if there is none.
using FindFile = std::function<std::string(const std::string& uri)>;

/// The tags of a set: any number of `<tag epc="…">x y z [roll pitch yaw]</tag>` [m, rad], then
/// those of each `<table>`, the URI of a CSV file with the columns epc, x_m, y_m, z_m; all of the
/// kind that the set's other elements describe (radio_settings.h). Throws Error if any of them is
/// invalid. Warns of elements that are neither known nor in `others`, and of a set without tags.
std::vector<TagOnLink> tag_set_in(const sdf::ElementPtr& set,
                                  const std::vector<std::string>& others, const FindFile& find_file,
                                  Diagnostics& diagnostics);

}  // namespace tagfield
