// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/diffracted_gain.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/channel/internal/field_on_path.h"
#include "tagfield/channel/internal/wedge.h"

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

/// Basis perpendicular to a ray: the direction closest to the edge's, and k × that.
struct RayBasis {
  Vector3d along;
  Vector3d other;
};

RayBasis basis_of(const Vector3d& k, const Vector3d& axis) {
  const Vector3d along = (axis - axis.dot(k) * k).normalized();
  return {along, k.cross(along)};
}

/// The effect of a face on a field that arrives at `angle` [rad] from it: maps components in the
/// incoming ray's basis to components in the outgoing ray's basis.
Eigen::Matrix2cd on_face(const DiffractingEdge& edge, const WedgeFace& face, double angle,
                         double cos_beta, bool mirrored, const FresnelPair& pair) {
  const double sin_beta = std::sqrt(std::max(0.0, 1.0 - cos_beta * cos_beta));
  const Vector3d k = cos_beta * edge.axis_W -
                     sin_beta * (std::cos(angle) * face.into_W + std::sin(angle) * face.normal_W);
  const Vector3d after = mirrored ? Vector3d(k - 2.0 * k.dot(face.normal_W) * face.normal_W) : k;
  const RayBasis in = basis_of(k, edge.axis_W);
  const RayBasis out = basis_of(after, edge.axis_W);
  const Vector3d s = across(k, face.normal_W);
  Eigen::Matrix2cd matrix;
  int column = 0;
  for (const Vector3d& unit : {in.along, in.other}) {
    const Vector3cd field = after_surface(unit.cast<Complex>(), pair, s, k, after);
    matrix(0, column) = dot(field, out.along);
    matrix(1, column++) = dot(field, out.other);
  }
  return matrix;
}

/// The field that arrives at an edge, in its ray's basis, and what it would be without any
/// attenuation on the path.
struct Arriving {
  Eigen::Vector2cd field;
  Eigen::Vector2cd unhindered;
};

/// The field that leaves the edge, in its ray's basis, and the amplitude that a tag with matching
/// polarization receives.
struct Leaving {
  Eigen::Vector2cd field;
  Complex fitting = 0.0;
};

class EdgeWalk {
 public:
  EdgeWalk(const DiffractedPath& path, const DiffractingEdge& edge, const RadioWorld& world,
           const Carrier& carrier, const TracedBeside& beside)
      : path_(path), edge_(edge), world_(world), carrier_(carrier), beside_(beside) {}

  /// The sum of the terms [√m].
  [[nodiscard]] Leaving diffracted(const Arriving& wave) const {
    const WedgeTerms terms = wedge_terms(geometry());
    Leaving sum{Eigen::Vector2cd::Zero()};
    for (std::size_t i = 0; i < 2; ++i) {
      if (beside_.shadows) add_shadow(i, terms.shadow[i], wave, sum);
      if (beside_.mirrors && edge_.faces[i].mirrors) add_mirror(i, terms.mirror[i], wave, sum);
    }
    return sum;
  }

  /// Applies the path's crossings on `leg` to a field that propagates along `k`.
  void cross(int leg, const Vector3d& k, Vector3cd& field) const {
    for (const Crossing& through : path_.crossings) {
      if (through.leg != leg) continue;
      const FresnelPair pair =
          crossing(material(through.solid), eta(through.solid), through, carrier_.lambda_m);
      field = after_surface(field, pair, across(k, through.normal_W), k, k);
    }
  }

 private:
  [[nodiscard]] const Material& material(std::uint32_t solid) const {
    return world_.materials[world_.material_of[solid]];
  }
  [[nodiscard]] Complex eta(std::uint32_t solid) const {
    return carrier_.permittivity[world_.material_of[solid]];
  }
  [[nodiscard]] double cos_beta() const { return path_.departure_W.dot(edge_.axis_W); }
  [[nodiscard]] double sin_beta() const { return path_.departure_W.cross(edge_.axis_W).norm(); }

  [[nodiscard]] WedgeGeometry geometry() const {
    const double sine = sin_beta();
    const double distance = path_.before_m * path_.after_m * sine * sine / path_.length_m();
    return {edge_.exterior_rad,   path_.antenna_rad, path_.tag_rad, sine,
            carrier_.wave_number, distance};
  }

  /// Angles of the antenna and the tag from face `i`.
  [[nodiscard]] std::array<double, 2> angles_from(std::size_t i) const {
    if (i == 0) return {path_.antenna_rad, path_.tag_rad};
    return {edge_.exterior_rad - path_.antenna_rad, edge_.exterior_rad - path_.tag_rad};
  }

  /// Transmission through the solid close to its edge, for a path that enters through a face.
  [[nodiscard]] FresnelPair let_through(double cosine) const {
    if (world_.scene.is_opaque(edge_.solid)) return {0.0, 0.0};
    Crossing at_edge;
    at_edge.cos_incidence = cosine;
    // Close to its edge, a solid has no thickness on the path; a plate has its full thickness, and
    // a sheet its own.
    constexpr double kHardly = 1e-9;
    at_edge.length_m = edge_.is_sheet            ? 0.0
                       : edge_.thickness_m > 0.0 ? edge_.thickness_m / std::max(cosine, kHardly)
                                                 : kHardly;
    return crossing(material(edge_.solid), eta(edge_.solid), at_edge, carrier_.lambda_m);
  }

