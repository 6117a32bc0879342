// SPDX-License-Identifier: Apache-2.0
/// @file
/// A reader's antenna: the paper's model, or a physical one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "tagfield/base/time.h"
#include "tagfield/channel/paper_model.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

struct RadioModel;  // in radio_model.h; created by radio_model_from() of settings/

/// The paper's antenna reads all tags within a range; the defaults are Table 1's mobile antenna
/// with gain 1.
struct PaperAntenna {
  PaperModel model;
  double range_m = 7.0;       ///< Nominal range r; greater than 0.
  double range_sigma = 0.05;  ///< σr: relative standard deviation of the range; 0 or more.
  /// Minimum RSSI of a reported reply. Unset in the paper, whose noise produces RSSI values that no
  /// reader could receive.
  std::optional<double> sensitivity_dbm{};
};

/// How an antenna is simulated. Only field/ checks which alternative it is.
using AntennaModel = std::variant<PaperAntenna, std::shared_ptr<const RadioModel>>;

/// An antenna's parameters.
struct AntennaParameters {
  std::string reader = "reader";  ///< Name of the antenna's reader.
  std::string name;               ///< Unique over all readers.
  double rate_hz = 15.0;          ///< Updates per second; greater than 0.
  AntennaModel model;
};

/// Throws Error naming the parameter that is out of range or not finite. A physical model is
/// checked where it is created.
void check(const AntennaParameters& antenna);

/// Timestamp of the antenna's update `number` (0, 1, …): number/rate, to the nanosecond.
Time update_stamp(const AntennaParameters& antenna, std::int64_t number);

/// Number of the first update at or after `time`.
std::int64_t first_update_at(const AntennaParameters& antenna, Time time);

/// The paper's parameters of an antenna with the paper's model; throws std::bad_variant_access
/// otherwise.
inline PaperAntenna& paper(AntennaParameters& antenna) {
  return std::get<PaperAntenna>(antenna.model);
}
inline const PaperAntenna& paper(const AntennaParameters& antenna) {
  return std::get<PaperAntenna>(antenna.model);
}

/// The physical model of an antenna; null for the paper's model.
inline const RadioModel* physical(const AntennaParameters& antenna) {
  const auto* const model = std::get_if<std::shared_ptr<const RadioModel>>(&antenna.model);
  return model == nullptr ? nullptr : model->get();
}

/// Whether these are physical antennas of two readers that can transmit simultaneously, which is
/// not the case if both take turns (AirSharing::kTime).
bool may_send_at_once(const AntennaParameters& a, const AntennaParameters& b);

// For the paper's antennas only:

/// The antenna's range in its update at `stamp` [m]: r·|1 + n_r|, n_r ~ N(0, σr²), drawn once per
/// update (section III-A of the paper). The draw is a function of seed, antenna and stamp.
double perturbed_range(const AntennaParameters& antenna, Time stamp, std::uint64_t seed);

/// The received signal of the tag whose ID has the stream_key() `tag_key`, at the other end of
/// `link`. The noise is a function of seed, antenna, tag and stamp alone.
Signal read_signal(const AntennaParameters& antenna, std::uint64_t antenna_key,
                   std::uint64_t tag_key, const LinkGeometry& link, Time stamp, std::uint64_t seed);

/// read_signal() for many tags with the keys `tag_keys` at `distances_m`, into arrays of the same
/// length.
void read_signals(const AntennaParameters& antenna, std::uint64_t antenna_key,
                  std::span<const std::uint64_t> tag_keys, std::span<const double> distances_m,
                  Time stamp, std::uint64_t seed, std::span<double> phase_rad,
                  std::span<double> rssi_dbm);

/// The read of the tag `tag` at the other end of `link`, with the noise of read_signal().
TagRead read_tag(const AntennaParameters& antenna, const std::string& tag, const LinkGeometry& link,
                 Time stamp, std::uint64_t seed);

}  // namespace tagfield
