// SPDX-License-Identifier: Apache-2.0
/// @file
/// A shelf under a ceiling, small enough to plan in a test.
#pragma once

#include <string>

namespace tagfield {

/// 24 tag positions with any orientation, 9 mounts facing down from 3 m.
inline std::string small_store(const std::string& more = "") {
  return "name: store\nmodel: link_budget\nduration_s: 2\n"
         "plan:\n"
         "  dwell_s: 2\n"
         "  tags:\n"
         "    - {name: shelf, zone: sales, box: [0, 0, 0.5, 5, 3, 1.5], spacing_m: [1, 1.5, 1],\n"
         "       orientations: any, count: 60}\n"
         "  mounts:\n"
         "    - name: ceiling\n"
         "      surface: [[0, 0, 3], [5, 0, 3], [0, 3, 3]]\n"
         "      spacing_m: 2.5\n"
         "      rpy_deg: [[0, 90, 0]]\n"
         "      cost: 100\n"
         "      powers_dbm: [20]\n"
         "      profiles: [speedway_r420, panel_6dbi]\n"
         "  limits: {antennas: 4, readers: 1, ports: 4}\n" +
         more;
}

}  // namespace tagfield