  /// Reflection by a face. Metal reflects as a perfect conductor even within the last arc minute of
  /// grazing incidence, where the Fresnel coefficients change abruptly, which the theory can't
  /// represent.
  [[nodiscard]] FresnelPair mirrored(double cosine) const {
    constexpr double kMetal = 1e6;
    if (std::abs(eta(edge_.solid)) > kMetal) return {-1.0, 1.0};
    return reflection(material(edge_.solid), eta(edge_.solid), cosine, carrier_.lambda_m);
  }

  void add_shadow(std::size_t i, Complex term, const Arriving& wave, Leaving& sum) const {
    const auto [antenna, tag] = angles_from(i);
    // As for a path on the shadow boundary, where tag = antenna + π; the same from both ends.
    const double angle = 0.5 * (antenna + tag - kPi);
    const FresnelPair pair = let_through(sin_beta() * std::abs(std::sin(angle)));
    Eigen::Matrix2cd lost = Eigen::Matrix2cd::Identity();
    lost -= on_face(edge_, edge_.faces[i], angle, cos_beta(), false, pair);
    const Eigen::Vector2cd made = lost * wave.field;
    sum.field += term * made;
    sum.fitting += term * wave.unhindered.dot(made);
  }

  void add_mirror(std::size_t i, Complex term, const Arriving& wave, Leaving& sum) const {
    const auto [antenna, tag] = angles_from(i);
    // As for a reflected path, where tag = π − antenna; the same from both ends.
    const double angle = 0.5 * (kPi - tag + antenna);
    const FresnelPair pair = mirrored(sin_beta() * std::abs(std::sin(angle)));
    const WedgeFace& face = edge_.faces[i];
    const Eigen::Vector2cd made = on_face(edge_, face, angle, cos_beta(), true, pair) * wave.field;
    const Eigen::Vector2cd all =
        on_face(edge_, face, angle, cos_beta(), true, {1.0, 1.0}) * wave.unhindered;
    sum.field += term * made;
    sum.fitting += term * all.dot(made);
  }

  const DiffractedPath& path_;
  const DiffractingEdge& edge_;
  const RadioWorld& world_;
  const Carrier& carrier_;
  const TracedBeside& beside_;
};

/// The amplitude that the tag receives [√m] of the field `sent` by the antenna towards the edge;
/// `fits` is the field that fits the tag's antenna.
Complex taken_in(const DiffractedPath& path, const DiffractingEdge& edge, const EdgeWalk& walk,
                 const Vector3cd& sent, const Vector3cd& fits, const ChannelEffects& effects) {
  Vector3cd field = sent;
  walk.cross(0, path.departure_W, field);
  const RayBasis in = basis_of(path.departure_W, edge.axis_W);
  const RayBasis out = basis_of(path.arrival_W, edge.axis_W);
  const auto across_ray = [&](const Vector3cd& e) {
    return Eigen::Vector2cd(dot(e, in.along), dot(e, in.other));
  };
  const Leaving at = walk.diffracted({across_ray(field), across_ray(sent)});
  Vector3cd after = at.field[0] * out.along + at.field[1] * out.other;
  if (effects.polarization) {
    walk.cross(1, path.arrival_W, after);
    return dot(after, fits);
  }
  // Crossings attenuate it as they attenuate the field's magnitude.
  const double before = after.squaredNorm();
  if (!(before > 0.0)) return 0.0;
  walk.cross(1, path.arrival_W, after);
  return at.fitting * std::sqrt(after.squaredNorm() / before);
}

}  // namespace

Complex diffracted_gain(const DiffractedPath& path, const std::vector<DiffractingEdge>& edges,
                        const RadioEnd& antenna, const RadioEnd& tag, const RadioWorld& world,
                        const Carrier& carrier, const ChannelEffects& effects,
                        const TracedBeside& beside) {
  const DiffractingEdge& edge = edges[path.edge];
  const EdgeWalk walk(path, edge, world, carrier, beside);
  const Towards from_antenna = towards(antenna, path.departure_W);
  const Towards from_tag = towards(tag, -path.arrival_W);
  const Complex taken =
      taken_in(path, edge, walk, field_of(antenna, from_antenna), field_of(tag, from_tag), effects);
  const double both =
      power_gain(antenna, from_antenna.u_A, effects) * power_gain(tag, from_tag.u_A, effects);
  // Spherical wave: 1/s' up to the edge and √(s'/(s (s + s'))) from there.
  const double spread = std::sqrt(path.length_m() / (path.before_m * path.after_m));
  return std::sqrt(both) * spreading(carrier, path.length_m()) * spread *
         phasor(carrier, path.length_m()) * taken;
}

}  // namespace tagfield
