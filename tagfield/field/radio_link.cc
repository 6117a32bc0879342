// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/radio_link.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/path_gains.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3d;

/// A one-way gain, and its gradient with respect to the antenna's position if needed.
struct Gain : PathCache::Gain {
  void add(Complex of_path, const Vector3d& departure_W, double wave_number) {
    h += of_path;
    power += std::norm(of_path);
    // A step in the direction of departure shortens the path, so the phase of e^{−jkd} increases.
    gradient += Complex(0.0, wave_number) * of_path * departure_W;
  }
  void add(Complex share, const Gain& other) {
    h += share * other.h;
    gradient += share * other.gradient;
  }
};

/// Uniform over the sphere.
Vector3d any_direction(RandomStream& stream) {
  const double z = 2.0 * uniform(stream) - 1.0;
  const double around = kTwoPi * uniform(stream);
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(around), radius * std::sin(around), z};
}

/// Waves from all directions; this number suffices for a nearly Gaussian field.
constexpr int kDiffuseWaves = 24;

/// A sum of plane waves with random directions and phases (Clarke's model in 3D), always the same
/// for an antenna and a tag, so that the field is a function of both ends' positions and
/// decorrelates over about half a wavelength.
void add_diffuse(const RadioView& view, const TagEnd& tag, const Vector3d& p_WA, Gain& gain) {
  const double k_factor = from_db(*view.model.diffuse_k_db);
  const double amplitude = std::sqrt(gain.power / (k_factor * kDiffuseWaves));
  RandomStream stream(view.seed, Purpose::kDiffuse, view.diffuse_key, tag.key);
  const double k = view.carrier.wave_number;
  for (int i = 0; i < kDiffuseWaves; ++i) {
    const Vector3d u = any_direction(stream);
    const Vector3d from_tag = any_direction(stream);
    const double phase =
        kTwoPi * uniform(stream) + k * u.dot(p_WA) + k * from_tag.dot(tag.X_WT.translation);
    gain.add(std::polar(amplitude, phase), u, k);
  }
}

bool is_plain(const RadioView& view) { return !view.tracing.occlusion && view.tracing.order == 0; }

std::complex<double> gain_at(const DiffractedPath& path, const RadioView& view,
                             const RadioEnd& antenna, const RadioEnd& tag) {
  const ChannelEffects effects{view.model.effects.patterns, view.model.effects.polarization};
  const std::complex<double> gain =
      diffracted_gain(path, *view.edges, antenna, tag, view.world, view.carrier, effects,
                      {view.tracing.occlusion, view.tracing.order > 0});
  if (view.bodies.empty()) return gain;
  return gain * past_bodies(view.bodies, path, antenna.X_WA.translation, tag.X_WA.translation,
                            view.carrier);
}

void add_diffracted(const RadioView& view, const RadioEnd& antenna, const RadioEnd& tag,
                    Gain& gain) {
  thread_local std::vector<DiffractedPath> paths;
  trace_diffracted(view.world.scene, *view.edges, antenna.X_WA.translation, tag.X_WA.translation,
                   view.tracing, paths);
  for (const DiffractedPath& path : paths) {
    gain.add(gain_at(path, view, antenna, tag), path.departure_W, view.carrier.wave_number);
  }
}

