// SPDX-License-Identifier: Apache-2.0
/// @file
/// Electromagnetic properties of surfaces. See docs/link_budget.md.
#pragma once

#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// A material by Recommendation ITU-R P.2040, section 3: at f [GHz] its relative permittivity is
/// a·f^b and its conductivity c·f^d [S/m].
struct Material {
  std::string name;
  double permittivity_a = 1.0;  ///< 1 or more.
  double permittivity_b = 0.0;
  double conductivity_c = 0.0;  ///< [S/m] 0 or more.
  double conductivity_d = 0.0;
  /// Thickness [m] of the wall that each surface represents, e.g. of a cardboard box. If unset,
  /// objects are solid.
  std::optional<double> wall_m;
  std::optional<double> crossing_db;  ///< Loss per object crossed, instead of the slab's.
  bool is_opaque = false;             ///< Nothing passes through, as with metal.
  /// Frequency range in which the coefficients were measured [GHz]; 0 and infinity if unknown.
  double min_ghz = 0.0;
  double max_ghz = std::numeric_limits<double>::infinity();
};

/// Table 3 of Recommendation ITU-R P.2040-3: concrete, brick, plasterboard, wood, glass, chipboard,
/// plywood, ceiling_board, marble, floorboard, metal, very_dry_ground, medium_dry_ground,
/// wet_ground; and `cardboard`, `perfect_conductor`, `person`, `air`. Most of the table is valid
/// from 1 GHz up: 0.87 to 0.93 GHz is a small extrapolation. For glass and ceiling board, the rows
/// for the lower frequencies are used; floorboard was measured from 50 GHz up.
const std::vector<Material>& known_materials();

/// The material with this name. Throws Error with the nearest name if there is none.
const Material& find_material(const std::vector<Material>& materials, const std::string& name);

/// Assigns `material` to everything with a matching name: a model, a link or a collision by its
/// scoped name ("rack", "rack::link", "rack::link::shelf"), or everything with a visual's material
/// of that name; `*` stands for any characters.
struct MaterialRule {
  std::string name;
  Material material;
  Location location;  ///< Its position in a file, for messages.
};

struct RadioWorldOptions {
  std::vector<MaterialRule> rules;                      ///< The last matching one counts.
  std::vector<Material> materials = known_materials();  ///< Candidates for guesses.
  std::string otherwise = "concrete";  ///< If no rule matches and the name gives no hint.
  bool states_otherwise = false;       ///< `otherwise` was stated, so its use is no guess.
  double min_facet_m2 = 0.1;           ///< Smaller flat pieces block waves but don't reflect them.
};

/// Throws Error naming the parameter that is out of range.
void check(const Material& material);

/// Complex relative permittivity η = a·f^b − j·c·f^d/(2π ε0 f), eqs. (28) and (29) of P.2040-1, at
/// `frequency_hz` > 0.
std::complex<double> permittivity(const Material& material, double frequency_hz);

/// Conductivity c·f^d [S/m] at `frequency_hz` > 0.
double conductivity(const Material& material, double frequency_hz);

/// Whether `frequency_hz` is in the range in which the material's coefficients were measured.
bool is_measured_at(const Material& material, double frequency_hz);

}  // namespace tagfield
