// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/wave_slopes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "tagfield/base/lane_math.h"

namespace tagfield {
namespace {

using Kind = HeightModel::Kind;

constexpr int kLanes = 8;  ///< Reads summed side by side.
using Lane = double[kLanes];

double sum_of(const Lane& lane) { return std::accumulate(lane, lane + kLanes, 0.0); }

/// Sums of one loop. The third unknown is left out if the height is known.
struct LaneSums {
  Lane cosine = {}, sine = {};
  Lane cosine_x = {}, cosine_y = {}, cosine_z = {};
  Lane sine_x = {}, sine_y = {}, sine_z = {};
  Lane x = {}, y = {}, z = {};
  Lane xx = {}, xy = {}, yy = {}, xz = {}, yz = {}, zz = {};
};

/// Arrays of TagPhases, starting at the first read of an aperture.
struct ReadArrays {
  const double* x;
  const double* y;
  const double* z;
  const double* value;
  const double* wavenumber;
};
/// Unknowns of the position.
struct PlaceInLanes {
  double x, y, third;
  double level;  ///< HeightModel::z.
};

template <Kind kKind>
inline double square_up(const PlaceInLanes& place, double z) {
  if constexpr (kKind == Kind::kLevel) return place.third;
  const double up = (kKind == Kind::kFree ? place.third : place.level) - z;
  return up * up;
}

/// One read's phasor e^{jψ}, and the vector from its antenna.
struct Wave {
  double dx, dy, r;  ///< To the position [m].
  double sine, cosine;
};

template <Kind kKind>
inline Wave wave_of(const ReadArrays& reads, const PlaceInLanes& place, Eigen::Index i) {
  const double dx = place.x - reads.x[i];
  const double dy = place.y - reads.y[i];
  const double square = dx * dx + dy * dy + square_up<kKind>(place, reads.z[i]);
  const double r = std::sqrt(std::max(square, 1e-4));
  const auto [sine, cosine] = lane_sine_cosine(reads.wavenumber[i] * (reads.value[i] - r));
  return {dx, dy, r, sine, cosine};
}

/// Adds read `i` to lane `k`, with derivatives with respect to the position.
struct WithSlopes {
  template <Kind kKind>
  static void add(const ReadArrays& reads, const PlaceInLanes& place, Eigen::Index i, int k,
                  LaneSums& sums) {
    const auto [dx, dy, r, sine, cosine] = wave_of<kKind>(reads, place, i);
    const double slope = reads.wavenumber[i] / r;
    const double x = slope * dx;
    const double y = slope * dy;
    sums.cosine[k] += cosine;
    sums.sine[k] += sine;
    sums.cosine_x[k] += cosine * x;
    sums.cosine_y[k] += cosine * y;
    sums.sine_x[k] += sine * x;
    sums.sine_y[k] += sine * y;
    sums.x[k] += x;
    sums.y[k] += y;
    sums.xx[k] += x * x;
    sums.xy[k] += x * y;
    sums.yy[k] += y * y;
    if constexpr (kKind != Kind::kKnown) {
      const double z = slope * (kKind == Kind::kLevel ? 0.5 : place.third - reads.z[i]);
      sums.cosine_z[k] += cosine * z;
      sums.sine_z[k] += sine * z;
      sums.z[k] += z;
      sums.xz[k] += x * z;
      sums.yz[k] += y * z;
      sums.zz[k] += z * z;
    }
  }
};

/// As above, but the sum only.
struct SumAlone {
  template <Kind kKind>
  static void add(const ReadArrays& reads, const PlaceInLanes& place, Eigen::Index i, int k,
                  LaneSums& sums) {
    const Wave wave = wave_of<kKind>(reads, place, i);
    sums.cosine[k] += wave.cosine;
    sums.sine[k] += wave.sine;
  }
};

/// Calls `add(i, k, sums)` for each of `count` reads, cycling through the lanes.
template <class Add>
inline LaneSums added_up(Eigen::Index count, const Add& add) {
  LaneSums sums;
  const Eigen::Index whole = count - count % kLanes;
  for (Eigen::Index i = 0; i < whole; i += kLanes) {
    for (int k = 0; k < kLanes; ++k) add(i + k, k, sums);
  }
  for (Eigen::Index i = whole; i < count; ++i) add(i, static_cast<int>(i - whole), sums);
  return sums;
}

ReadArrays arrays_of(const TagPhases& phases, const Aperture& part) {
  return {phases.x.data() + part.begin, phases.y.data() + part.begin, phases.z.data() + part.begin,
          phases.value.data() + part.begin, phases.wavenumber.data() + part.begin};
}

/// Calls `of(std::integral_constant<Kind, kind>)`.
template <class Of>
LaneSums by_kind(Kind kind, const Of& of) {
  if (kind == Kind::kKnown) return of(std::integral_constant<Kind, Kind::kKnown>{});
  if (kind == Kind::kLevel) return of(std::integral_constant<Kind, Kind::kLevel>{});
  return of(std::integral_constant<Kind, Kind::kFree>{});
}

/// Sums that `What` accumulates over all reads of an aperture.
template <class What>
LaneSums lane_sums(const TagPhases& phases, const Aperture& part, const HeightModel& height,
                   const PositionVector& place, InstructionSet set) {
  const ReadArrays reads = arrays_of(phases, part);
  const PlaceInLanes at{place[0], place[1], place[2], height.z};
  return by_kind(height.kind, [&](auto kind) {
    LaneSums sums;
    in_lanes(set, [&] {
      sums = added_up(part.count, [&](Eigen::Index i, int k, LaneSums& all) {
        What::template add<decltype(kind)::value>(reads, at, i, k, all);
      });
    });
    return sums;
  });
}

}  // namespace

WaveSlopes wave_slopes(const TagPhases& phases, const Aperture& part, const HeightModel& height,
                       const PositionVector& place, InstructionSet set) {
  const LaneSums sums = lane_sums<WithSlopes>(phases, part, height, place, set);
  WaveSlopes slopes;
  slopes.sum = {sum_of(sums.cosine), sum_of(sums.sine)};
  slopes.in_phase << sum_of(sums.cosine_x), sum_of(sums.cosine_y), sum_of(sums.cosine_z);
  slopes.quadrature << sum_of(sums.sine_x), sum_of(sums.sine_y), sum_of(sums.sine_z);
  slopes.slopes << sum_of(sums.x), sum_of(sums.y), sum_of(sums.z);
  const double xy = sum_of(sums.xy);
  const double xz = sum_of(sums.xz);
  const double yz = sum_of(sums.yz);
  slopes.squares << sum_of(sums.xx), xy, xz, xy, sum_of(sums.yy), yz, xz, yz, sum_of(sums.zz);
  return slopes;
}

std::complex<double> wave_sum(const TagPhases& phases, const Aperture& part,
                              const HeightModel& height, const PositionVector& place,
                              InstructionSet set) {
  const LaneSums sums = lane_sums<SumAlone>(phases, part, height, place, set);
  return {sum_of(sums.cosine), sum_of(sums.sine)};
}

}  // namespace tagfield
