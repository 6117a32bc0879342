// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/free_space_gains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/internal/end_lanes.h"

namespace tagfield {
namespace {

using channel_internal::add_gains;
using channel_internal::AntennaFrame;
using channel_internal::EndLanes;
using channel_internal::frame_of;
using channel_internal::hand_of;
using channel_internal::has_wire;
using channel_internal::needs_frame;
using channel_internal::Wire;
using channel_internal::wire_of;
using Eigen::Vector3d;
using Lane = StraightLinks::Lane;
using Vectors = StraightLinks::Vectors;

inline double x_of(const Vectors& v, std::size_t i) { return v.x[i]; }
inline double y_of(const Vectors& v, std::size_t i) { return v.y[i]; }
inline double z_of(const Vectors& v, std::size_t i) { return v.z[i]; }
inline double x_of(const Vector3d& v, std::size_t /*i*/) { return v.x(); }
inline double y_of(const Vector3d& v, std::size_t /*i*/) { return v.y(); }
inline double z_of(const Vector3d& v, std::size_t /*i*/) { return v.z(); }

template <class Axis>
inline double along(const Axis& axis, const Vectors& way, std::size_t i) {
  return x_of(axis, i) * way.x[i] + y_of(axis, i) * way.y[i] + z_of(axis, i) * way.z[i];
}

/// Rotations as unit quaternions, and those of their columns that patterns need.
struct TagFrames {
  Lane w;
  Vectors v;
  Vectors boresight;
  Vectors left;
  Vectors up;
  Vectors wire;
};

struct Work {
  Vectors p_WT;
  Vectors way;  ///< Unit vectors in W, from the antenna.
  TagFrames frames;
  Lane length;
  Lane inverse_length;
  EndLanes antenna;
  EndLanes tag;
};

void set_boresights(std::size_t count, TagFrames& frames) {
  for (std::size_t i = 0; i < count; ++i) {
    const double w = frames.w[i];
    const double x = frames.v.x[i];
    const double y = frames.v.y[i];
    const double z = frames.v.z[i];
    frames.boresight.x[i] = 1.0 - 2.0 * (y * y + z * z);
    frames.boresight.y[i] = 2.0 * (x * y + w * z);
    frames.boresight.z[i] = 2.0 * (x * z - w * y);
  }
}

void set_sides(std::size_t count, TagFrames& frames) {
  for (std::size_t i = 0; i < count; ++i) {
    const double w = frames.w[i];
    const double x = frames.v.x[i];
    const double y = frames.v.y[i];
    const double z = frames.v.z[i];
    frames.left.x[i] = 2.0 * (x * y - w * z);
    frames.left.y[i] = 1.0 - 2.0 * (x * x + z * z);
    frames.left.z[i] = 2.0 * (y * z + w * x);
    frames.up.x[i] = 2.0 * (x * z + w * y);
    frames.up.y[i] = 2.0 * (y * z - w * x);
    frames.up.z[i] = 1.0 - 2.0 * (x * x + y * y);
  }
}

void set_wires(Wire wire, std::size_t count, TagFrames& frames) {
  for (std::size_t i = 0; i < count; ++i) {
    const double w = frames.w[i];
    const double x = frames.v.x[i];
    const double y = frames.v.y[i];
    const double z = frames.v.z[i];
    frames.wire.x[i] =
        wire.of_left * (2.0 * (x * y - w * z)) + wire.of_up * (2.0 * (x * z + w * y));
    frames.wire.y[i] =
        wire.of_left * (1.0 - 2.0 * (x * x + z * z)) + wire.of_up * (2.0 * (y * z - w * x));
    frames.wire.z[i] =
        wire.of_left * (2.0 * (y * z + w * x)) + wire.of_up * (1.0 - 2.0 * (x * x + y * y));
  }
}

void set_ways(const Vector3d& p_WA, std::size_t count, Work& work) {
  Vectors& way = work.way;
  const double from_x = p_WA.x();
  const double from_y = p_WA.y();
  const double from_z = p_WA.z();
  for (std::size_t i = 0; i < count; ++i) {
    const double x = work.p_WT.x[i] - from_x;
    const double y = work.p_WT.y[i] - from_y;
    const double z = work.p_WT.z[i] - from_z;
    const double length = std::sqrt(x * x + y * y + z * z);
    const double inverse = choose(length > 0.0, 1.0 / length, 0.0);
    work.length[i] = length;
    work.inverse_length[i] = inverse;
    way.x[i] = x * inverse;
    way.y[i] = y * inverse;
    way.z[i] = z * inverse;
  }
}

/// `sign` is -1 at the end where the paths arrive.
template <class Axis>
void turn_paths(Axis axis, double sign, const Vectors& way, std::size_t count, Lane& own) {
  for (std::size_t i = 0; i < count; ++i) own[i] = sign * along(axis, way, i);
}

/// The component of a wire perpendicular to the path, and its squared length.
struct WireField {
  double x, y, z;
  double across;
};
/// Same for crossed wires along up + j·hand·left.
struct CircularField {
  double re_x, re_y, re_z;
  double im_x, im_y, im_z;
  double across;
};

/// `sign` is -1 at the end where the paths arrive.
template <class Axis>
struct WireEnd {
  Axis wire;
  double sign;
  const Lane& along_wire;

