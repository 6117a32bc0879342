// SPDX-License-Identifier: Apache-2.0
// Where all solids of a world are, for comparison with Gazebo's:
//
//   world_poses WORLD [MODEL_PATH…]
//
// prints a line a solid, NAME<tab>x y z qx qy qz qw, and the warnings on standard error.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/sdf/load_world.h"

namespace {

void print_solids(const std::string& path, const std::vector<std::string>& search_paths) {
  tagfield::Diagnostics diagnostics;
  const tagfield::Scene scene = tagfield::load_world(path, search_paths, diagnostics,
                                                     {.skip_missing = true, .allow_outside = true});
  for (const std::string& warning : diagnostics.warnings()) fmt::print(stderr, "{}\n", warning);
  for (const tagfield::Collision& solid : scene.collisions) {
    const Eigen::Vector3d& p = solid.X_WC.translation;
    const Eigen::Vector4d q = solid.X_WC.rotation.coeffs();  // x, y, z, w
    fmt::print("{}\t{} {} {} {} {} {} {}\n", solid.name, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(),
               q.w());
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return 2;
  try {
    print_solids(arguments[1], {arguments + 2, arguments + count});
    return 0;
  } catch (const tagfield::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