/// Uses the antenna's images, or the tag's with antenna and tag exchanged: gains are reciprocal.
void add_paths(const RadioView& view, const TagEnd& tag, const ImageSet* images, PathCache* memory,
               const RadioEnd& antenna, const RadioEnd& at_tag, std::vector<RadioPath>& paths,
               Gain& gain) {
  const ChannelEffects effects{view.model.effects.patterns, view.model.effects.polarization};
  const double k = view.carrier.wave_number;
  thread_local std::vector<Complex> gains;
  const auto set_gains = [&](const RadioEnd& from, const RadioEnd& to) {
    gains.resize(paths.size());
    path_gains(paths, from, to, view.world, view.carrier, effects, gains);
    for (std::size_t i = 0; i < paths.size() && !view.bodies.empty(); ++i) {
      gains[i] *= past_bodies(view.bodies, paths[i], from.X_WA.translation, to.X_WA.translation,
                              view.carrier);
    }
  };
  if (tag.images != nullptr) {
    trace_paths(view.world.scene, *tag.images, antenna.X_WA.translation, view.tracing, paths);
    set_gains(at_tag, antenna);
    for (std::size_t i = 0; i < paths.size(); ++i) gain.add(gains[i], -paths[i].arrival_W, k);
    return;
  }
  const Vector3d& p_WT = tag.X_WT.translation;
  if (memory != nullptr) {
    trace_paths(view.world.scene, *images, p_WT, view.tracing, memory->stops, paths);
  } else {
    trace_paths(view.world.scene, *images, p_WT, view.tracing, paths);
  }
  set_gains(antenna, at_tag);
  for (std::size_t i = 0; i < paths.size(); ++i) gain.add(gains[i], paths[i].departure_W, k);
}

Gain gain_alone(const RadioView& view, const RigidTransform& X_WA, const ImageSet* images,
                const TagEnd& tag, PathCache* memory, std::vector<RadioPath>& paths) {
  const RadioEnd antenna{view.model.antenna, X_WA};
  const RadioEnd at_tag{tag.model.antenna, tag.X_WT};
  const ChannelEffects effects{view.model.effects.patterns, view.model.effects.polarization};
  Gain gain;
  if (is_plain(view)) {
    const Vector3d way = tag.X_WT.translation - X_WA.translation;
    const double length = way.norm();
    if (!(length > 0.0)) return gain;
    Complex free = free_space_gain(antenna, at_tag, view.carrier, effects);
    for (const MovingBody& body : view.bodies) {
      free *= past_body(body, X_WA.translation, tag.X_WT.translation, view.carrier);
    }
    gain.add(free, way / length, view.carrier.wave_number);
  } else {
    add_paths(view, tag, images, memory, antenna, at_tag, paths, gain);
  }
  if (view.edges != nullptr) add_diffracted(view, antenna, at_tag, gain);
  const bool is_diffuse = view.model.effects.diffuse && view.model.diffuse_k_db;
  if (is_diffuse) add_diffuse(view, tag, X_WA.translation, gain);
  return gain;
}

bool is_same(const RigidTransform& one, const RigidTransform& other) {
  return one.translation == other.translation && one.rotation.coeffs() == other.rotation.coeffs();
}

/// Gains of further carriers are not cached.
constexpr std::size_t kMaxGains = 64;

/// gain_alone(), or the cached gain if both ends have been at rest since and nothing moves.
Gain gain_again(const RadioView& view, const RigidTransform& X_WA, const ImageSet* images,
                const TagEnd& tag, PathCache* memory, std::vector<RadioPath>& paths) {
  if (memory == nullptr || is_plain(view) || !view.bodies.empty()) {
    return gain_alone(view, X_WA, images, tag, memory, paths);
  }
  const bool is_at_rest = memory->kind == &tag.model && memory->tag_images == tag.images &&
                          is_same(memory->X_WA, X_WA) && is_same(memory->X_WT, tag.X_WT);
  if (!is_at_rest) {
    memory->kind = &tag.model;
    memory->tag_images = tag.images;
    memory->X_WA = X_WA;
    memory->X_WT = tag.X_WT;
    memory->gains.clear();
    return gain_alone(view, X_WA, images, tag, memory, paths);
  }
  const double lambda_m = view.carrier.lambda_m;
  for (const PathCache::Gain& kept : memory->gains) {
    if (kept.lambda_m == lambda_m) return {kept};
  }
  Gain gain = gain_alone(view, X_WA, images, tag, memory, paths);
  gain.lambda_m = lambda_m;
  if (memory->gains.size() < kMaxGains) memory->gains.push_back(gain);
  return gain;
}