  [[nodiscard]] WireField field(const Vectors& way, std::size_t i) const {
    const double part = sign * along_wire[i];
    const double x = x_of(wire, i) - part * way.x[i];
    const double y = y_of(wire, i) - part * way.y[i];
    const double z = z_of(wire, i) - part * way.z[i];
    return {x, y, z, x * x + y * y + z * z};
  }
};

template <class Axis>
struct CircularEnd {
  Axis left;
  Axis up;
  double sign;
  double hand;
  const Lane& along_left;
  const Lane& along_up;

  [[nodiscard]] CircularField field(const Vectors& way, std::size_t i) const {
    const double of_left = sign * along_left[i];
    const double of_up = sign * along_up[i];
    // Each wire's perpendicular component has the squared length 1 − u², the sum of both is 2 −
    // u_y² − u_z² ≥ 1.
    const double across = 2.0 - along_left[i] * along_left[i] - along_up[i] * along_up[i];
    return {x_of(up, i) - of_up * way.x[i],
            y_of(up, i) - of_up * way.y[i],
            z_of(up, i) - of_up * way.z[i],
            hand * (x_of(left, i) - of_left * way.x[i]),
            hand * (y_of(left, i) - of_left * way.y[i]),
            hand * (z_of(left, i) - of_left * way.z[i]),
            across};
  }
};

/// The polarization factor, by which one end receives the other's field, times √square; and the
/// smaller squared length of both perpendicular components.
struct Taken {
  double re, im;
  double square;
  double across;
};

inline double lesser(double one, double other) { return choose(one < other, one, other); }

inline Taken taken(const WireField& a, const WireField& t) {
  return {a.x * t.x + a.y * t.y + a.z * t.z, 0.0, a.across * t.across, lesser(a.across, t.across)};
}
inline Taken taken(const CircularField& a, const WireField& t) {
  return {a.re_x * t.x + a.re_y * t.y + a.re_z * t.z, a.im_x * t.x + a.im_y * t.y + a.im_z * t.z,
          a.across * t.across, t.across};
}
inline Taken taken(const WireField& a, const CircularField& t) { return taken(t, a); }
inline Taken taken(const CircularField& a, const CircularField& t) {
  const double re = (a.re_x * t.re_x + a.re_y * t.re_y + a.re_z * t.re_z) -
                    (a.im_x * t.im_x + a.im_y * t.im_y + a.im_z * t.im_z);
  const double im = (a.re_x * t.im_x + a.re_y * t.im_y + a.re_z * t.im_z) +
                    (a.im_x * t.re_x + a.im_y * t.re_y + a.im_z * t.re_z);
  return {re, im, a.across * t.across, 1.0};
}

/// √(G G')·λ/(4πd)·e^{−jkd} times `taken_at(i)`; its power equal to to_db() up to the last bits;
/// and the slope. Returns true if some links are outside the domain of the loop's functions: too
/// long, with coincident ends, or along a wire. Those have 1 in `unsure`.
template <class TakenAt>
bool add_links(const Carrier& carrier, const TakenAt& taken_at, std::size_t count, const Work& work,
               StraightLinks& links, std::array<std::uint64_t, kStraightLinks>& unsure) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  const double at_a_metre = carrier.lambda_m / (4.0 * kPi);
  const double wave_number = carrier.wave_number;
  std::uint64_t any = 0;
  // Nothing written here is read here, which compilers can't deduce for so many arrays.
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double length = work.length[i];
    const Taken of = taken_at(i);
    const double divisor = work.antenna.divisor[i] * work.tag.divisor[i] * of.square;
    const double amplitude = std::sqrt(work.antenna.power[i] * work.tag.power[i] / divisor) *
                             (at_a_metre * work.inverse_length[i]);
    const SineCosine phase = lane_sine_cosine(wave_number * length);
    const double free_re = amplitude * phase.cosine;
    const double free_im = -(amplitude * phase.sine);
    const double re = free_re * of.re - free_im * of.im;
    const double im = free_re * of.im + free_im * of.re;
    const double power = re * re + im * im;
    const double db = 10.0 * lane_log10(choose(power > kLeast, power, kLeast));
    const double towards = choose(db > kNothing_db, -wave_number, 0.0);
    links.re[i] = re;
    links.im[i] = im;
    links.power_db[i] = choose(db > kNothing_db, db, kNothing_db);
    links.slope_W.x[i] = towards * work.way.x[i];
    links.slope_W.y[i] = towards * work.way.y[i];
    links.slope_W.z[i] = towards * work.way.z[i];
    unsure[i] = static_cast<std::uint64_t>(!(length > 1e-150)) |
                static_cast<std::uint64_t>(!(wave_number * length <= kMaxLaneTurn_rad)) |
                static_cast<std::uint64_t>(!(of.across > 1e-18));
    any |= unsure[i];
  }
  return any != 0;
}

