// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/place_watch.h"

namespace tagfield {

void PlaceWatch::look(const PlaceGlance& glance) {
  if (!put_ && !is_open_ && knew_place_ && !glance.knows_position) put_ = PositionLoss::kLost;
  if (put_) {
    findings_.push_back({*put_, false, std::nullopt, 0.0, 0});
    begin_ = glance;
    is_open_ = true;
    right_.reset();
    put_.reset();
  }
  const bool knew_place = knew_place_;
  knew_place_ = glance.knows_position;
  if (!is_open_) return;
  Finding& finding = findings_.back();
  const bool is_right = glance.off_m < kRight_m && glance.off_rad < kRight_rad;
  if (!glance.knows_position) finding.noticed = true;
  if (glance.knows_position && !knew_place && !is_right) ++finding.wrong;
  if (!glance.knows_position || !is_right) {
    right_.reset();
    return;
  }
  if (!right_) right_ = glance;
  if (to_seconds(glance.now - right_->now) < kHolds_s) return;
  finding.seconds = to_seconds(right_->now - begin_.now);
  finding.driven_m = right_->driven_m - begin_.driven_m;
  is_open_ = false;
}

}  // namespace tagfield
