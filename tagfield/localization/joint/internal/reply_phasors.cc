// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/reply_phasors.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/wave_sums.h"

namespace tagfield {
namespace {

constexpr int kLanes = 16;  ///< Number of points whose sums stay in registers.
static_assert(kTile % kLanes == 0);
constexpr float kNearest = 0.01f;    ///< To a source [m].
constexpr float kMinField = 1e-12f;  ///< Smaller field amplitudes count as zero.

using Lane = float[kLanes];

/// Sums of the waves at some points.
struct LaneField {
  Lane re = {}, im = {};
  Lane amplitudes = {};
  Lane direct = {};
  // Sums of each wave times its direction, and the direction of the direct one.
  Lane x_re = {}, x_im = {}, y_re = {}, y_im = {}, z_re = {}, z_im = {};
  Lane straight_x = {}, straight_y = {}, straight_z = {};
};

inline void add_wave(const NearReply::Wave& wave, float turns_per_metre, const float* x,
                     const float* y, const float* z, LaneField& field) {
  const float is_direct = wave.direct ? 1.0f : 0.0f;
  for (int k = 0; k < kLanes; ++k) {
    const float dx = x[k] - wave.x;
    const float dy = y[k] - wave.y;
    const float dz = z[k] - wave.z;
    const float far = std::sqrt(dx * dx + dy * dy + dz * dz);
    const float r = far > kNearest ? far : kNearest;
    float cosine = 0.0f;
    float sine = 0.0f;
    wave_of(turns_per_metre * r, cosine, sine);
    const float inverse = 1.0f / r;
    const float re = (wave.in_phase * cosine + wave.quadrature * sine) * inverse;
    const float im = (wave.quadrature * cosine - wave.in_phase * sine) * inverse;
    field.re[k] += re;
    field.im[k] += im;
    field.amplitudes[k] += wave.amplitude * inverse;
    const float ux = dx * inverse;
    const float uy = dy * inverse;
    const float uz = dz * inverse;
    field.x_re[k] += re * ux;
    field.x_im[k] += im * ux;
    field.y_re[k] += re * uy;
    field.y_im[k] += im * uy;
    field.z_re[k] += re * uz;
    field.z_im[k] += im * uz;
    field.direct[k] += is_direct * wave.amplitude * inverse;
    field.straight_x[k] += is_direct * ux;
    field.straight_y[k] += is_direct * uy;
    field.straight_z[k] += is_direct * uz;
  }
}

inline void field_of(const std::vector<NearReply::Wave>& waves, float turns_per_metre,
                     const float* x, const float* y, const float* z, LaneField& field) {
  for (const NearReply::Wave& wave : waves) add_wave(wave, turns_per_metre, x, y, z, field);
}

/// One direction of the reply, forward or backward.
struct LaneWay {
  Lane cosine = {}, sine = {};  ///< Of the field's phase.
  Lane directness = {};
  Lane x = {}, y = {}, z = {};  ///< Slope of its bend.
};

inline void way_of(const LaneField& f, LaneWay& way) {
  for (int k = 0; k < kLanes; ++k) {
    const float power = f.re[k] * f.re[k] + f.im[k] * f.im[k];
    const float some = power > kMinField * kMinField ? power : kMinField * kMinField;
    const float size = std::sqrt(some);
    way.cosine[k] = f.re[k] / size;
    way.sine[k] = f.im[k] / size;
    const float all = f.amplitudes[k] > kMinField ? f.amplitudes[k] : kMinField;
    way.directness[k] = f.direct[k] / all;
    way.x[k] = (f.x_re[k] * f.re[k] + f.x_im[k] * f.im[k]) / some - f.straight_x[k];
    way.y[k] = (f.y_re[k] * f.re[k] + f.y_im[k] * f.im[k]) / some - f.straight_y[k];
    way.z[k] = (f.z_re[k] * f.re[k] + f.z_im[k] * f.im[k]) / some - f.straight_z[k];
  }
}

inline void phasors_of(const NearReply& reply, const float* x, const float* y, const float* z,
                       float* in_phase, float* quadrature, float* directness, float* slope) {
  LaneField field;
  LaneWay forth;
  field_of(reply.forward, reply.turns_per_metre, x, y, z, field);
  way_of(field, forth);
  LaneWay back = forth;
  if (!reply.backward.empty()) {
    LaneField other;
    field_of(reply.backward, reply.turns_per_metre, x, y, z, other);
    way_of(other, back);
  }
  for (int k = 0; k < kLanes; ++k) {
    in_phase[k] = forth.cosine[k] * back.cosine[k] - forth.sine[k] * back.sine[k];
    quadrature[k] = -(forth.cosine[k] * back.sine[k] + forth.sine[k] * back.cosine[k]);
    directness[k] =
        forth.directness[k] < back.directness[k] ? forth.directness[k] : back.directness[k];
    const float gx = 0.5f * (forth.x[k] + back.x[k]);
    const float gy = 0.5f * (forth.y[k] + back.y[k]);
    const float gz = 0.5f * (forth.z[k] + back.z[k]);
    slope[k] = std::sqrt(gx * gx + gy * gy + gz * gz);
  }
}

std::vector<NearReply::Wave> near_waves(const std::vector<TracedWave>& waves,
                                        const Eigen::Vector3d& middle) {
  std::vector<NearReply::Wave> near;
  near.reserve(waves.size());
  for (const TracedWave& wave : waves) {
    const Eigen::Vector3f p = (wave.source_W - middle).cast<float>();
    near.push_back({p.x(), p.y(), p.z(), static_cast<float>(wave.amplitude.real()),
                    static_cast<float>(wave.amplitude.imag()),
                    static_cast<float>(std::abs(wave.amplitude)), wave.direct});
  }
  return near;
}

}  // namespace

NearReply near_reply(const TracedReply& reply, const Eigen::Vector3d& middle, double carrier_hz) {
  return {near_waves(reply.forward, middle), near_waves(reply.backward, middle),
          static_cast<float>(1.0 / wavelength(carrier_hz))};
}

ReplyPhasors reply_phasors(const NearReply& reply, const Tile& x, const Tile& y, const Tile& z,
                           InstructionSet set) {
  ReplyPhasors all;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kLanes) {
      phasors_of(reply, x.data() + k, y.data() + k, z.data() + k, all.in_phase.data() + k,
                 all.quadrature.data() + k, all.directness.data() + k, all.slope.data() + k);
    }
  });
  return all;
}

}  // namespace tagfield
