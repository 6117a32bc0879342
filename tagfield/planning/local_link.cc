// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/local_link.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kMaxCarriers = 8;
constexpr std::size_t kPlaces = kFadingPositions;

std::size_t step_of_carriers(std::size_t channels) {
  return (channels + kMaxCarriers - 1) / kMaxCarriers;
}

/// A ray's contribution to the one-way gain at the tag's centre.
struct Ray {
  Complex h;
  double length_m = 0.0;
  double u_x = 0.0;  ///< Direction of travel at the tag.
  double u_y = 0.0;
};

using Rays = std::vector<Ray>;
/// |h|² by carrier and position.
using Powers = std::vector<double>;

void trace(const RadioView& view, const ImageSet& images, const TagEnd& tag,
           std::vector<RadioPath>& paths) {
  trace_paths(view.world.scene, images, tag.X_WT.translation, view.tracing, paths);
}

Rays rays_of(const RadioView& view, bool receiver, const TagEnd& tag,
             const std::vector<RadioPath>& paths) {
  const RadioEnd antenna{view.model.antenna, receiver ? view.X_WR : view.X_WA};
  const RadioEnd at_tag{tag.model.antenna, tag.X_WT};
  const ChannelEffects effects{view.model.effects.patterns, view.model.effects.polarization};
  Rays rays;
  rays.reserve(paths.size());
  for (const RadioPath& path : paths) {
    Complex h = path_gain(path, antenna, at_tag, view.world, view.carrier, effects);
    if (!view.bodies.empty()) h *= past_bodies(path, view, tag, receiver);
    rays.push_back({h, path.length_m, path.arrival_W.x(), path.arrival_W.y()});
  }
  for (const DiffractedPath& path : diffracted_paths(view, tag, receiver)) {
    rays.push_back({gain_of(path, view, tag, receiver), path.length_m(), path.arrival_W.x(),
                    path.arrival_W.y()});
  }
  return rays;
}

/// A ray's field at the nine positions is that at the centre times a phase step along x and one
/// along y.
void add_places(const Ray& ray, double k, double k_middle, std::array<Complex, kPlaces>& h) {
  const double quarter = 0.5 * kPi / k;
  const Complex middle = ray.h * (k_middle / k) * std::polar(1.0, -(k - k_middle) * ray.length_m);
  const Complex along_x = std::polar(1.0, -k * quarter * ray.u_x);
  const Complex along_y = std::polar(1.0, -k * quarter * ray.u_y);
  const std::array<Complex, 3> x = {std::conj(along_x), 1.0, along_x};
  const std::array<Complex, 3> y = {std::conj(along_y), 1.0, along_y};
  for (std::size_t i = 0; i < kPlaces; ++i) h[i] += middle * x[i % 3] * y[i / 3];
}

/// Adds a diffuse field: Gaussian, with the power of all rays divided by K.
void add_diffuse(const RadioView& view, const Rays& rays, RandomStream& stream,
                 std::array<Complex, kPlaces>& h) {
  if (!view.model.effects.diffuse || !view.model.diffuse_k_db) return;
  double power = 0.0;
  for (const Ray& ray : rays) power += std::norm(ray.h);
  const double sigma = std::sqrt(0.5 * power / from_db(*view.model.diffuse_k_db));
  for (Complex& field : h) {
    const auto [real, imaginary] = standard_normal_pair(stream);
    field += sigma * Complex(real, imaginary);
  }
}

Powers powers_of(const RadioView& view, const Rays& rays, const std::vector<double>& carriers_hz,
                 RandomStream& stream) {
  Powers powers;
  powers.reserve(kPlaces * carriers_hz.size());
  for (const double carrier_hz : carriers_hz) {
    std::array<Complex, kPlaces> h{};
    const double k = kTwoPi / wavelength(carrier_hz);
    for (const Ray& ray : rays) add_places(ray, k, view.carrier.wave_number, h);
    add_diffuse(view, rays, stream, h);
    for (const Complex& field : h) powers.push_back(std::norm(field));
  }
  return powers;
}

/// Power received for a gain of 1 [dBm].
double sent_dbm(const RadioModel& model, const TagModel& tag) {
  return model.transmit_power_dbm - model.cable_loss_db - tag.detuning_db;
}
double returned_db(const RadioModel& model, const TagModel& tag) {
  return tag.modulation_db - tag.detuning_db - model.cable_loss_db;
}

LocalLink judged(const RadioModel& model, const TagModel& tag, const Powers& there,
                 const Powers& back) {
  const double enough = from_db(tag.sensitivity_dbm - sent_dbm(model, tag));
  const double loud =
      from_db(model.hardware.sensitivity_dbm - sent_dbm(model, tag) - returned_db(model, tag));
  double sum_there = 0.0;
  double sum_back = 0.0;
  std::size_t heard = 0;
  for (std::size_t i = 0; i < there.size(); ++i) {
    sum_there += there[i];
    sum_back += back[i];
    if (there[i] >= enough && there[i] * back[i] >= loud) ++heard;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(there.size(), 1));
  LocalLink link;
  link.tag_dbm = std::max(kNothing_db, sent_dbm(model, tag) + to_db(sum_there / count));
  link.reply_dbm =
      std::max(kNothing_db, link.tag_dbm + returned_db(model, tag) + to_db(sum_back / count));
  link.margin_db = std::max(kNothing_db, std::min(link.tag_dbm - tag.sensitivity_dbm,
                                                  link.reply_dbm - model.hardware.sensitivity_dbm));
  link.probability = static_cast<double>(heard) / count;
  return link;
}

