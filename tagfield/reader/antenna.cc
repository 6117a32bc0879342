#include "tagfield/reader/antenna.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/random.h"

namespace tagfield {
namespace {

constexpr double kLeastRate = 1e-9;  // An update in 32 years: stamps must not overflow.
constexpr double kMostRate = 1e6;

std::uint64_t stamp_key(Time stamp) {
  return static_cast<std::uint64_t>(stamp.time_since_epoch().count());
}

void check_range(const PaperAntenna& antenna) {
  if (!(antenna.range_m > 0.0 && std::isfinite(antenna.range_m))) {
    throw Error(
        fmt::format("range_m must be a finite number greater than 0, is {}", antenna.range_m));
  }
  if (!(antenna.range_sigma >= 0.0 && std::isfinite(antenna.range_sigma))) {
    throw Error(
        fmt::format("range_sigma must be a finite number, 0 or more, is {}", antenna.range_sigma));
  }
}

}  // namespace

void check(const AntennaParameters& antenna) {
  const auto* const paper = std::get_if<PaperAntenna>(&antenna.model);
  if (paper != nullptr) check(paper->model);
  if (!(antenna.rate_hz >= kLeastRate && antenna.rate_hz <= kMostRate)) {
    throw Error(fmt::format("rate_hz must be from {:g} to {:g}, is {:g}", kLeastRate, kMostRate,
                            antenna.rate_hz));
  }
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
  RandomStream noise(seed, Purpose::kReadNoise, antenna_key, tag_key, stamp_key(stamp));
  RandomStream optional(seed, Purpose::kOptionalNoise, antenna_key, tag_key, stamp_key(stamp));
  return paper_signal(paper(antenna).model, link, noise, optional);
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

}  // namespace tagfield
