// SPDX-License-Identifier: Apache-2.0
// One antenna-tag link in the paper's model: the reader's report for a tag 3 m away.
//
//   build/release/bin/example_one_link
#include <cstdio>

#include "tagfield/channel/paper_model.h"
#include "tagfield/reader/antenna.h"

int main() {  // NOLINT(bugprone-exception-escape): an antenna of the paper's model is read
  tagfield::PaperAntenna model;  // 865.7 MHz, 0.1 rad of phase noise, 7 m of range
  model.model.communication_gain = 3.0;
  const tagfield::AntennaParameters antenna{"reader", "antenna", 15.0, model};
  const auto link = tagfield::link_between({0.0, 0.0, 1.5}, {3.0, 0.0, 1.5});
  const auto read = tagfield::read_tag(antenna, "tag1", link, tagfield::Time{}, /*seed=*/1);
  std::printf("%s at %.2f m: phase %.3f rad, RSSI %.0f dBm\n", read.tag.c_str(), link.distance_m,
              read.phase_rad, read.rssi_dbm);
}