void append(Powers& all, const Powers& more) { all.insert(all.end(), more.begin(), more.end()); }

bool is_worse(const LocalLink& a, const LocalLink& b) {
  return a.probability != b.probability ? a.probability < b.probability : a.margin_db < b.margin_db;
}

}  // namespace

std::vector<double> sampled_carriers(const RadioModel& model) {
  const std::vector<double>& all = model.plan.carriers_hz;
  if (!model.effects.hopping) return {all.front()};
  const std::size_t step = step_of_carriers(all.size());
  std::vector<double> some;
  for (std::size_t i = step / 2; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

std::size_t hopped_channels(const RadioModel& model) {
  return model.effects.hopping ? model.plan.carriers_hz.size() : 1;
}

std::size_t sampled_carrier_of(const RadioModel& model, std::size_t channel) {
  const std::size_t channels = hopped_channels(model);
  const std::size_t step = step_of_carriers(channels);
  // As many as sampled_carriers() returns; the last one represents the remaining channels.
  const std::size_t count = (channels - step / 2 + step - 1) / step;
  return std::min(channel / step, count - 1);
}

LocalLink local_link(const RadioView& view, const TagEnd& tag,
                     const std::vector<double>& carriers_hz, std::uint64_t draw,
                     std::vector<RadioPath>& paths) {
  return local_link(view, tag, Orientations{{tag.X_WT.rotation}, false}, carriers_hz, draw, paths);
}

LocalLink local_link(const RadioView& view, const TagEnd& tag, const Orientations& orientations,
                     const std::vector<double>& carriers_hz, std::uint64_t draw,
                     std::vector<RadioPath>& paths) {
  const bool has_receiver = view.model.X_AR.has_value();
  trace(view, *view.images, tag, paths);
  std::vector<RadioPath> paths_back;
  if (has_receiver) trace(view, *view.receiver_images, tag, paths_back);
  RandomStream stream(view.seed, Purpose::kDiffuse, view.diffuse_key, tag.key, draw);
  Powers there;
  Powers back;
  std::optional<LocalLink> worst;
  for (const Eigen::Quaterniond& R_WT : orientations.R_WT) {
    const TagEnd turned{tag.model, {R_WT, tag.X_WT.translation}, tag.key};
    const Powers forward =
        powers_of(view, rays_of(view, false, turned, paths), carriers_hz, stream);
    const Powers backward =
        has_receiver ? powers_of(view, rays_of(view, true, turned, paths_back), carriers_hz, stream)
                     : forward;
    if (!orientations.worst) {
      append(there, forward);
      append(back, backward);
      continue;
    }
    const LocalLink link = judged(view.model, tag.model, forward, backward);
    if (!worst || is_worse(link, *worst)) worst = link;
  }
  return worst ? *worst : judged(view.model, tag.model, there, back);
}

std::vector<double> fading_margins_db(const RadioView& view, const TagEnd& tag,
                                      const std::vector<double>& carriers_hz, std::uint64_t draw,
                                      std::vector<RadioPath>& paths) {
  const bool has_receiver = view.model.X_AR.has_value();
  RandomStream stream(view.seed, Purpose::kDiffuse, view.diffuse_key, tag.key, draw);
  trace(view, *view.images, tag, paths);
  const Powers there = powers_of(view, rays_of(view, false, tag, paths), carriers_hz, stream);
  Powers back = there;
  if (has_receiver) {
    trace(view, *view.receiver_images, tag, paths);
    back = powers_of(view, rays_of(view, true, tag, paths), carriers_hz, stream);
  }
  const double sent = sent_dbm(view.model, tag.model);
  const double returned = returned_db(view.model, tag.model);
  std::vector<double> margins(there.size());
  for (std::size_t place = 0; place < kPlaces; ++place) {
    for (std::size_t carrier = 0; carrier < carriers_hz.size(); ++carrier) {
      const std::size_t from = carrier * kPlaces + place;
      const double at_tag = sent + to_db(there[from]) - tag.model.sensitivity_dbm;
      const double at_reader = 0.5 * (sent + returned + to_db(there[from]) + to_db(back[from]) -
                                      view.model.hardware.sensitivity_dbm);
      margins[place * carriers_hz.size() + carrier] =
          std::max(kNothing_db, std::min(at_tag, at_reader));
    }
  }
  return margins;
}

double max_margin_db(const RadioModel& model, const TagModel& tag, double distance_m) {
  const double lambda_m = wavelength(model.plan.carriers_hz.front());
  const bool has_others = (model.effects.reflections && model.reflection_order > 0) ||
                          (model.effects.diffraction && model.diffraction) ||
                          (model.effects.diffuse && model.diffuse_k_db);
  constexpr double kTwice_db = 6.02;
  const double one_way_db = to_db(peak_gain(model.antenna)) + to_db(peak_gain(tag.antenna)) +
                            amplitude_to_db(lambda_m / (4.0 * kPi * std::max(distance_m, 1e-3))) +
                            (has_others ? kTwice_db : 0.0);
  const double tag_dbm = sent_dbm(model, tag) + one_way_db;
  return std::min(tag_dbm - tag.sensitivity_dbm,
                  tag_dbm + returned_db(model, tag) + one_way_db - model.hardware.sensitivity_dbm);
}

}  // namespace tagfield
