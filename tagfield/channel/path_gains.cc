// SPDX-License-Identifier: Apache-2.0
// Waves as lanes, past one surface after the other (internal/path_lanes.h).
#include "tagfield/channel/path_gains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tagfield/base/units.h"
#include "tagfield/channel/internal/end_lanes.h"
#include "tagfield/channel/internal/fresnel_lanes.h"
#include "tagfield/channel/internal/path_lanes.h"

namespace tagfield {
namespace {

using channel_internal::AntennaFrame;
using channel_internal::EndLanes;
using channel_internal::fill;
using channel_internal::kLanePaths;
using channel_internal::kMaxSurfaces;
using channel_internal::LaneComplex;
using channel_internal::PathLanes;
using channel_internal::Setting;
using channel_internal::Step;
using channel_internal::whole_registers;
using Eigen::Vector3d;
using Lane = StraightLinks::Lane;
using Vectors = StraightLinks::Vectors;

struct FieldLanes {
  Vectors re;
  Vectors im;
  Lane across;  ///< Its squared length where it was sent.
};

struct alignas(64) PathWork {
  PathLanes lanes;
  EndLanes antenna;
  EndLanes tag;
  FieldLanes wave;
  FieldLanes received;
  Lane re;
  Lane im;
  std::array<std::uint64_t, kLanePaths> unsure_lanes;  ///< Not 0 if a loop over lanes found it.
};

/// An end's axes and pattern.
struct LinkEnd {
  const AntennaPattern& pattern;
  AntennaFrame frame;
  Vector3d wire;  ///< In W, if there is one.
  bool has_wire;
  bool needs_frame;
  double hand;
};

LinkEnd link_end(const RadioEnd& end, const ChannelEffects& effects) {
  const AntennaFrame frame = channel_internal::frame_of(end.X_WA.rotation);
  const channel_internal::Wire wire = channel_internal::wire_of(end.pattern);
  return {end.pattern,
          frame,
          wire.of_left * frame.left + wire.of_up * frame.up,
          channel_internal::has_wire(end.pattern),
          channel_internal::needs_frame(end.pattern, effects),
          channel_internal::hand_of(end.pattern)};
}

/// u·axis for each direction u.
inline void turn(const Vector3d& axis, const Vectors& u, std::size_t count, Lane& along) {
  const double x = axis.x();
  const double y = axis.y();
  const double z = axis.z();
  for (std::size_t i = 0; i < count; ++i) along[i] = x * u.x[i] + y * u.y[i] + z * u.z[i];
}

/// Sets `part` to `sign` times the component of `axis` perpendicular to each direction u.
inline void set_part(const Vector3d& axis, double sign, const Lane& along, const Vectors& u,
                     std::size_t count, Vectors& part) {
  const double x = axis.x();
  const double y = axis.y();
  const double z = axis.z();
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    part.x[i] = sign * (x - along[i] * u.x[i]);
    part.y[i] = sign * (y - along[i] * u.y[i]);
    part.z[i] = sign * (z - along[i] * u.z[i]);
  }
}

/// The field that an end sends along each direction `u`, not normalized.
inline void set_field(const LinkEnd& end, const Vectors& u, std::size_t count, EndLanes& lanes,
                      FieldLanes& field) {
  if (end.needs_frame) {
    turn(end.frame.boresight, u, count, lanes.way_own.x);
    turn(end.frame.left, u, count, lanes.way_own.y);
    turn(end.frame.up, u, count, lanes.way_own.z);
  }
  if (end.has_wire) {
    turn(end.wire, u, count, lanes.along_wire);
    set_part(end.wire, 1.0, lanes.along_wire, u, count, field.re);
    for (std::size_t i = 0; i < count; ++i) {
      field.im.x[i] = field.im.y[i] = field.im.z[i] = 0.0;
      field.across[i] = field.re.x[i] * field.re.x[i] + field.re.y[i] * field.re.y[i] +
                        field.re.z[i] * field.re.z[i];
    }
    return;
  }
  const Lane& of_left = lanes.way_own.y;
  const Lane& of_up = lanes.way_own.z;
  set_part(end.frame.up, 1.0, of_up, u, count, field.re);
  set_part(end.frame.left, end.hand, of_left, u, count, field.im);
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    field.across[i] = 2.0 - of_left[i] * of_left[i] - of_up[i] * of_up[i];
  }
}

