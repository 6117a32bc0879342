// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/segment_sums.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/wave_lanes.h"

namespace tagfield {
namespace {

/// Σ cos and Σ sin of some phasors.
struct LaneSums {
  float in_phase[kWaveLanes];
  float quadrature[kWaveLanes];
};

/// Indices of the sums that segments use, and numbers of reads of all sums.
struct SumsInUse {
  std::vector<std::size_t> pieces;
  std::vector<std::size_t> pairs;
  std::vector<float> reads;
};

SumsInUse sums_in(const SegmentedReads& reads,
                  const std::vector<const CoherentSegment*>& segments) {
  const std::size_t pieces = reads.reads.apertures.size();
  std::vector<char> is_used(pieces + reads.pairs.size(), 0);
  for (const CoherentSegment* segment : segments) {
    for (const std::size_t sum : segment->channels) is_used[sum] = 1;
  }
  for (std::size_t i = reads.pairs.size(); i-- > 0;) {
    if (is_used[pieces + i] == 0) continue;
    for (const std::size_t part : reads.pairs[i]) is_used[part] = 1;
  }
  SumsInUse in_use;
  for (std::size_t i = 0; i < pieces; ++i) {
    in_use.reads.push_back(static_cast<float>(reads.reads.apertures[i].count));
    if (is_used[i] != 0) in_use.pieces.push_back(i);
  }
  for (std::size_t i = 0; i < reads.pairs.size(); ++i) {
    const auto& [one, other] = reads.pairs[i];
    in_use.reads.push_back(in_use.reads[one] + in_use.reads[other]);
    if (is_used[pieces + i] != 0) in_use.pairs.push_back(i);
  }
  return in_use;
}

inline void add(const LaneSums& one, const LaneSums& other, LaneSums& both) {
  for (int k = 0; k < kWaveLanes; ++k) both.in_phase[k] = one.in_phase[k] + other.in_phase[k];
  for (int k = 0; k < kWaveLanes; ++k) {
    both.quadrature[k] = one.quadrature[k] + other.quadrature[k];
  }
}

inline void add_segment(const CoherentSegment& segment, const float* reads, const LaneSums* sums,
                        float* likelihood) {
  LaneRow shares = {};
  for (const std::size_t channel : segment.channels) {
    LaneRow in_phase;
    LaneRow quadrature;
    load(sums[channel].in_phase, in_phase);
    load(sums[channel].quadrature, quadrature);
    const float each = 1.0f / (reads[channel] * segment.reads);
    shares += each * (in_phase * in_phase + quadrature * quadrature);
  }
  float share[kWaveLanes];
  store(shares, share);
  for (int k = 0; k < kWaveLanes; ++k) {
    const float left = std::max(1.0f - share[k], kMinLeft);
    likelihood[k] -= segment.freedom * lane_log(left);
  }
}

}  // namespace

Tile segment_sums(const SegmentedReads& reads, const std::vector<const CoherentSegment*>& segments,
                  const Tile& x, const Tile& y, const Tile& z, InstructionSet set) {
  const SumsInUse in_use = sums_in(reads, segments);
  const std::vector<Aperture>& pieces = reads.reads.apertures;
  std::vector<LaneSums> sums(pieces.size() + reads.pairs.size());
  Tile likelihoods;
  in_lanes(set, [&] {
    for (int first = 0; first < kTile; first += kWaveLanes) {
      for (const std::size_t i : in_use.pieces) {
        add_waves<true>(reads.reads.reads.data() + pieces[i].begin,
                        static_cast<std::size_t>(pieces[i].count), x.data() + first,
                        y.data() + first, z.data() + first, sums[i].in_phase, sums[i].quadrature);
      }
      for (const std::size_t i : in_use.pairs) {
        add(sums[reads.pairs[i][0]], sums[reads.pairs[i][1]], sums[pieces.size() + i]);
      }
      float likelihood[kWaveLanes] = {};
      for (const CoherentSegment* segment : segments) {
        add_segment(*segment, in_use.reads.data(), sums.data(), likelihood);
      }
      for (int k = 0; k < kWaveLanes; ++k) likelihoods.data()[first + k] = likelihood[k];
    }
  });
  return likelihoods;
}

double independent_samples(const std::vector<double>& along_m, double wavelength,
                           InstructionSet set) {
  if (along_m.empty()) return 0.0;
  constexpr std::size_t kLanes = 8;
  constexpr double kNear = 1e-6;  // sinc is 1 there.
  const std::size_t count = along_m.size();
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
  std::vector<double> angles(whole, 0.0);
  std::vector<double> sines(whole, 0.0);
  std::vector<double> cosines(whole, 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    angles[i] = kPi / wavelength * along_m[i];
    sines[i] = std::sin(angles[i]);
    cosines[i] = std::cos(angles[i]);
  }
  double pairs[kLanes] = {};
  in_lanes(set, [&] {
    for (std::size_t i = 1; i < count; ++i) {
      const double angle = angles[i];
      const double sine = sines[i];
      const double cosine = cosines[i];
      for (std::size_t first = 0; first < i; first += kLanes) {
        for (std::size_t k = 0; k < kLanes; ++k) {
          const std::size_t j = first + k;
          const double apart = angle - angles[j];
          // sin(a − b) from sines and cosines of a and b.
          const double sinc = (sine * cosines[j] - cosine * sines[j]) / apart;
          const double square = choose(std::abs(apart) < kNear, 1.0, sinc * sinc);
          pairs[k] += choose(j < i, square, 0.0);
        }
      }
    }
  });
  const double all = static_cast<double>(count) + 2.0 * std::accumulate(pairs, pairs + kLanes, 0.0);
  return static_cast<double>(count) * static_cast<double>(count) / all;
}

}  // namespace tagfield
