// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/internal/path_lanes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/units.h"
#include "tagfield/channel/internal/field_on_path.h"
#include "tagfield/channel/internal/fresnel_lanes.h"

namespace tagfield::channel_internal {
namespace {

void put(const Vector3d& v, std::size_t i, Vectors& to) {
  to.x[i] = v.x();
  to.y[i] = v.y();
  to.z[i] = v.z();
}

std::size_t surfaces_of(const RadioPath& path) {
  return path.crossings.size() + static_cast<std::size_t>(path.bounce_count);
}

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
                std::size_t lane, PathLanes& lanes) {
  put(at.normal_W, lane, lanes.steps[step].normal);
  lanes.steps[step].twice_if_bounce[lane] = 2.0;
  const double along = k.dot(at.normal_W);
  const double cosine = std::min(1.0, std::abs(along));
  k -= 2.0 * along * at.normal_W;
  const std::optional<double>& wall_m = in.material(at.solid).wall_m;
  add(cosine, in.eta(at.solid), wall_m ? in.wave(*wall_m) : 0.0, step, lane,
      wall_m ? lanes.slabs : lanes.half_spaces);
}

void add_crossing(const Setting& in, const Crossing& through, std::size_t step, std::size_t lane,
                  PathLanes& lanes) {
  Step& at = lanes.steps[step];
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
  lanes.is_hollow[lanes.sheets.count] = material.wall_m && !is_sheet;
  add(cosine, in.eta(through.solid), in.wave(material.wall_m.value_or(solid_m)), step, lane,
      lanes.sheets);
}

void add_surfaces(const Setting& in, const RadioPath& path, std::size_t lane, PathLanes& lanes) {
  Vector3d k = path.departure_W;
  std::size_t step = 0;
  auto through = path.crossings.begin();
  for (int leg = 0; leg <= path.bounce_count; ++leg) {
    for (; through != path.crossings.end() && through->leg == leg; ++through) {
      add_crossing(in, *through, step++, lane, lanes);
    }
    if (leg == path.bounce_count) break;
    add_bounce(in, path.bounces[static_cast<std::size_t>(leg)], k, step++, lane, lanes);
  }
}

/// Lanes in descending order of their paths' surfaces.
void sort_into_lanes(std::span<const RadioPath> paths, PathLanes& lanes) {
  std::array<std::uint32_t, kMaxSurfaces + 1> count_of{};
  for (const RadioPath& path : paths) ++count_of[std::min(surfaces_of(path), kMaxSurfaces)];
  std::array<std::uint32_t, kMaxSurfaces + 1> next{};
  std::uint32_t before = 0;
  for (std::size_t surfaces = kMaxSurfaces + 1; surfaces-- > 0;) {
    next[surfaces] = before;
    before += count_of[surfaces];
    lanes.met_by[surfaces] = before;
  }
  for (std::uint32_t i = 0; i < paths.size(); ++i) {
    lanes.path_of[next[std::min(surfaces_of(paths[i]), kMaxSurfaces)]++] = i;
  }
}

void put_path(const RadioPath& path, std::size_t lane, PathLanes& lanes) {
  put(path.departure_W, lane, lanes.way);
  put(-path.arrival_W, lane, lanes.from_tag);
  lanes.length[lane] = path.length_m;
}

/// Fills lanes up to the next whole register.
void pad(std::size_t count, PathLanes& lanes) {
  for (std::size_t i = count; i < whole_registers(count); ++i) {
    put(Vector3d::UnitX(), i, lanes.way);
    put(Vector3d::UnitX(), i, lanes.from_tag);
    lanes.length[i] = 1.0;
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

void add_paths(std::span<const RadioPath> paths, const Setting& in, PathLanes& lanes) {
  sort_into_lanes(paths, lanes);
  for (Surfaces* const kind : {&lanes.half_spaces, &lanes.slabs, &lanes.sheets}) kind->count = 0;
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const RadioPath& path = paths[lanes.path_of[lane]];
    put_path(path, lane, lanes);
    lanes.unsure[lane] = surfaces_of(path) > kMaxSurfaces;
    if (!lanes.unsure[lane]) add_surfaces(in, path, lane, lanes);
  }
  pad(paths.size(), lanes);
  for (Surfaces* const kind : {&lanes.half_spaces, &lanes.slabs, &lanes.sheets}) pad(*kind);
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

void put(const Surfaces& surfaces, std::size_t i, bool is_hollow, PathLanes& lanes) {
  const std::size_t lane = surfaces.place[i] % kLanePaths;
  Step& step = lanes.steps[surfaces.place[i] / kLanePaths];
  LanePair pair{{surfaces.te_re[i], surfaces.te_im[i]}, {surfaces.tm_re[i], surfaces.tm_im[i]}};
  if (is_hollow) pair = {pair.te * pair.te, pair.tm * pair.tm};
  step.te_re[lane] = pair.te.re;
  step.te_im[lane] = pair.te.im;
  step.tm_re[lane] = pair.tm.re;
  step.tm_im[lane] = pair.tm.im;
  lanes.unsure[lane] = lanes.unsure[lane] || !is_in_domain(surfaces, i);
}

void compute_surfaces(PathLanes& lanes, InstructionSet set) {
  in_lanes(set, [&] {
    compute([](LaneComplex eta, double cosine,
               double) { return lane_face(eta, cosine, lane_normal_component(eta, cosine)); },
            lanes.half_spaces);
    compute([](LaneComplex eta, double cosine,
               double wave) { return lane_slab_reflection(eta, cosine, wave); },
            lanes.slabs);
    compute([](LaneComplex eta, double cosine,
               double wave) { return lane_slab_transmission(eta, cosine, wave); },
            lanes.sheets);
  });
  for (std::size_t i = 0; i < lanes.half_spaces.count; ++i) put(lanes.half_spaces, i, false, lanes);
  for (std::size_t i = 0; i < lanes.slabs.count; ++i) put(lanes.slabs, i, false, lanes);
  for (std::size_t i = 0; i < lanes.sheets.count; ++i) {
    put(lanes.sheets, i, lanes.is_hollow[i], lanes);
  }
}

}  // namespace

void fill(std::span<const RadioPath> paths, const Setting& in, InstructionSet set,
          PathLanes& lanes) {
  add_paths(paths, in, lanes);
  compute_surfaces(lanes, set);
  for (std::size_t n = 0; n < kMaxSurfaces; ++n) pad(lanes.steps[n], lanes.met_by[n + 1]);
}

}  // namespace tagfield::channel_internal
