// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/drive_watch.h"

#include <algorithm>

namespace tagfield {

void DriveWatch::begin(double remaining_m, Time now) {
  min_m_ = remaining_m;
  counted_from_m_ = remaining_m;
  detours_ = 0;
  nearer_ = now;
  tried_ = now;
}

void DriveWatch::detour(double remaining_m, Time now) {
  const bool is_longer = remaining_m > min_m_ + kNearer;
  min_m_ = remaining_m;
  counted_from_m_ = std::max(counted_from_m_, remaining_m);
  tried_ = now;
  if (!is_longer || detours_ >= kMaxDetours) return;
  ++detours_;
  nearer_ = now;
}

void DriveWatch::update(double remaining_m, Time now) {
  if (remaining_m > min_m_ - kNearer) return;
  min_m_ = remaining_m;
  nearer_ = now;
  if (remaining_m > counted_from_m_ - kCounts) return;
  counted_from_m_ = remaining_m;
  detours_ = 0;
}

}  // namespace tagfield
