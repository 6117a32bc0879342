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
  return {name, a, 0.0, c, d, std::nullopt, std::nullopt, false};
}

Material metal(const char* name, double c) {
  return {name, 1.0, 0.0, c, 0.0, std::nullopt, std::nullopt, true};
}

std::vector<Material> make_materials() {
  // Corrugated board is mostly air: an effective permittivity of 1.3 for walls of fluted paper.
  Material cardboard = dielectric("cardboard", 1.3, 0.002, 1.0);
  cardboard.wall_m = kBoxWall;
  return {dielectric("concrete", 5.24, 0.0462, 0.7822),
          dielectric("brick", 3.91, 0.0238, 0.16),
          dielectric("plasterboard", 2.73, 0.0085, 0.9395),
          dielectric("wood", 1.99, 0.0047, 1.0718),
          dielectric("glass", 6.31, 0.0036, 1.3394),
          dielectric("chipboard", 2.58, 0.0217, 0.7800),
          dielectric("plywood", 2.71, 0.33, 0.0),
          dielectric("ceiling_board", 1.48, 0.0011, 1.0750),
          dielectric("marble", 7.074, 0.0055, 0.9262),
          metal("metal", 1e7),
          metal("perfect_conductor", 1e30),
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
  const double conductivity = material.conductivity_c * std::pow(ghz, material.conductivity_d);
  return {real, -conductivity / (kTwoPi * kVacuumPermittivity * frequency_hz)};
}

}  // namespace tagfield