/// Takes the waves of the first `met` lanes past one surface each.
inline void pass(const Step& step, std::size_t met, PathWork& work) {
  Vectors& way = work.lanes.way;
  FieldLanes& wave = work.wave;
  const std::size_t count = whole_registers(met);
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double kx = way.x[i];
    const double ky = way.y[i];
    const double kz = way.z[i];
    const double nx = step.normal.x[i];
    const double ny = step.normal.y[i];
    const double nz = step.normal.z[i];
    const double along = step.twice_if_bounce[i] * (kx * nx + ky * ny + kz * nz);
    // The unit normal of the plane of incidence.
    const double ax = ky * nz - kz * ny;
    const double ay = kz * nx - kx * nz;
    const double az = kx * ny - ky * nx;
    const double square = ax * ax + ay * ay + az * az;
    const double inverse = 1.0 / std::sqrt(choose(square > 1e-18, square, 1.0));
    const double sx = ax * inverse;
    const double sy = ay * inverse;
    const double sz = az * inverse;
    // TM directions before and after.
    const double bx = sy * kz - sz * ky;
    const double by = sz * kx - sx * kz;
    const double bz = sx * ky - sy * kx;
    const double ox = kx - along * nx;
    const double oy = ky - along * ny;
    const double oz = kz - along * nz;
    const double cx = sy * oz - sz * oy;
    const double cy = sz * ox - sx * oz;
    const double cz = sx * oy - sy * ox;
    const LaneComplex on_s{wave.re.x[i] * sx + wave.re.y[i] * sy + wave.re.z[i] * sz,
                           wave.im.x[i] * sx + wave.im.y[i] * sy + wave.im.z[i] * sz};
    const LaneComplex on_b{wave.re.x[i] * bx + wave.re.y[i] * by + wave.re.z[i] * bz,
                           wave.im.x[i] * bx + wave.im.y[i] * by + wave.im.z[i] * bz};
    const LaneComplex te = LaneComplex{step.te_re[i], step.te_im[i]} * on_s;
    const LaneComplex tm = LaneComplex{step.tm_re[i], step.tm_im[i]} * on_b;
    // The others of the last register stay as they are, to the last bit.
    const bool is_met = i < met;
    wave.re.x[i] = choose(is_met, te.re * sx + tm.re * cx, wave.re.x[i]);
    wave.re.y[i] = choose(is_met, te.re * sy + tm.re * cy, wave.re.y[i]);
    wave.re.z[i] = choose(is_met, te.re * sz + tm.re * cz, wave.re.z[i]);
    wave.im.x[i] = choose(is_met, te.im * sx + tm.im * cx, wave.im.x[i]);
    wave.im.y[i] = choose(is_met, te.im * sy + tm.im * cy, wave.im.y[i]);
    wave.im.z[i] = choose(is_met, te.im * sz + tm.im * cz, wave.im.z[i]);
    way.x[i] = choose(is_met, ox, kx);
    way.y[i] = choose(is_met, oy, ky);
    way.z[i] = choose(is_met, oz, kz);
    work.unsure_lanes[i] |= static_cast<std::uint64_t>(is_met & !(square > 1e-18));
  }
}

