// SPDX-License-Identifier: Apache-2.0
/// @file
/// Counter-based random streams. Every draw of a simulation is a function of one seed and of what
/// the draw is for, so the same seed gives the same bytes whatever the order or the threads.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tagfield {

/// What a stream's draws are for; streams of different purposes are independent.
enum class Purpose : std::uint64_t {
  kReadRange = 1,      ///< Range perturbation of an antenna update.
  kReadNoise = 2,      ///< Phase and RSSI noise of one read.
  kOptionalNoise = 3,  ///< The optional phase distribution of one read.
  kOdometry = 4,       ///< Wheel odometry noise.
  kPoseError = 5,      ///< Error of the believed pose.
  kLaser = 6,          ///< Range noise of one laser scan.
  kWheelOdometry = 7,  ///< Noise of an odometry's motion increments.
  kMapping = 8,        ///< Particles of a filter that maps.
  kLocalization = 9,   ///< Particles of a filter that localizes on a map.
  kPlaces = 10,        ///< Places where a robot begins, is carried to, or is sent.
  kHopping = 11,       ///< Order of a reader's channels, and their phase offsets.
  kDiffuse = 12,       ///< Waves that come from everywhere.
  kGen2 = 13,          ///< Slots that tags draw and replies made out, in one inventory round.
  kMeasuring = 14,     ///< Noise of what a reader measures of one reply.
  kReadLoss = 15,      ///< Reads that are lost on the way, in a comparison of methods.
  kTracking = 16,      ///< Particles of a filter that tracks a tag.
  kTagSearch = 17,     ///< Particles that stand for the places where a tag may be.
  kFault = 18,         ///< What faulty reads say instead, in a comparison of methods.
  kForecast = 19,      ///< Samples of a forecast, and of the tags of a plan.
  kSweep = 20,         ///< Values of a scenario's keys that are tried.
};

/// 64-bit key of a name (FNV-1a), so that a stream follows a tag's ID and not its place in a list.
std::uint64_t stream_key(std::string_view name);

/// A stream of 64-bit numbers: Philox-4x64-10 (Salmon et al., SC'11) with key (seed, purpose) and
/// counter (a, b, c, block). Cheap to make, so make one for each event and let it go. Meets the
/// requirements of a C++ uniform random bit generator.
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

/// A draw of [0, 1), a multiple of 2⁻⁵³.
inline double uniform(RandomStream& stream) {
  return static_cast<double>(stream() >> 11U) * 0x1p-53;
}

/// A draw of (0, 1], which has a logarithm.
inline double uniform_above_0(RandomStream& stream) { return uniform(stream) + 0x1p-53; }

/// Two independent draws of N(0, 1), by Box and Muller's method from two words of the stream.
std::array<double, 2> standard_normal_pair(RandomStream& stream);

/// One draw of N(0, 1).
inline double standard_normal(RandomStream& stream) { return standard_normal_pair(stream)[0]; }

}  // namespace tagfield
