// SPDX-License-Identifier: Apache-2.0
// Reads of one tag from a straight path past it, φ = 4πr/λ, are located: with the installed
// libraries of localization alone.
#include <cmath>
#include <cstdio>

#include "tagfield/localization/locate.h"

int main() {
  constexpr double kPi = 3.14159265358979323846;
  constexpr double kFrequency = 866e6;
  const Eigen::Vector3d tag(1.5, 2.0, 1.0);
  std::vector<tagfield::TagRead> reads;
  std::vector<tagfield::AntennaPose> poses;
  for (int i = 0; i <= 300; ++i) {
    const tagfield::Time stamp = tagfield::time_from_seconds(0.05 * i);
    const Eigen::Vector3d antenna(0.01 * i, i < 150 ? 0.0 : 0.005 * (i - 150), 1.0);
    tagfield::TagRead read;
    read.stamp = stamp;
    read.antenna = "antenna";
    read.tag = "tag";
    read.frequency_hz = kFrequency;
    read.phase_rad =
        std::fmod(4.0 * kPi * kFrequency / 299792458.0 * (antenna - tag).norm(), 2.0 * kPi);
    reads.push_back(read);
    poses.push_back({stamp, "antenna", tagfield::from_translation(antenna)});
  }
  tagfield::Diagnostics diagnostics;
  for (const auto& estimate : tagfield::locate_tags(reads, poses, {}, diagnostics).estimates) {
    for (const tagfield::Candidate& candidate : estimate.candidates) {
      std::printf("%s: %.3f %.3f m\n", estimate.tag.c_str(), candidate.p_WT.x(),
                  candidate.p_WT.y());
    }
  }
}