/// √(G G')·λ/(4πd)·e^{−jkd} times what the tag receives of the wave.
inline void receive(const Carrier& carrier, std::size_t count, PathWork& work) {
  const double at_a_metre = carrier.lambda_m / (4.0 * kPi);
  const double wave_number = carrier.wave_number;
  const FieldLanes& wave = work.wave;
  const FieldLanes& tag = work.received;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double length = work.lanes.length[i];
    const double of_re =
        (wave.re.x[i] * tag.re.x[i] + wave.re.y[i] * tag.re.y[i] + wave.re.z[i] * tag.re.z[i]) -
        (wave.im.x[i] * tag.im.x[i] + wave.im.y[i] * tag.im.y[i] + wave.im.z[i] * tag.im.z[i]);
    const double of_im =
        (wave.re.x[i] * tag.im.x[i] + wave.re.y[i] * tag.im.y[i] + wave.re.z[i] * tag.im.z[i]) +
        (wave.im.x[i] * tag.re.x[i] + wave.im.y[i] * tag.re.y[i] + wave.im.z[i] * tag.re.z[i]);
    const double least = choose(wave.across[i] < tag.across[i], wave.across[i], tag.across[i]);
    const bool is_sound =
        (least > 1e-18) & (length > 1e-150) & (wave_number * length <= kMaxLaneTurn_rad);
    const double divisor = choose(
        is_sound, work.antenna.divisor[i] * work.tag.divisor[i] * (wave.across[i] * tag.across[i]),
        1.0);
    const double amplitude = std::sqrt(work.antenna.power[i] * work.tag.power[i] / divisor) *
                             (at_a_metre / choose(is_sound, length, 1.0));
    const SineCosine phase = lane_sine_cosine(choose(is_sound, wave_number * length, 0.0));
    const double free_re = amplitude * phase.cosine;
    const double free_im = -(amplitude * phase.sine);
    work.re[i] = free_re * of_re - free_im * of_im;
    work.im[i] = free_re * of_im + free_im * of_re;
    work.unsure_lanes[i] |= static_cast<std::uint64_t>(!is_sound);
  }
}

/// path_gains() for up to kLanePaths paths.
void add_batch(std::span<const RadioPath> paths, const LinkEnd& antenna, const LinkEnd& tag,
               const Setting& in, const ChannelEffects& effects, InstructionSet set,
               PathWork& work) {
  const std::size_t count = whole_registers(paths.size());
  fill(paths, in, set, work.lanes);
  in_lanes(set, [&] {
    set_field(antenna, work.lanes.way, count, work.antenna, work.wave);
    set_field(tag, work.lanes.from_tag, count, work.tag, work.received);
  });
  channel_internal::add_gains(antenna.pattern, effects, set, count, work.antenna);
  channel_internal::add_gains(tag.pattern, effects, set, count, work.tag);
  std::fill_n(work.unsure_lanes.begin(), count, 0);
  in_lanes(set, [&] {
    for (std::size_t n = 0; n < kMaxSurfaces && work.lanes.met_by[n + 1] > 0; ++n) {
      pass(work.lanes.steps[n], work.lanes.met_by[n + 1], work);
    }
    receive(in.carrier, count, work);
  });
}

}  // namespace

void path_gains(std::span<const RadioPath> paths, const RadioEnd& antenna, const RadioEnd& tag,
                const RadioWorld& world, const Carrier& carrier, const ChannelEffects& effects,
                std::span<std::complex<double>> gains, InstructionSet set) {
  thread_local PathWork work;
  const LinkEnd from = link_end(antenna, effects);
  const LinkEnd to = link_end(tag, effects);
  for (std::size_t begin = 0; begin < paths.size(); begin += kLanePaths) {
    const auto batch = paths.subspan(begin, std::min(kLanePaths, paths.size() - begin));
    const bool in_batch = effects.polarization;
    if (in_batch) add_batch(batch, from, to, {world, carrier}, effects, set, work);
    for (std::size_t lane = 0; lane < batch.size(); ++lane) {
      const std::size_t i = in_batch ? work.lanes.path_of[lane] : lane;
      const bool is_sure = in_batch && !work.lanes.unsure[lane] && work.unsure_lanes[lane] == 0;
      gains[begin + i] = is_sure ? std::complex<double>(work.re[lane], work.im[lane])
                                 : path_gain(batch[i], antenna, tag, world, carrier, effects);
    }
  }
}

}  // namespace tagfield
