// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Vacuum permittivity [F/m] (CODATA 2018).
constexpr double kVacuumPermittivity = 8.8541878128e-12;
/// Wall of a double-wall corrugated box [m].
constexpr double kBoxWall = 0.007;

Material dielectric(const char* name, double a, double c, double d) {
  Material material;
  material.name = name;
  material.permittivity_a = a;
  material.conductivity_c = c;
  material.conductivity_d = d;
  return material;
}

Material metal(const char* name, double c) {
  Material material = dielectric(name, 1.0, c, 0.0);
  material.is_opaque = true;
  return material;
}

Material measured(Material material, double min_ghz, double max_ghz) {
  material.min_ghz = min_ghz;
  material.max_ghz = max_ghz;
  return material;
}

Material ground(const char* name, double a, double b, double c, double d) {
  Material material = measured(dielectric(name, a, c, d), 1.0, 10.0);
  material.permittivity_b = b;
  return material;
}

std::vector<Material> make_materials() {
  // Corrugated board is mostly air: an effective permittivity of 1.3 for walls of fluted paper.
  Material cardboard = dielectric("cardboard", 1.3, 0.002, 1.0);
  cardboard.wall_m = kBoxWall;
  return {measured(dielectric("concrete", 5.24, 0.0462, 0.7822), 1.0, 100.0),
          measured(dielectric("brick", 3.91, 0.0238, 0.16), 1.0, 40.0),
          measured(dielectric("plasterboard", 2.73, 0.0085, 0.9395), 1.0, 100.0),
          measured(dielectric("wood", 1.99, 0.0047, 1.0718), 0.001, 100.0),
          measured(dielectric("glass", 6.31, 0.0036, 1.3394), 0.1, 100.0),
          measured(dielectric("chipboard", 2.58, 0.0217, 0.7800), 1.0, 100.0),
          measured(dielectric("plywood", 2.71, 0.33, 0.0), 1.0, 40.0),
          measured(dielectric("ceiling_board", 1.48, 0.0011, 1.0750), 1.0, 100.0),
          measured(dielectric("marble", 7.074, 0.0055, 0.9262), 1.0, 60.0),
          measured(dielectric("floorboard", 3.66, 0.0044, 1.3515), 50.0, 100.0),
          measured(metal("metal", 1e7), 1.0, 100.0),
          ground("very_dry_ground", 3.0, 0.0, 0.00015, 2.52),
          ground("medium_dry_ground", 15.0, -0.1, 0.035, 1.63),
          ground("wet_ground", 30.0, -0.4, 0.15, 1.30),
          metal("perfect_conductor", 1e30),
          dielectric("person", 55.0, 1.06, 0.0),
          dielectric("air", 1.0, 0.0, 0.0),
          cardboard};
}

}  // namespace

const std::vector<Material>& known_materials() {
  static const std::vector<Material> all = make_materials();
  return all;
}

const Material& find_material(const std::vector<Material>& materials, const std::string& name) {
  const auto found = std::find_if(materials.begin(), materials.end(),
                                  [&](const Material& material) { return material.name == name; });
  if (found != materials.end()) return *found;
  std::vector<std::string> names;
  names.reserve(materials.size());
  for (const Material& material : materials) names.push_back(material.name);
  throw Error(fmt::format("there is no material '{}'{}", name, suggestion(name, names)));
}

void check(const Material& material) {
  require_in_range("permittivity", material.permittivity_a, 1.0, 1e4);
  require_in_range("permittivity's exponent", material.permittivity_b, -10.0, 10.0);
  require_not_negative("conductivity", material.conductivity_c);
  require_in_range("conductivity's exponent", material.conductivity_d, -10.0, 10.0);
  if (material.wall_m) {
    require(*material.wall_m > 0.0 && *material.wall_m <= 10.0, "wall_m",
            "greater than 0, up to 10 m", *material.wall_m);
  }
  if (material.crossing_db) {
    require_in_range("crossing_db", *material.crossing_db, 0.0, 300.0, "dB");
  }
}

std::complex<double> permittivity(const Material& material, double frequency_hz) {
  const double ghz = frequency_hz * 1e-9;
  const double real = material.permittivity_a * std::pow(ghz, material.permittivity_b);
  return {real,
          -conductivity(material, frequency_hz) / (kTwoPi * kVacuumPermittivity * frequency_hz)};
}

double conductivity(const Material& material, double frequency_hz) {
  return material.conductivity_c * std::pow(frequency_hz * 1e-9, material.conductivity_d);
}

bool is_measured_at(const Material& material, double frequency_hz) {
  const double ghz = frequency_hz * 1e-9;
  return ghz >= material.min_ghz && ghz <= material.max_ghz;
}

}  // namespace tagfield