/// Adds the tag's neighbours' contributions from the fields that they receive.
Gain gain_from(const RadioView& view, const RigidTransform& X_WA, const ImageSet* images,
               const TagEnd& tag, PathCache* memory, std::vector<RadioPath>& paths) {
  Gain alone = gain_again(view, X_WA, images, tag, memory, paths);
  if (tag.around == nullptr) return alone;
  Gain gain;
  gain.add(tag.around->own, alone);
  for (const TagSurroundings::Neighbour& near : tag.around->neighbours) {
    const TagEnd neighbour{*near.model, near.X_WT, near.key};
    gain.add(near.share, gain_alone(view, X_WA, images, neighbour, nullptr, paths));
  }
  return gain;
}

/// ∂ arg h / ∂p.
Vector3d slope_of(const Gain& gain) {
  if (!(std::norm(gain.h) > 0.0)) return Vector3d::Zero();
  return (gain.gradient / gain.h).imag();
}

/// Over all paths of the view.
RadioLink traced_link(const RadioView& view, const TagEnd& tag, std::vector<RadioPath>& paths) {
  const RadioModel& model = view.model;
  const Gain forward = gain_from(view, view.X_WA, view.images.get(), tag, tag.memory, paths);
  const Gain backward = model.X_AR ? gain_from(view, view.X_WR, view.receiver_images.get(), tag,
                                               tag.receiver_memory, paths)
                                   : forward;
  RadioLink link;
  link.forward = forward.h;
  link.backward = backward.h;
  link.tag_dbm = model.transmit_power_dbm - model.cable_loss_db + to_db(std::norm(forward.h)) -
                 tag.model.detuning_db;
  link.reply_dbm = link.tag_dbm + tag.model.modulation_db - tag.model.detuning_db +
                   to_db(std::norm(backward.h)) - model.cable_loss_db;
  link.phase_slope_W = -(slope_of(forward) + slope_of(backward));
  return link;
}

/// One direction of the links to at most kStraightLinks tags of one kind.
void add_one_way(const RadioView& view, const RigidTransform& X_WA, std::span<const TagInView> tags,
                 StraightLinks& way) {
  const ChannelEffects effects{view.model.effects.patterns, view.model.effects.polarization};
  std::array<PoseRef, kStraightLinks> poses;
  for (std::size_t i = 0; i < tags.size(); ++i) poses[i] = tags[i].pose;
  free_space_gains({view.model.antenna, X_WA}, tags.front().model->antenna,
                   {poses.data(), tags.size()}, view.carrier, effects, way);
}

Vector3d slope_at(const StraightLinks& way, std::size_t i) {
  return {way.slope_W.x[i], way.slope_W.y[i], way.slope_W.z[i]};
}

/// traced_link() for up to kStraightLinks tags of one kind in empty space.
void add_straight_links(const RadioView& view, std::span<const TagInView> tags,
                        std::span<RadioLink> links) {
  const RadioModel& model = view.model;
  const TagModel& kind = *tags.front().model;
  StraightLinks forward;
  StraightLinks received;
  add_one_way(view, view.X_WA, tags, forward);
  if (model.X_AR) add_one_way(view, view.X_WR, tags, received);
  const StraightLinks& backward = model.X_AR ? received : forward;
  const double radiated_dbm = model.transmit_power_dbm - model.cable_loss_db;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    RadioLink& link = links[i];
    link.forward = {forward.re[i], forward.im[i]};
    link.backward = {backward.re[i], backward.im[i]};
    link.tag_dbm = radiated_dbm + forward.power_db[i] - kind.detuning_db;
    link.reply_dbm = link.tag_dbm + kind.modulation_db - kind.detuning_db + backward.power_db[i] -
                     model.cable_loss_db;
    link.phase_slope_W = slope_at(forward, i) + slope_at(backward, i);
  }
}

