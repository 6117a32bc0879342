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
using channel_internal::into;
using channel_internal::phasor;
using channel_internal::power_gain;
using channel_internal::reflection;
using channel_internal::spreading;
using channel_internal::turned_to_world;
using Eigen::Vector3cd;
using Eigen::Vector3d;

/// Fields across a ray: along the edge as far as they can be, and k × that.
struct RayBasis {
  Vector3d along;
  Vector3d other;
};

RayBasis basis_of(const Vector3d& k, const Vector3d& axis) {
  const Vector3d along = (axis - axis.dot(k) * k).normalized();
  return {along, k.cross(along)};
}

/// What a face does to a field that comes in at `angle` [rad] from it: components before and after
/// in the rays' bases.
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
    matrix(0, column) = dot(field, out.along.cast<Complex>());
    matrix(1, column++) = dot(field, out.other.cast<Complex>());
  }
  return matrix;
}

/// A field that comes to an edge, in its ray's basis, and what it would be if nothing before it had
/// hindered it.
struct Arriving {
  Eigen::Vector2cd field;
  Eigen::Vector2cd unhindered;
};

/// What leaves the edge, in its ray's basis, and what of it a tag with the fitting polarization
/// takes in.
struct Leaving {
  Eigen::Vector2cd field;
  Complex fitting = 0.0;
};

class EdgeWalk {
 public:
  EdgeWalk(const DiffractedPath& path, const DiffractingEdge& edge, const RadioWorld& world,
           const Carrier& carrier, const TracedBeside& beside)
      : path_(path), edge_(edge), world_(world), carrier_(carrier), beside_(beside) {}

  /// The terms' sum [√m].
  [[nodiscard]] Leaving diffracted(const Arriving& wave) const {
    const WedgeTerms terms = wedge_terms(geometry());
    Leaving sum{Eigen::Vector2cd::Zero()};
    for (std::size_t i = 0; i < 2; ++i) {
      if (beside_.shadows) add_shadow(i, terms.shadow[i], wave, sum);
      if (beside_.mirrors && edge_.faces[i].mirrors) add_mirror(i, terms.mirror[i], wave, sum);
    }
    return sum;
  }

  /// What the path's crossings on `leg` leave of a field that goes along `k`.
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

  /// What the solid lets through beside its edge, where a way enters by a face.
  [[nodiscard]] FresnelPair let_through(double cosine) const {
    if (world_.scene.is_opaque(edge_.solid)) return {0.0, 0.0};
    Crossing at_edge;
    at_edge.cos_incidence = cosine;
    // Nothing of a solid is in the way beside its edge; of a plate all of it, of a sheet itself.
    constexpr double kHardly = 1e-9;
    at_edge.length_m = edge_.is_sheet            ? 0.0
                       : edge_.thickness_m > 0.0 ? edge_.thickness_m / std::max(cosine, kHardly)
                                                 : kHardly;
    return crossing(material(edge_.solid), eta(edge_.solid), at_edge, carrier_.lambda_m);
  }

  /// What a face mirrors. Metal does so as a perfect conductor down to the last minute of arc,
  /// where Fresnel's coefficients turn, which the theory has no room for.
  [[nodiscard]] FresnelPair mirrored(double cosine) const {
    constexpr double kMetal = 1e6;
    if (std::abs(eta(edge_.solid)) > kMetal) return {-1.0, 1.0};
    return reflection(material(edge_.solid), eta(edge_.solid), cosine, carrier_.lambda_m);
  }

  void add_shadow(std::size_t i, Complex term, const Arriving& wave, Leaving& sum) const {
    const auto [antenna, tag] = angles_from(i);
    // As a way on the shadow's boundary, where tag = antenna + π; the same from both ends.
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
    // As a mirrored way, where tag = π − antenna; the same from both ends.
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

/// What the tag takes in [√m] of the field that the antenna sends towards the edge.
Complex taken_in(const DiffractedPath& path, const DiffractingEdge& edge, const EdgeWalk& walk,
                 const RadioEnd& antenna, const RadioEnd& tag, const ChannelEffects& effects) {
  const Vector3cd sent =
      turned_to_world(antenna, field_direction(antenna.pattern, into(antenna, path.departure_W)));
  Vector3cd field = sent;
  walk.cross(0, path.departure_W, field);
  const RayBasis in = basis_of(path.departure_W, edge.axis_W);
  const RayBasis out = basis_of(path.arrival_W, edge.axis_W);
  const auto across_ray = [&](const Vector3cd& e) {
    return Eigen::Vector2cd(dot(e, in.along.cast<Complex>()), dot(e, in.other.cast<Complex>()));
  };
  const Leaving at = walk.diffracted({across_ray(field), across_ray(sent)});
  Vector3cd after = at.field[0] * out.along + at.field[1] * out.other;
  if (effects.polarization) {
    walk.cross(1, path.arrival_W, after);
    const Vector3cd fits =
        turned_to_world(tag, field_direction(tag.pattern, into(tag, -path.arrival_W)));
    return dot(after, fits);
  }
  // Crossings take of it what they take of the field's length.
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
  const Complex taken = taken_in(path, edge, walk, antenna, tag, effects);
  const double both = power_gain(antenna, into(antenna, path.departure_W), effects) *
                      power_gain(tag, into(tag, -path.arrival_W), effects);
  // A spherical wave's: 1/s' there and √(s'/(s (s + s'))) onwards.
  const double spread = std::sqrt(path.length_m() / (path.before_m * path.after_m));
  return std::sqrt(both) * spreading(carrier, path.length_m()) * spread *
         phasor(carrier, path.length_m()) * taken;
}

}  // namespace tagfield
