// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_motion.h"

#include <limits>

namespace tagfield {
namespace {

/// The position of a tag that didn't exist.
Eigen::Vector3d nowhere() {
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

double share_at(Time time, Time before, Time now) {
  if (now <= before) return 1.0;
  return static_cast<double>((time - before).count()) / static_cast<double>((now - before).count());
}

void TagMotion::see(const TagPopulation& tags, Time now) {
  before_ = now_.value_or(now);
  now_ = now;
  places_before_.swap(places_);
  places_.clear();
  tags.for_each([&](std::uint32_t slot) {
    if (slot >= places_.size()) places_.resize(slot + std::size_t{1}, nowhere());
    places_[slot] = tags.position(slot);
  });
}

void TagMotion::forget(std::uint32_t slot) {
  for (auto* places : {&places_, &places_before_}) {
    if (slot < places->size()) (*places)[slot] = nowhere();
  }
}

RigidTransform TagMotion::pose(std::uint32_t slot, Time stamp, const TagPopulation& tags) const {
  RigidTransform X_WT = tags.pose(slot);
  if (slot >= places_before_.size() || !places_before_[slot].allFinite()) return X_WT;
  // Exactly, without rounding errors, so that images of tags at rest are kept.
  if (places_before_[slot] == X_WT.translation) return X_WT;
  const double share = share_at(stamp, before_, *now_);
  X_WT.translation = (1.0 - share) * places_before_[slot] + share * X_WT.translation;
  return X_WT;
}

Eigen::Vector3d TagMotion::velocity(std::uint32_t slot) const {
  const bool is_known = slot < places_before_.size() && places_before_[slot].allFinite();
  if (!is_known || *now_ <= before_) return Eigen::Vector3d::Zero();
  return (places_[slot] - places_before_[slot]) / to_seconds(*now_ - before_);
}

}  // namespace tagfield
