// SPDX-License-Identifier: Apache-2.0
/// @file
/// Counter-based random streams. Every draw of a simulation is a function of one seed and of its
/// purpose, so the same seed gives the same bytes whatever the order or the number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tagfield {

/// What a stream is used for; streams with different purposes are independent.
enum class Purpose : std::uint64_t {
  kReadRange = 1,      ///< Range perturbation of an antenna update.
  kReadNoise = 2,      ///< Phase and RSSI noise of one read.
  kOptionalNoise = 3,  ///< The optional phase distribution of one read.
  kOdometry = 4,       ///< Wheel odometry noise.
  kPoseError = 5,      ///< Error of the estimated pose.
  kLaser = 6,          ///< Range noise of one laser scan.
  kWheelOdometry = 7,  ///< Noise of an odometry's motion increments.
  kMapping = 8,        ///< Particles of a mapping filter.
  kLocalization = 9,   ///< Particles of a filter that localizes on a map.
  kPlaces = 10,        ///< Positions where a robot starts, is carried to, or is sent.
  kHopping = 11,       ///< Order of a reader's channels, and their phase offsets.
  kDiffuse = 12,       ///< Diffuse waves, which arrive from all directions.
  kGen2 = 13,          ///< Slots drawn by tags, and decoding, in one inventory round.
  kMeasuring = 14,     ///< Measurement noise of a reader for one reply.
  kReadLoss = 15,      ///< Reads that are lost in transit, in a comparison of methods.
  kTracking = 16,      ///< Particles of a filter that tracks a tag.
  kTagSearch = 17,     ///< Particles that represent possible positions of a tag.
  kFault = 18,         ///< Values of faulty reads, in a comparison of methods.
  kForecast = 19,      ///< Samples of a forecast, and of a plan's tags.
  kSweep = 20,         ///< Values tried for a scenario's keys.
};

/// 64-bit key of a name (FNV-1a), so that a stream depends on a tag's ID, not on its index in a
/// list.
std::uint64_t stream_key(std::string_view name);

/// A stream of 64-bit numbers: Philox-4x64-10 (Salmon et al., SC'11) with key (seed, purpose) and
/// counter (a, b, c, block). Cheap to construct, so make one for each event and discard it. Meets
/// the requirements of a C++ uniform random bit generator.
class RandomStream {
 public:
  using result_type = std::uint64_t;

  RandomStream(std::uint64_t seed, Purpose purpose, std::uint64_t a = 0, std::uint64_t b = 0,
               std::uint64_t c = 0);

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()();

 private:
  void refill();

  std::array<std::uint64_t, 2> key_;
  std::array<std::uint64_t, 4> counter_;
  std::array<std::uint64_t, 4> block_{};
  std::size_t used_ = 4;
};

/// A draw from [0, 1), a multiple of 2⁻⁵³.
inline double uniform(RandomStream& stream) {
  return static_cast<double>(stream() >> 11U) * 0x1p-53;
}

/// A draw from (0, 1], whose logarithm is finite.
inline double uniform_above_0(RandomStream& stream) { return uniform(stream) + 0x1p-53; }

/// Two independent draws from N(0, 1), by the Box-Muller method from two words of the stream.
std::array<double, 2> standard_normal_pair(RandomStream& stream);

/// One draw from N(0, 1).
inline double standard_normal(RandomStream& stream) { return standard_normal_pair(stream)[0]; }

}  // namespace tagfield
