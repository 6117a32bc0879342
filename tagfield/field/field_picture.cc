// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/field_picture.h"

#include <algorithm>

namespace tagfield {
namespace {

constexpr Duration kLately = std::chrono::seconds(1);
constexpr double kMinAlpha = 0.25;

}  // namespace

ReadColor read_color(double share) {
  // NaN clamps to NaN, so it is handled first.
  const double s = share > 0.0 ? std::min(share, 1.0) : 0.0;
  const double red = std::max(0.0, 2.0 * s - 1.0);
  const double blue = std::max(0.0, 1.0 - 2.0 * s);
  return {red, 1.0 - red - blue, blue, kMinAlpha + (1.0 - kMinAlpha) * s};
}

ReadColor silent_color() { return {0.5, 0.5, 0.5, kMinAlpha}; }

void FieldPicture::on_read(const TagRead& read) {
  SeenTag& tag = tags_[read.tag];
  // Of simultaneous reads by two antennas, the stronger counts.
  const bool weaker = tag.read == read.stamp && tag.rssi_dbm > read.rssi_dbm;
  if (!weaker) {
    tag.read = read.stamp;
    tag.rssi_dbm = read.rssi_dbm;
  }
  weakest_dbm_ = std::min(weakest_dbm_.value_or(read.rssi_dbm), read.rssi_dbm);
  strongest_dbm_ = std::max(strongest_dbm_.value_or(read.rssi_dbm), read.rssi_dbm);
}

void FieldPicture::on_tag_added(const TagPosition& tag, const std::string& /*label*/) {
  tags_[tag.tag] = {tag.p_WT, Time::min(), 0.0};
}

void FieldPicture::on_antenna_pose(const AntennaInfo& antenna, const AntennaPose& pose) {
  antennas_[antenna.name] = {antenna.frame_id, pose.X_WA, antenna.range_m};
}

void FieldPicture::on_update(const AntennaInfo& /*antenna*/, Time stamp) {
  const bool reset = stamp < drawn_;
  if (!reset && drawn_ != Time::min() && stamp < drawn_ + interval_) return;
  drawn_ = stamp;
  draw(stamp);
}

ReadColor FieldPicture::color_of(const SeenTag& tag, Time stamp) const {
  if (tag.read == Time::min() || tag.read > stamp || stamp - tag.read > kLately) {
    return silent_color();
  }
  const double width = *strongest_dbm_ - *weakest_dbm_;
  return read_color(width > 0.0 ? (tag.rssi_dbm - *weakest_dbm_) / width : 1.0);
}

}  // namespace tagfield
