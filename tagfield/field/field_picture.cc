#include "tagfield/field/field_picture.h"

#include <algorithm>

namespace tagfield {
namespace {

constexpr Duration kLately = std::chrono::seconds(1);
constexpr double kLeastAlpha = 0.25;

/// A physical model has none of its own: as far as free space and the usual tag allow.
double nominal_range_m(const AntennaParameters& antenna) {
  return antenna.radio ? most_range_m(*antenna.radio, *default_tag_model()) : antenna.range_m;
}

}  // namespace

ReadColor read_color(double share) {
  // NaN clamps to NaN, so it is turned away first.
  const double s = share > 0.0 ? std::min(share, 1.0) : 0.0;
  const double red = std::max(0.0, 2.0 * s - 1.0);
  const double blue = std::max(0.0, 1.0 - 2.0 * s);
  return {red, 1.0 - red - blue, blue, kLeastAlpha + (1.0 - kLeastAlpha) * s};
}

ReadColor silent_color() { return {0.5, 0.5, 0.5, kLeastAlpha}; }

void FieldPicture::tags_changed(Time, const FieldTags& tags) {
  tags.population.for_each([&](std::uint32_t slot) {
    if (slot >= sights_.size()) {
      sights_.resize(slot + std::size_t{1});
      sighted_.resize(slot + std::size_t{1});
    }
    if (sighted_[slot] == tags.population.id(slot)) return;
    sighted_[slot] = tags.population.id(slot);  // Another tag took the slot.
    sights_[slot] = {};
  });
}

void FieldPicture::tags_moved(Time, const std::vector<std::uint32_t>&, const FieldTags&) {}

void FieldPicture::see(const AntennaUpdate& update) {
  for (const TagReply& reply : update.replies) {
    Sight& sight = sights_[reply.slot];
    // Of two antennas at once the stronger read counts.
    const bool weaker = sight.stamp == update.stamp && sight.rssi_dbm > reply.rssi_dbm;
    if (!weaker) sight = {update.stamp, reply.rssi_dbm};
    weakest_dbm_ = std::min(weakest_dbm_.value_or(reply.rssi_dbm), reply.rssi_dbm);
    strongest_dbm_ = std::max(strongest_dbm_.value_or(reply.rssi_dbm), reply.rssi_dbm);
  }
}

void FieldPicture::antenna_updated(const AntennaUpdate& update) {
  const AntennaParameters& antenna = update.antenna.parameters;
  antennas_[antenna.name] = {update.antenna.frame_id, update.X_WA, nominal_range_m(antenna)};
  see(update);
  const bool reset = update.stamp < drawn_;
  if (!reset && drawn_ != Time::min() && update.stamp < drawn_ + interval_) return;
  drawn_ = update.stamp;
  draw(update.stamp, update.tags);
}

void FieldPicture::antenna_removed(const std::string& antenna) { antennas_.erase(antenna); }

ReadColor FieldPicture::color_of(std::uint32_t slot, Time stamp) const {
  const Sight& sight = sights_[slot];
  if (sight.stamp == Time::min() || sight.stamp > stamp || stamp - sight.stamp > kLately) {
    return silent_color();
  }
  const double width = *strongest_dbm_ - *weakest_dbm_;
  return read_color(width > 0.0 ? (sight.rssi_dbm - *weakest_dbm_) / width : 1.0);
}

}  // namespace tagfield
