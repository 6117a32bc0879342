#include "tagfield/channel/path_gain.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/channel/internal/fresnel.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3cd;
using Eigen::Vector3d;

/// E·e, not conjugated, as receivers take it in.
Complex dot(const Vector3cd& a, const Vector3cd& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

double power_gain(const RadioEnd& end, const Vector3d& u_A, const ChannelEffects& effects) {
  return effects.patterns ? gain(end.pattern, u_A) : peak_gain(end.pattern);
}

Vector3d into(const RadioEnd& end, const Vector3d& u_W) {
  return end.X_WA.rotation.conjugate() * u_W;
}

Vector3cd turned_to_world(const RadioEnd& end, const Vector3cd& e_A) {
  const Eigen::Matrix3d R = end.X_WA.rotation.toRotationMatrix();
  return R * e_A;
}

/// Unit normal of the plane of incidence; at normal incidence any of those.
Vector3d across(const Vector3d& k, const Vector3d& normal) {
  const Vector3d s = k.cross(normal);
  const double length = s.norm();
  return length > 1e-9 ? Vector3d(s / length) : Vector3d(normal.unitOrthogonal());
}

/// The field after a surface that keeps TE along s and takes TM from s × `before` to s × `after`.
Vector3cd after_surface(const Vector3cd& field, const FresnelPair& pair, const Vector3d& s,
                        const Vector3d& before, const Vector3d& after) {
  const Complex te = dot(field, s.cast<Complex>());
  const Complex tm = dot(field, s.cross(before).cast<Complex>());
  return pair.te * te * s + pair.tm * tm * s.cross(after);
}

FresnelPair reflection(const Material& material, Complex eta, double cosine, double lambda_m) {
  if (!material.wall_m) return half_space_reflection(eta, cosine);
  return slab_reflection(eta, cosine, *material.wall_m, lambda_m);
}

/// A single surface without a stated thickness stands for a sheet of this one [m].
constexpr double kSheet = 0.002;

/// Of an object crossed: the slab between entry and exit, or the walls of a hollow one.
FresnelPair crossing(const Material& material, Complex eta, const Crossing& through,
                     double lambda_m) {
  if (material.crossing_db) {
    const double factor = amplitude_from_db(-*material.crossing_db);
    return {factor, factor};
  }
  const double cosine = through.cos_incidence;
  const bool is_sheet = !(through.length_m > 0.0);
  if (!material.wall_m) {
    const double thickness = is_sheet ? kSheet : through.length_m * cosine;
    return slab_transmission(eta, cosine, thickness, lambda_m);
  }
  const FresnelPair wall = slab_transmission(eta, cosine, *material.wall_m, lambda_m);
  if (is_sheet) return wall;
  return {wall.te * wall.te, wall.tm * wall.tm};
}

/// A field on its way: what it is, and what it would be if every surface let it all pass.
struct Travelling {
  Vector3cd field;
  Vector3cd unhindered;
};

constexpr FresnelPair kAll{1.0, 1.0};

/// Follows a path surface by surface; `look` is told the field after each.
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
    wave.unhindered = after_surface(wave.unhindered, kAll, s, k, after);
    k = after;
  }

  const RadioPath& path_;
  const RadioWorld& world_;
  const Carrier& carrier_;
};

Travelling leaving(const RadioEnd& antenna, const Vector3d& departure_W) {
  const Vector3cd e =
      turned_to_world(antenna, field_direction(antenna.pattern, into(antenna, departure_W)));
  return {e, e};
}

/// What the tag takes in of the wave.
Complex coupling(const Travelling& wave, const RadioEnd& tag, const Vector3d& from_tag_W,
                 const ChannelEffects& effects) {
  // conj(unhindered)·field: all of it where nothing was in the way.
  if (!effects.polarization) return wave.unhindered.dot(wave.field);
  return dot(wave.field, turned_to_world(tag, field_direction(tag.pattern, into(tag, from_tag_W))));
}

double spreading(const Carrier& carrier, double length_m) {
  return carrier.lambda_m / (4.0 * kPi * length_m);
}

Complex phasor(const Carrier& carrier, double length_m) {
  return std::polar(1.0, -carrier.wave_number * length_m);
}

}  // namespace

Carrier carrier_in(const RadioWorld& world, double frequency_hz) {
  const double lambda_m = wavelength(frequency_hz);
  return {lambda_m, kTwoPi / lambda_m, permittivities(world, frequency_hz)};
}

Complex path_gain(const RadioPath& path, const RadioEnd& antenna, const RadioEnd& tag,
                  const RadioWorld& world, const Carrier& carrier, const ChannelEffects& effects) {
  if (!(path.length_m > 0.0)) return 0.0;
  Travelling wave = leaving(antenna, path.departure_W);
  const auto nothing = [](const Travelling&) {};
  PathWalk(path, world, carrier).follow(wave, nothing, nothing);
  const Vector3d from_tag = -path.arrival_W;
  const double both = power_gain(antenna, into(antenna, path.departure_W), effects) *
                      power_gain(tag, into(tag, from_tag), effects);
  return std::sqrt(both) * spreading(carrier, path.length_m) * phasor(carrier, path.length_m) *
         coupling(wave, tag, from_tag, effects);
}

Complex free_space_gain(const RadioEnd& antenna, const RadioEnd& tag, const Carrier& carrier,
                        const ChannelEffects& effects) {
  const Vector3d way = tag.X_WA.translation - antenna.X_WA.translation;
  const double length = way.norm();
  if (!(length > 0.0)) return 0.0;
  const Vector3d k = way / length;
  const double both =
      power_gain(antenna, into(antenna, k), effects) * power_gain(tag, into(tag, -k), effects);
  const Complex coupled =
      effects.polarization ? coupling(leaving(antenna, k), tag, -k, effects) : Complex(1.0);
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
  const Vector3d from_tag = -path.arrival_W;
  budget.spreading_db = 2.0 * to_db(spreading(carrier, path.length_m));
  budget.antenna_db = to_db(power_gain(antenna, into(antenna, path.departure_W), effects));
  budget.tag_db = to_db(power_gain(tag, into(tag, from_tag), effects));
  Travelling wave = leaving(antenna, path.departure_W);
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
  const double taken = std::norm(coupling(wave, tag, from_tag, effects));
  budget.polarization_db = before > 0.0 ? to_db(taken / before) : 0.0;
  return budget;
}

}  // namespace tagfield