/// Gains as arrays, to which loops in lanes need no strides.
struct GainLanes {
  StraightLinks::Lane re;
  StraightLinks::Lane im;
};

void fill(std::span<const RadioLink> links, Complex RadioLink::*gain, GainLanes& gains) {
  for (std::size_t i = 0; i < links.size(); ++i) {
    gains.re[i] = (links[i].*gain).real();
    gains.im[i] = (links[i].*gain).imag();
  }
}

/// Subtracts the gains' phases.
void subtract_phases(const GainLanes& gains, std::size_t count, StraightLinks::Lane& phase_rad) {
  for (std::size_t i = 0; i < count; ++i) {
    phase_rad[i] -= lane_arc_tangent(gains.im[i], gains.re[i]);
  }
}

/// Subtracts them twice, for an antenna that receives by the paths by which it sends.
void subtract_phases_twice(const GainLanes& gains, std::size_t count,
                           StraightLinks::Lane& phase_rad) {
  for (std::size_t i = 0; i < count; ++i) {
    const double phase = lane_arc_tangent(gains.im[i], gains.re[i]);
    phase_rad[i] = phase_rad[i] - phase - phase;
  }
}

void wrap(std::size_t count, StraightLinks::Lane& phase_rad) {
  for (std::size_t i = 0; i < count; ++i) phase_rad[i] = lane_wrap_to_two_pi(phase_rad[i]);
}

/// reply_phases() for up to kStraightLinks links; `phase_rad` begins with the offset.
void set_phases(bool has_receiver, std::span<const RadioLink> links, InstructionSet set,
                StraightLinks::Lane& phase_rad) {
  const std::size_t count = links.size();
  GainLanes forward;
  GainLanes backward;
  fill(links, &RadioLink::forward, forward);
  if (has_receiver) fill(links, &RadioLink::backward, backward);
  in_lanes(set, [&] {
    if (has_receiver) {
      subtract_phases(forward, count, phase_rad);
      subtract_phases(backward, count, phase_rad);
    } else {
      subtract_phases_twice(forward, count, phase_rad);
    }
    wrap(count, phase_rad);
  });
}

}  // namespace

RadioView bare_view(const RadioModel& model, const RadioWorld& world, const RigidTransform& X_WA,
                    double frequency_hz, std::uint64_t diffuse_key, std::uint64_t seed) {
  TraceOptions tracing;
  tracing.occlusion = model.effects.occlusion;
  tracing.order = model.effects.reflections ? model.reflection_order : 0;
  const RigidTransform X_WR = model.X_AR ? X_WA * *model.X_AR : X_WA;
  const bool bends = model.diffraction && model.effects.diffraction;
  return {
      model,       world, carrier_in(world, frequency_hz), tracing, X_WA, X_WR, nullptr, nullptr,
      diffuse_key, seed,  bends ? &world.edges() : nullptr};
}

RadioView view_from(const RadioModel& model, const RadioWorld& world, const RigidTransform& X_WA,
                    double frequency_hz, std::uint64_t diffuse_key, std::uint64_t seed) {
  RadioView view = bare_view(model, world, X_WA, frequency_hz, diffuse_key, seed);
  const auto images_at = [&](const RigidTransform& X) {
    return std::make_shared<const ImageSet>(images_of(world.scene, X.translation, view.tracing));
  };
  view.images = images_at(view.X_WA);
  if (model.X_AR) view.receiver_images = images_at(view.X_WR);
  return view;
}

std::vector<DiffractedPath> diffracted_paths(const RadioView& view, const TagEnd& tag,
                                             bool receiver) {
  std::vector<DiffractedPath> paths;
  if (view.edges == nullptr) return paths;
  trace_diffracted(view.world.scene, *view.edges, (receiver ? view.X_WR : view.X_WA).translation,
                   tag.X_WT.translation, view.tracing, paths);
  return paths;
}

