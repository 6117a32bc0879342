// SPDX-License-Identifier: Apache-2.0
// A path is a lane. Paths are sorted by their number of surfaces, the most first, so that those
// that meet an n-th surface are the first lanes; what surfaces do to waves is computed before, by
// kind. Loops run over whole registers: lanes beyond the last path hold a path that meets nothing.
#include "tagfield/channel/path_gains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "tagfield/base/units.h"
#include "tagfield/channel/internal/end_lanes.h"
#include "tagfield/channel/internal/field_on_path.h"
#include "tagfield/channel/internal/fresnel_lanes.h"

namespace tagfield {
namespace {

using channel_internal::AntennaFrame;
using channel_internal::EndLanes;
using channel_internal::kSheet;
using channel_internal::LaneComplex;
using channel_internal::LanePair;
using Eigen::Vector3d;
using Lane = StraightLinks::Lane;
using Vectors = StraightLinks::Vectors;

constexpr std::size_t kLanePaths = kStraightLinks;
constexpr std::size_t kMaxSurfaces = 16;
/// Lanes of the widest registers.
constexpr std::size_t kRegister = 8;

std::size_t whole_registers(std::size_t count) {
  return (count + kRegister - 1) / kRegister * kRegister;
}

template <class T>
using PerSurface = std::array<T, kLanePaths * kMaxSurfaces>;

/// What surfaces of one kind do to waves.
struct alignas(64) Surfaces {
  PerSurface<double> cosine;
  PerSurface<double> eta_re;
  PerSurface<double> eta_im;
  PerSurface<double> wave;  ///< 2π·thickness/λ; unused for half spaces.
  PerSurface<double> te_re;
  PerSurface<double> te_im;
  PerSurface<double> tm_re;
  PerSurface<double> tm_im;
  PerSurface<std::uint32_t> place;  ///< Its step and lane.
  std::size_t count = 0;
};

/// The n-th surface of each path.
struct Step {
  Vectors normal;
  Lane twice_if_bounce;  ///< 2 at a reflection, else 0.
  Lane te_re;
  Lane te_im;
  Lane tm_re;
  Lane tm_im;
};

struct FieldLanes {
  Vectors re;
  Vectors im;
  Lane across;  ///< Its squared length where it was sent.
};

struct alignas(64) PathWork {
  Surfaces half_spaces;
  Surfaces slabs;   ///< That reflect,
  Surfaces sheets;  ///< or let through.
  std::array<Step, kMaxSurfaces> steps;
  Vectors way;       ///< Directions of travel in W.
  Vectors from_tag;  ///< Directions from the tag in W.
  Lane length;
  EndLanes antenna;
  EndLanes tag;
  FieldLanes wave;
  FieldLanes received;
  Lane re;
  Lane im;
  std::array<std::uint64_t, kLanePaths> unsure_lanes;  ///< Not 0 if found by a loop over lanes,
  std::array<bool, kLanePaths> unsure;                 ///< or before.
  std::array<std::uint32_t, kLanePaths> path_of;       ///< By lane.
  std::array<std::uint32_t, kMaxSurfaces + 1> met_by;  ///< Lanes that meet n surfaces or more.
  PerSurface<bool> is_hollow;  ///< By index in `sheets`: a wall on either side.
};

void put(const Vector3d& v, std::size_t i, Vectors& to) {
  to.x[i] = v.x();
  to.y[i] = v.y();
  to.z[i] = v.z();
}

std::size_t surfaces_of(const RadioPath& path) {
  return path.crossings.size() + static_cast<std::size_t>(path.bounce_count);
}

/// What all surfaces of a link share.
struct Setting {
  const RadioWorld& world;
  const Carrier& carrier;
  [[nodiscard]] const Material& material(std::uint32_t solid) const {
    return world.materials[world.material_of[solid]];
  }
  [[nodiscard]] std::complex<double> eta(std::uint32_t solid) const {
    return carrier.permittivity[world.material_of[solid]];
  }
  [[nodiscard]] double wave(double thickness_m) const { return carrier.wave_number * thickness_m; }
};

void add(double cosine, std::complex<double> eta, double wave, std::size_t step, std::size_t lane,
         Surfaces& to) {
  const std::size_t i = to.count++;
  to.cosine[i] = cosine;
  to.eta_re[i] = eta.real();
  to.eta_im[i] = eta.imag();
  to.wave[i] = wave;
  to.place[i] = static_cast<std::uint32_t>(step * kLanePaths + lane);
}

void add_bounce(const Setting& in, const Bounce& at, Vector3d& k, std::size_t step,
                std::size_t lane, PathWork& work) {
  put(at.normal_W, lane, work.steps[step].normal);
  work.steps[step].twice_if_bounce[lane] = 2.0;
  const double along = k.dot(at.normal_W);
  const double cosine = std::min(1.0, std::abs(along));
  k -= 2.0 * along * at.normal_W;
  const std::optional<double>& wall_m = in.material(at.solid).wall_m;
  add(cosine, in.eta(at.solid), wall_m ? in.wave(*wall_m) : 0.0, step, lane,
      wall_m ? work.slabs : work.half_spaces);
}

void add_crossing(const Setting& in, const Crossing& through, std::size_t step, std::size_t lane,
                  PathWork& work) {
  Step& at = work.steps[step];
  put(through.normal_W, lane, at.normal);
  at.twice_if_bounce[lane] = 0.0;
  const Material& material = in.material(through.solid);
  if (material.crossing_db) {
    at.te_re[lane] = at.tm_re[lane] = amplitude_from_db(-*material.crossing_db);
    at.te_im[lane] = at.tm_im[lane] = 0.0;
    return;
  }
  const double cosine = std::clamp(through.cos_incidence, 0.0, 1.0);
  const bool is_sheet = !(through.length_m > 0.0);
  const double solid_m = is_sheet ? kSheet : through.length_m * through.cos_incidence;
  work.is_hollow[work.sheets.count] = material.wall_m && !is_sheet;
  add(cosine, in.eta(through.solid), in.wave(material.wall_m.value_or(solid_m)), step, lane,
      work.sheets);
}

void add_surfaces(const Setting& in, const RadioPath& path, std::size_t lane, PathWork& work) {
  Vector3d k = path.departure_W;
  std::size_t step = 0;
  auto through = path.crossings.begin();
  for (int leg = 0; leg <= path.bounce_count; ++leg) {
    for (; through != path.crossings.end() && through->leg == leg; ++through) {
      add_crossing(in, *through, step++, lane, work);
    }
    if (leg == path.bounce_count) break;
    add_bounce(in, path.bounces[static_cast<std::size_t>(leg)], k, step++, lane, work);
  }
}

/// Lanes in descending order of their paths' surfaces.
void sort_into_lanes(std::span<const RadioPath> paths, PathWork& work) {
  std::array<std::uint32_t, kMaxSurfaces + 1> count_of{};
  for (const RadioPath& path : paths) ++count_of[std::min(surfaces_of(path), kMaxSurfaces)];
  std::array<std::uint32_t, kMaxSurfaces + 1> next{};
  std::uint32_t before = 0;
  for (std::size_t surfaces = kMaxSurfaces + 1; surfaces-- > 0;) {
    next[surfaces] = before;
    before += count_of[surfaces];
    work.met_by[surfaces] = before;
  }
  for (std::uint32_t i = 0; i < paths.size(); ++i) {
    work.path_of[next[std::min(surfaces_of(paths[i]), kMaxSurfaces)]++] = i;
  }
}

void put_path(const RadioPath& path, std::size_t lane, PathWork& work) {
  put(path.departure_W, lane, work.way);
  put(-path.arrival_W, lane, work.from_tag);
  work.length[lane] = path.length_m;
}

/// Fills lanes up to the next whole register.
void pad(std::size_t count, PathWork& work) {
  for (std::size_t i = count; i < whole_registers(count); ++i) {
    put(Vector3d::UnitX(), i, work.way);
    put(Vector3d::UnitX(), i, work.from_tag);
    work.length[i] = 1.0;
  }
}

void pad(Step& step, std::size_t count) {
  for (std::size_t i = count; i < whole_registers(count); ++i) {
    put(Vector3d::UnitZ(), i, step.normal);
    step.twice_if_bounce[i] = 0.0;
    step.te_re[i] = step.tm_re[i] = 1.0;
    step.te_im[i] = step.tm_im[i] = 0.0;
  }
}

void pad(Surfaces& surfaces) {
  for (std::size_t i = surfaces.count; i < whole_registers(surfaces.count); ++i) {
    surfaces.cosine[i] = surfaces.eta_re[i] = 1.0;
    surfaces.eta_im[i] = surfaces.wave[i] = 0.0;
  }
}

void fill(std::span<const RadioPath> paths, const Setting& in, PathWork& work) {
  sort_into_lanes(paths, work);
  for (Surfaces* const kind : {&work.half_spaces, &work.slabs, &work.sheets}) kind->count = 0;
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const RadioPath& path = paths[work.path_of[lane]];
    put_path(path, lane, work);
    work.unsure[lane] = surfaces_of(path) > kMaxSurfaces;
    if (!work.unsure[lane]) add_surfaces(in, path, lane, work);
  }
  pad(paths.size(), work);
  for (Surfaces* const kind : {&work.half_spaces, &work.slabs, &work.sheets}) pad(*kind);
}

/// Sets the results of surfaces of one kind by `pair_of(η, cosine, wave)`.
template <class PairOf>
void compute(const PairOf& pair_of, Surfaces& surfaces) {
  const std::size_t count = whole_registers(surfaces.count);
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const LanePair pair = pair_of(LaneComplex{surfaces.eta_re[i], surfaces.eta_im[i]},
                                  surfaces.cosine[i], surfaces.wave[i]);
    surfaces.te_re[i] = pair.te.re;
    surfaces.te_im[i] = pair.te.im;
    surfaces.tm_re[i] = pair.tm.re;
    surfaces.tm_im[i] = pair.tm.im;
  }
}

