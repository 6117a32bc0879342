// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/path_gain.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/channel/internal/field_on_path.h"

namespace tagfield {
namespace {

using channel_internal::across;
using channel_internal::after_surface;
using channel_internal::Complex;
using channel_internal::crossing;
using channel_internal::dot;
using channel_internal::field_of;
using channel_internal::phasor;
using channel_internal::power_gain;
using channel_internal::reflection;
using channel_internal::spreading;
using channel_internal::Towards;
using channel_internal::towards;
using Eigen::Vector3cd;
using Eigen::Vector3d;

/// A wave on a path: its field and, if polarization doesn't count, what the field would be if no
/// surface attenuated it.
struct Travelling {
  Vector3cd field;
  Vector3cd unhindered;
  bool has_unhindered = false;
};

constexpr FresnelPair kAll{1.0, 1.0};

/// Follows a path surface by surface; calls `at_crossing` or `at_bounce` with the wave after each.
class PathWalk {
 public:
  PathWalk(const RadioPath& path, const RadioWorld& world, const Carrier& carrier)
      : path_(path), world_(world), carrier_(carrier) {}

  template <class AtCrossing, class AtBounce>
  void follow(Travelling& wave, const AtCrossing& at_crossing, const AtBounce& at_bounce) const {
    Vector3d k = path_.departure_W;
    for (int leg = 0; leg <= path_.bounce_count; ++leg) {
      for (const Crossing& through : path_.crossings) {
        if (through.leg != leg) continue;
        cross(through, k, wave);
        at_crossing(wave);
      }
      if (leg == path_.bounce_count) return;
      bounce(path_.bounces[static_cast<std::size_t>(leg)], k, wave);
      at_bounce(wave);
    }
  }

 private:
  [[nodiscard]] const Material& material(std::uint32_t solid) const {
    return world_.materials[world_.material_of[solid]];
  }
  [[nodiscard]] Complex eta(std::uint32_t solid) const {
    return carrier_.permittivity[world_.material_of[solid]];
  }
  void cross(const Crossing& through, const Vector3d& k, Travelling& wave) const {
    const FresnelPair pair =
        crossing(material(through.solid), eta(through.solid), through, carrier_.lambda_m);
    wave.field = after_surface(wave.field, pair, across(k, through.normal_W), k, k);
  }
  void bounce(const Bounce& at, Vector3d& k, Travelling& wave) const {
    const double cosine = std::min(1.0, std::abs(k.dot(at.normal_W)));
    const FresnelPair pair =
        reflection(material(at.solid), eta(at.solid), cosine, carrier_.lambda_m);
    const Vector3d after = k - 2.0 * k.dot(at.normal_W) * at.normal_W;
    const Vector3d s = across(k, at.normal_W);
    wave.field = after_surface(wave.field, pair, s, k, after);
    if (wave.has_unhindered) {
      wave.unhindered = after_surface(wave.unhindered, kAll, s, k, after);
    }
    k = after;
  }

  const RadioPath& path_;
  const RadioWorld& world_;
  const Carrier& carrier_;
};

Travelling leaving(const RadioEnd& antenna, const Towards& at, const ChannelEffects& effects) {
  const Vector3cd e = field_of(antenna, at);
  return {e, e, !effects.polarization};
}

/// The amplitude that the tag receives of the wave.
Complex coupling(const Travelling& wave, const RadioEnd& tag, const Towards& from_tag) {
  // conj(unhindered)·field: the whole field if nothing attenuated it.
  if (wave.has_unhindered) return wave.unhindered.dot(wave.field);
  return dot(wave.field, field_of(tag, from_tag));
}

}  // namespace

Carrier carrier_in(const RadioWorld& world, double frequency_hz) {
  const double lambda_m = wavelength(frequency_hz);
  return {lambda_m, kTwoPi / lambda_m, permittivities(world, frequency_hz)};
}

Complex path_gain(const RadioPath& path, const RadioEnd& antenna, const RadioEnd& tag,
                  const RadioWorld& world, const Carrier& carrier, const ChannelEffects& effects) {
  if (!(path.length_m > 0.0)) return 0.0;
  const Towards from_antenna = towards(antenna, path.departure_W);
  const Towards from_tag = towards(tag, -path.arrival_W);
  Travelling wave = leaving(antenna, from_antenna, effects);
  const auto nothing = [](const Travelling&) {};
  PathWalk(path, world, carrier).follow(wave, nothing, nothing);
  const double both =
      power_gain(antenna, from_antenna.u_A, effects) * power_gain(tag, from_tag.u_A, effects);
  return std::sqrt(both) * spreading(carrier, path.length_m) * phasor(carrier, path.length_m) *
         coupling(wave, tag, from_tag);
}

Complex free_space_gain(const RadioEnd& antenna, const RadioEnd& tag, const Carrier& carrier,
                        const ChannelEffects& effects) {
  const Vector3d way = tag.X_WA.translation - antenna.X_WA.translation;
  const double length = way.norm();
  if (!(length > 0.0)) return 0.0;
  const Towards from_antenna = towards(antenna, way / length);
  const Towards from_tag = towards(tag, -way / length);
  const double both =
      power_gain(antenna, from_antenna.u_A, effects) * power_gain(tag, from_tag.u_A, effects);
  const Complex coupled = effects.polarization
                              ? coupling(leaving(antenna, from_antenna, effects), tag, from_tag)
                              : Complex(1.0);
  return std::sqrt(both) * spreading(carrier, length) * phasor(carrier, length) * coupled;
}

Complex one_way_gain(const std::vector<RadioPath>& paths, const RadioEnd& antenna,
                     const RadioEnd& tag, const RadioWorld& world, const Carrier& carrier,
                     const ChannelEffects& effects) {
  Complex sum = 0.0;
  for (const RadioPath& path : paths) {
    if (!path.blocked) sum += path_gain(path, antenna, tag, world, carrier, effects);
  }
  return sum;
}

PathBudget path_budget(const RadioPath& path, const RadioEnd& antenna, const RadioEnd& tag,
                       const RadioWorld& world, const Carrier& carrier,
                       const ChannelEffects& effects) {
  PathBudget budget;
  const Towards from_antenna = towards(antenna, path.departure_W);
  const Towards from_tag = towards(tag, -path.arrival_W);
  budget.spreading_db = 2.0 * to_db(spreading(carrier, path.length_m));
  budget.antenna_db = to_db(power_gain(antenna, from_antenna.u_A, effects));
  budget.tag_db = to_db(power_gain(tag, from_tag.u_A, effects));
  Travelling wave = leaving(antenna, from_antenna, effects);
  double before = wave.field.squaredNorm();
  const auto loss = [&](const Travelling& after) {
    const double now = after.field.squaredNorm();
    const double db = before > 0.0 ? to_db(now / before) : kNothing_db;
    before = now;
    return db;
  };
  PathWalk(path, world, carrier)
      .follow(
          wave, [&](const Travelling& w) { budget.crossing_db.push_back(loss(w)); },
          [&](const Travelling& w) { budget.bounce_db.push_back(loss(w)); });
  const double taken = std::norm(coupling(wave, tag, from_tag));
  budget.polarization_db = before > 0.0 ? to_db(taken / before) : 0.0;
  return budget;
}

}  // namespace tagfield
