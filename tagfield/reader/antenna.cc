// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/antenna.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/random.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/stream_words.h"
#include "tagfield/channel/paper_signals.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

constexpr double kMinRate = 1e-9;  // One update in 32 years: stamps must not overflow.
constexpr double kMaxRate = 1e6;

std::uint64_t stamp_key(Time stamp) {
  return static_cast<std::uint64_t>(stamp.time_since_epoch().count());
}

void check_range(const PaperAntenna& antenna) {
  require_positive("range_m", antenna.range_m);
  require_not_negative("range_sigma", antenna.range_sigma);
  require_in_range("sensitivity_dbm", antenna.sensitivity_dbm.value_or(0.0), -150.0, 30.0);
}

}  // namespace

void check(const AntennaParameters& antenna) {
  const auto* const paper = std::get_if<PaperAntenna>(&antenna.model);
  if (paper != nullptr) check(paper->model);
  require_in_range("rate_hz", antenna.rate_hz, kMinRate, kMaxRate);
  if (paper != nullptr) check_range(*paper);
}

Time update_stamp(const AntennaParameters& antenna, std::int64_t number) {
  return time_from_seconds(static_cast<double>(number) / antenna.rate_hz);
}

std::int64_t first_update_at(const AntennaParameters& antenna, Time time) {
  auto number = static_cast<std::int64_t>(std::floor(to_seconds(time) * antenna.rate_hz)) - 1;
  while (update_stamp(antenna, number) < time) ++number;
  return number;
}

double perturbed_range(const AntennaParameters& antenna, Time stamp, std::uint64_t seed) {
  RandomStream stream(seed, Purpose::kReadRange, stream_key(antenna.name), 0, stamp_key(stamp));
  const PaperAntenna& model = paper(antenna);
  return model.range_m * std::abs(1.0 + model.range_sigma * standard_normal(stream));
}

Signal read_signal(const AntennaParameters& antenna, std::uint64_t antenna_key,
                   std::uint64_t tag_key, const LinkGeometry& link, Time stamp,
                   std::uint64_t seed) {
  Signal signal;
  read_signals(antenna, antenna_key, {&tag_key, 1}, {&link.distance_m, 1}, stamp, seed,
               {&signal.phase_rad, 1}, {&signal.rssi_dbm, 1});
  return signal;
}

void read_signals(const AntennaParameters& antenna, std::uint64_t antenna_key,
                  std::span<const std::uint64_t> tag_keys, std::span<const double> distances_m,
                  Time stamp, std::uint64_t seed, std::span<double> phase_rad,
                  std::span<double> rssi_dbm) {
  constexpr std::size_t kAtOnce = 256;
  std::array<std::uint64_t, kAtOnce> first;
  std::array<std::uint64_t, kAtOnce> second;
  std::array<double, kAtOnce> drawn;
  const PaperModel& model = paper(antenna).model;
  const bool is_optional = model.optional.kind != DistributionKind::kNone;
  for (std::size_t begin = 0; begin < tag_keys.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, tag_keys.size() - begin);
    const std::span<const std::uint64_t> keys = tag_keys.subspan(begin, count);
    first_words(seed, Purpose::kReadNoise, antenna_key, keys, stamp_key(stamp), first, second);
    for (std::size_t i = 0; is_optional && i < count; ++i) {
      RandomStream stream(seed, Purpose::kOptionalNoise, antenna_key, keys[i], stamp_key(stamp));
      drawn[i] = draw(model.optional, stream);
    }
    paper_signals(model,
                  {distances_m.subspan(begin, count),
                   {first.data(), count},
                   {second.data(), count},
                   {drawn.data(), is_optional ? count : 0}},
                  phase_rad.subspan(begin, count), rssi_dbm.subspan(begin, count));
  }
}

TagRead read_tag(const AntennaParameters& antenna, const std::string& tag, const LinkGeometry& link,
                 Time stamp, std::uint64_t seed) {
  const Signal signal =
      read_signal(antenna, stream_key(antenna.name), stream_key(tag), link, stamp, seed);
  return {stamp,
          antenna.reader,
          antenna.name,
          tag,
          paper(antenna).model.frequency_hz,
          signal.phase_rad,
          signal.rssi_dbm};
}

bool may_send_at_once(const AntennaParameters& a, const AntennaParameters& b) {
  const RadioModel* const of_a = physical(a);
  const RadioModel* const of_b = physical(b);
  if (of_a == nullptr || of_b == nullptr || a.reader == b.reader) return false;
  return of_a->sharing != AirSharing::kTime || of_b->sharing != AirSharing::kTime;
}

}  // namespace tagfield