void fill(std::span<const PoseRef> tags, Work& work) {
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const Eigen::Quaterniond& R_WT = *tags[i].R_WT;
    const Vector3d& p_WT = *tags[i].p_WT;
    work.frames.w[i] = R_WT.w();
    work.frames.v.x[i] = R_WT.x();
    work.frames.v.y[i] = R_WT.y();
    work.frames.v.z[i] = R_WT.z();
    work.p_WT.x[i] = p_WT.x();
    work.p_WT.y[i] = p_WT.y();
    work.p_WT.z[i] = p_WT.z();
  }
}

/// Path directions relative to the antenna, as its pattern needs them,
void look_from_antenna(const AntennaPattern& pattern, const ChannelEffects& effects,
                       const AntennaFrame& frame, const Vector3d& wire, const Vectors& way,
                       std::size_t count, EndLanes& end) {
  if (has_wire(pattern)) turn_paths<Vector3d>(wire, 1.0, way, count, end.along_wire);
  if (!needs_frame(pattern, effects)) return;
  turn_paths<Vector3d>(frame.boresight, 1.0, way, count, end.way_own.x);
  turn_paths<Vector3d>(frame.left, 1.0, way, count, end.way_own.y);
  turn_paths<Vector3d>(frame.up, 1.0, way, count, end.way_own.z);
}

/// and relative to the tags.
void look_from_tags(const AntennaPattern& pattern, const ChannelEffects& effects,
                    const Vectors& way, std::size_t count, TagFrames& frames, EndLanes& end) {
  if (has_wire(pattern)) {
    set_wires(wire_of(pattern), count, frames);
    turn_paths<const Vectors&>(frames.wire, -1.0, way, count, end.along_wire);
  }
  if (!needs_frame(pattern, effects)) return;
  set_boresights(count, frames);
  set_sides(count, frames);
  turn_paths<const Vectors&>(frames.boresight, -1.0, way, count, end.way_own.x);
  turn_paths<const Vectors&>(frames.left, -1.0, way, count, end.way_own.y);
  turn_paths<const Vectors&>(frames.up, -1.0, way, count, end.way_own.z);
}

void set_alone(const RadioEnd& antenna, const RadioEnd& tag, const Carrier& carrier,
               const ChannelEffects& effects, std::size_t i, StraightLinks& links) {
  const std::complex<double> gain = free_space_gain(antenna, tag, carrier, effects);
  links.re[i] = gain.real();
  links.im[i] = gain.imag();
  links.power_db[i] = to_db(std::norm(gain));
  const Vector3d way = tag.X_WA.translation - antenna.X_WA.translation;
  const Vector3d slope =
      gain == 0.0 ? Vector3d::Zero().eval() : Vector3d(-carrier.wave_number * way.normalized());
  links.slope_W.x[i] = slope.x();
  links.slope_W.y[i] = slope.y();
  links.slope_W.z[i] = slope.z();
}