std::complex<double> gain_of(const DiffractedPath& path, const RadioView& view, const TagEnd& tag,
                             bool receiver) {
  return gain_at(path, view, {view.model.antenna, receiver ? view.X_WR : view.X_WA},
                 {tag.model.antenna, tag.X_WT});
}

std::complex<double> past_bodies(const RadioPath& path, const RadioView& view, const TagEnd& tag,
                                 bool receiver) {
  return past_bodies(view.bodies, path, (receiver ? view.X_WR : view.X_WA).translation,
                     tag.X_WT.translation, view.carrier);
}

std::complex<double> gain_to_antenna(const RadioView& view, const AntennaPattern& other,
                                     const RigidTransform& X_WO, std::uint64_t key,
                                     std::vector<RadioPath>& paths) {
  TagModel end;
  end.antenna = other;
  const ImageSet* const images = view.model.X_AR ? view.receiver_images.get() : view.images.get();
  return gain_alone(view, view.X_WR, images, {end, X_WO, key}, nullptr, paths).h;
}

RadioLink link_of(const RadioView& view, const TagEnd& tag, std::vector<RadioPath>& paths) {
  RadioLink link;
  links_of(view, {&tag, 1}, paths, {&link, 1});
  return link;
}

bool is_empty_space(const RadioView& view) {
  return is_plain(view) && view.edges == nullptr && view.bodies.empty() &&
         !(view.model.effects.diffuse && view.model.diffuse_k_db);
}

void straight_links_of(const RadioView& view, std::span<const TagInView> tags,
                       std::span<RadioLink> links) {
  std::size_t begin = 0;
  while (begin < tags.size()) {
    // Consecutive tags of one kind.
    const std::size_t most = std::min(tags.size(), begin + kStraightLinks);
    std::size_t end = begin + 1;
    while (end < most && tags[end].model == tags[begin].model) ++end;
    add_straight_links(view, tags.subspan(begin, end - begin), links.subspan(begin, end - begin));
    begin = end;
  }
}

void links_of(const RadioView& view, std::span<const TagEnd> tags, std::vector<RadioPath>& paths,
              std::span<RadioLink> links) {
  const bool is_empty = is_empty_space(view);
  std::array<TagInView, kStraightLinks> straight;
  std::size_t begin = 0;
  while (begin < tags.size()) {
    std::size_t count = 0;
    const std::size_t most = std::min(kStraightLinks, tags.size() - begin);
    while (is_empty && count < most && tags[begin + count].around == nullptr) {
      const TagEnd& tag = tags[begin + count];
      straight[count++] = {&tag.model, {&tag.X_WT.rotation, &tag.X_WT.translation}};
    }
    straight_links_of(view, {straight.data(), count}, links.subspan(begin, count));
    if (count == 0) links[begin] = traced_link(view, tags[begin], paths);
    begin += std::max(count, std::size_t{1});
  }
}

Reply reply_of(const RadioLink& link, double phase_offset_rad, const Vector3d& v_AT_W) {
  const double phase = phase_offset_rad - std::arg(link.forward) - std::arg(link.backward);
  // Positive for an approaching antenna: the phase decreases.
  return {phase, link.reply_dbm, -link.phase_slope_W.dot(v_AT_W) / kTwoPi};
}

void reply_phases(const RadioView& view, std::span<const RadioLink> links, double phase_offset_rad,
                  std::span<double> phase_rad, InstructionSet set) {
  // So that lane_wrap_to_two_pi() can wrap the differences.
  const double offset = wrap_to_two_pi(phase_offset_rad);
  StraightLinks::Lane phases;
  for (std::size_t begin = 0; begin < links.size(); begin += kStraightLinks) {
    const std::size_t count = std::min(kStraightLinks, links.size() - begin);
    std::fill_n(phases.begin(), count, offset);
    set_phases(view.model.X_AR.has_value(), links.subspan(begin, count), set, phases);
    std::copy_n(phases.begin(), count, phase_rad.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

}  // namespace tagfield
