/// @file
/// A reader's antenna and the reads it makes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tagfield/base/time.h"
#include "tagfield/channel/paper_model.h"
#include "tagfield/link/link_geometry.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// An antenna's parameters; the defaults are Table 1's mobile antenna with gain 1.
struct AntennaParameters {
  std::string reader = "reader";  ///< Name of the reader that the antenna belongs to.
  std::string name;               ///< Unique over all readers.
  double rate_hz = 15.0;          ///< Updates a second; greater than 0.
  double range_m = 7.0;           ///< Nominal range r; greater than 0.
  double range_sigma = 0.05;      ///< σr: relative spread of the range; 0 or more.
  PaperModel model;
  std::shared_ptr<const RadioModel> radio;  ///< Instead of `model` and the range, where it is set.
};

/// Throws Error naming the parameter that is out of its range or not finite.
void check(const AntennaParameters& antenna);

/// Stamp of the antenna's update `number` (0, 1, …): number/rate, to the nanosecond.
Time update_stamp(const AntennaParameters& antenna, std::int64_t number);

/// Number of the first update at or after `time`.
std::int64_t first_update_at(const AntennaParameters& antenna, Time time);

/// How far the antenna reads in its update at `stamp` [m]: r·|1 + n_r|, n_r ~ N(0, σr²), drawn once
/// for each update (section III-A of the paper). The draw is a function of seed, antenna, stamp.
double perturbed_range(const AntennaParameters& antenna, Time stamp, std::uint64_t seed);

/// What the receiver sees of the tag whose ID has the stream_key() `tag_key`, at the other end of
/// `link`. The noise is a function of seed, antenna, tag and stamp alone.
Signal read_signal(const AntennaParameters& antenna, std::uint64_t antenna_key,
                   std::uint64_t tag_key, const LinkGeometry& link, Time stamp, std::uint64_t seed);

/// The read of the tag `tag` at the other end of `link`, with the noise of
/// read_signal().
TagRead read_tag(const AntennaParameters& antenna, const std::string& tag, const LinkGeometry& link,
                 Time stamp, std::uint64_t seed);

}  // namespace tagfield