/// Whether the slab's phases are within the domain of the lanes' functions: |root| ≤ √|η| + 1.
bool is_in_domain(const Surfaces& surfaces, std::size_t i) {
  const double size = std::abs(surfaces.eta_re[i]) + std::abs(surfaces.eta_im[i]);
  const double turn = surfaces.wave[i] * (std::sqrt(size) + 1.0);
  return size < 1e100 && turn <= kMaxLaneTurn_rad;
}

void put(const Surfaces& surfaces, std::size_t i, bool is_hollow, PathWork& work) {
  const std::size_t lane = surfaces.place[i] % kLanePaths;
  Step& step = work.steps[surfaces.place[i] / kLanePaths];
  LanePair pair{{surfaces.te_re[i], surfaces.te_im[i]}, {surfaces.tm_re[i], surfaces.tm_im[i]}};
  if (is_hollow) pair = {pair.te * pair.te, pair.tm * pair.tm};
  step.te_re[lane] = pair.te.re;
  step.te_im[lane] = pair.te.im;
  step.tm_re[lane] = pair.tm.re;
  step.tm_im[lane] = pair.tm.im;
  work.unsure[lane] = work.unsure[lane] || !is_in_domain(surfaces, i);
}

void compute_surfaces(PathWork& work, InstructionSet set) {
  in_lanes(set, [&] {
    compute(
        [](LaneComplex eta, double cosine, double) {
          return channel_internal::lane_face(eta, cosine,
                                             channel_internal::lane_normal_component(eta, cosine));
        },
        work.half_spaces);
    compute([](LaneComplex eta, double cosine,
               double wave) { return channel_internal::lane_slab_reflection(eta, cosine, wave); },
            work.slabs);
    compute([](LaneComplex eta, double cosine,
               double wave) { return channel_internal::lane_slab_transmission(eta, cosine, wave); },
            work.sheets);
  });
  for (std::size_t i = 0; i < work.half_spaces.count; ++i) put(work.half_spaces, i, false, work);
  for (std::size_t i = 0; i < work.slabs.count; ++i) put(work.slabs, i, false, work);
  for (std::size_t i = 0; i < work.sheets.count; ++i) {
    put(work.sheets, i, work.is_hollow[i], work);
  }
}

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
  Vectors& way = work.way;
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
    const double length = work.length[i];
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
  fill(paths, in, work);
  compute_surfaces(work, set);
  for (std::size_t n = 0; n < kMaxSurfaces; ++n) pad(work.steps[n], work.met_by[n + 1]);
  in_lanes(set, [&] {
    set_field(antenna, work.way, count, work.antenna, work.wave);
    set_field(tag, work.from_tag, count, work.tag, work.received);
  });
  channel_internal::add_gains(antenna.pattern, effects, set, count, work.antenna);
  channel_internal::add_gains(tag.pattern, effects, set, count, work.tag);
  std::fill_n(work.unsure_lanes.begin(), count, 0);
  in_lanes(set, [&] {
    for (std::size_t n = 0; n < kMaxSurfaces && work.met_by[n + 1] > 0; ++n) {
      pass(work.steps[n], work.met_by[n + 1], work);
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
      const std::size_t i = in_batch ? work.path_of[lane] : lane;
      const bool is_sure = in_batch && !work.unsure[lane] && work.unsure_lanes[lane] == 0;
      gains[begin + i] = is_sure ? std::complex<double>(work.re[lane], work.im[lane])
                                 : path_gain(batch[i], antenna, tag, world, carrier, effects);
    }
  }
}

}  // namespace tagfield