using Unsure = std::array<std::uint64_t, kStraightLinks>;

/// Links of one antenna with tags that have the same pattern.
struct Batch {
  const AntennaPattern& antenna;
  const AntennaPattern& tag;
  const Carrier& carrier;
  InstructionSet set;
  std::size_t count;
};

template <class TakenAt>
bool add_in_lanes(const Batch& batch, const TakenAt& taken_at, const Work& work,
                  StraightLinks& links, Unsure& unsure) {
  bool any = false;
  in_lanes(batch.set,
           [&] { any = add_links(batch.carrier, taken_at, batch.count, work, links, unsure); });
  return any;
}

/// `from`: the antenna, as WireEnd or CircularEnd.
template <class From>
bool add_from(const Batch& batch, From from, const Work& work, StraightLinks& links,
              Unsure& unsure) {
  const Vectors& way = work.way;
  const TagFrames& frames = work.frames;
  if (has_wire(batch.tag)) {
    const WireEnd<const Vectors&> to{frames.wire, -1.0, work.tag.along_wire};
    const auto at = [&, to, from](std::size_t i) {
      return taken(from.field(way, i), to.field(way, i));
    };
    return add_in_lanes(batch, at, work, links, unsure);
  }
  const CircularEnd<const Vectors&> to{frames.left,        frames.up,          -1.0,
                                       hand_of(batch.tag), work.tag.way_own.y, work.tag.way_own.z};
  const auto at = [&, to, from](std::size_t i) {
    return taken(from.field(way, i), to.field(way, i));
  };
  return add_in_lanes(batch, at, work, links, unsure);
}

/// `wire`: the antenna's wire in W, if it has one.
bool add_all_links(const Batch& batch, const AntennaFrame& frame, const Vector3d& wire,
                   bool polarization, const Work& work, StraightLinks& links, Unsure& unsure) {
  if (!polarization) {
    const auto all = [](std::size_t /*i*/) { return Taken{1.0, 0.0, 1.0, 1.0}; };
    return add_in_lanes(batch, all, work, links, unsure);
  }
  if (has_wire(batch.antenna)) {
    return add_from(batch, WireEnd<Vector3d>{wire, 1.0, work.antenna.along_wire}, work, links,
                    unsure);
  }
  const Vectors& own = work.antenna.way_own;
  const CircularEnd<Vector3d> from{frame.left, frame.up, 1.0, hand_of(batch.antenna), own.y, own.z};
  return add_from(batch, from, work, links, unsure);
}

}  // namespace

void free_space_gains(const RadioEnd& antenna, const AntennaPattern& tag,
                      std::span<const PoseRef> tags, const Carrier& carrier,
                      const ChannelEffects& effects, StraightLinks& links, InstructionSet set) {
  const std::size_t count = tags.size();
  Work work;
  const AntennaFrame frame = frame_of(antenna.X_WA.rotation);
  const Wire in_frame = wire_of(antenna.pattern);
  const Vector3d wire = in_frame.of_left * frame.left + in_frame.of_up * frame.up;
  fill(tags, work);
  in_lanes(set, [&] {
    set_ways(antenna.X_WA.translation, count, work);
    look_from_antenna(antenna.pattern, effects, frame, wire, work.way, count, work.antenna);
    look_from_tags(tag, effects, work.way, count, work.frames, work.tag);
  });
  add_gains(antenna.pattern, effects, set, count, work.antenna);
  add_gains(tag, effects, set, count, work.tag);
  Unsure unsure;
  const Batch batch{antenna.pattern, tag, carrier, set, count};
  if (!add_all_links(batch, frame, wire, effects.polarization, work, links, unsure)) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (unsure[i] == 0) continue;
    const RigidTransform X_WT{*tags[i].R_WT, *tags[i].p_WT};
    set_alone(antenna, {tag, X_WT}, carrier, effects, i, links);
  }
}

}  // namespace tagfield
