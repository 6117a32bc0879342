// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/path_gain.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/propagation/trace_paths.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3d;

constexpr double kFrequency = 865.7e6;

RadioWorld floor_of(const std::string& material) {
  Scene scene;
  scene.collisions.push_back({"floor::link::plane", Plane{}, {}});
  RadioWorldOptions options;
  options.rules = {{"floor", find_material(known_materials(), material), {}}};
  Diagnostics diagnostics;
  return radio_world(scene, options, diagnostics);
}

AntennaPattern isotropic(double tilt_rad) {
  AntennaPattern pattern;
  pattern.tilt_rad = tilt_rad;
  return pattern;
}

RigidTransform at(const Vector3d& p_W, double yaw = 0.0) {
  return from_xyz_rpy(p_W, {0.0, 0.0, yaw});
}

/// Sum over the traced paths.
Complex traced(const RadioWorld& world, const AntennaPattern& pattern, const RigidTransform& X_WA,
               const RigidTransform& X_WT, int order, const ChannelEffects& effects = {}) {
  TraceOptions options;
  options.order = order;
  std::vector<RadioPath> paths;
  trace_paths(world.scene, images_of(world.scene, X_WA.translation, options), X_WT.translation,
              options, paths);
  return one_way_gain(paths, {pattern, X_WA}, {pattern, X_WT}, world, carrier_in(world, kFrequency),
                      effects);
}

double db(Complex h) { return 20.0 * std::log10(std::abs(h)); }

/// The two-ray formula over a flat floor, with the reflection coefficient for the grazing angle.
Complex two_ray(double distance, double h1, double h2, Complex coefficient) {
  const double lambda = wavelength(kFrequency);
  const double k = kTwoPi / lambda;
  const double direct = std::hypot(distance, h1 - h2);
  const double mirrored = std::hypot(distance, h1 + h2);
  return lambda / (4.0 * kPi) *
         (std::polar(1.0 / direct, -k * direct) +
          coefficient * std::polar(1.0 / mirrored, -k * mirrored));
}

void expect_same_wave(Complex a, Complex b, const std::string& where) {
  EXPECT_NEAR(db(a), db(b), 1e-6) << where;
  EXPECT_NEAR(std::arg(a / b), 0.0, 1e-6) << where;
}

TEST(FreeSpace, IsFriisWithItsPhaseFrom30CentimetresTo15Metres) {
  const RadioWorld empty = radio_world(Scene{}, {}, *std::make_unique<Diagnostics>());
  const double lambda = wavelength(kFrequency);
  for (double d = 0.3; d <= 15.0; d += 0.0437) {
    for (const double tilt : {0.0, kPi / 2}) {
      // For antennas that face each other, the tilt of one is the mirror image of the other's.
      const AntennaPattern pattern = isotropic(tilt);
      const Complex h = traced(empty, pattern, at({0, 0, 1}), at({d, 0, 1}, 0.0), 0);
      const Complex friis = lambda / (4.0 * kPi * d) * std::polar(1.0, -kTwoPi * d / lambda);
      expect_same_wave(h, friis, std::to_string(d));
      Carrier carrier = carrier_in(empty, kFrequency);
      const RigidTransform here = at({0, 0, 1});
      const RigidTransform there = at({d, 0, 1});
      expect_same_wave(free_space_gain({pattern, here}, {pattern, there}, carrier, {}), friis,
                       std::to_string(d));
    }
  }
}

TEST(TwoRay, OverAFloorIsTheClosedFormInBothPolarizations) {
  for (const char* material : {"perfect_conductor", "concrete"}) {
    const RadioWorld world = floor_of(material);
    const Complex eta = permittivity(find_material(known_materials(), material), kFrequency);
    for (double d = 0.3; d <= 15.0; d += 0.0731) {
      constexpr double kAntenna = 1.5;
      constexpr double kTag = 0.8;
      const double psi = std::atan2(kAntenna + kTag, d);
      const Complex root = std::sqrt(eta - std::cos(psi) * std::cos(psi));
      const Complex vertical = (eta * std::sin(psi) - root) / (eta * std::sin(psi) + root);
      const Complex horizontal = (std::sin(psi) - root) / (std::sin(psi) + root);
      const auto gain_of = [&](double tilt) {
        // Both ends face along +x, so the tag is seen from behind; vertical fields there lie in the
        // plane of incidence like the antenna's.
        return traced(world, isotropic(tilt), at({0, 0, kAntenna}), at({d, 0, kTag}, kPi), 1);
      };
      // Horizontal fields of ends that face each other have opposite directions.
      expect_same_wave(gain_of(0.0), two_ray(d, kAntenna, kTag, vertical),
                       fmt::format("{} vertical {}", material, d));
      expect_same_wave(-gain_of(kPi / 2), two_ray(d, kAntenna, kTag, horizontal),
                       fmt::format("{} horizontal {}", material, d));
    }
  }
}

/// A hall with six walls, seen from inside.
RadioWorld hall(const Vector3d& size, const std::string& material) {
  Scene scene;
  scene.collisions.push_back({"hall", Box{size}, from_translation(0.5 * size)});
  RadioWorldOptions options;
  options.rules = {{"hall", find_material(known_materials(), material), {}}};
  Diagnostics diagnostics;
  return radio_world(scene, options, diagnostics);
}

RC_GTEST_PROP(PathGain, IsReciprocal, ()) {
  const RadioWorld world = hall({6.0, 5.0, 3.0}, "concrete");
  const auto inside = [](double most) {
    return 0.3 + (most - 0.6) * 0.001 * *rc::gen::inRange(0, 1000);
  };
  const auto place = [&] { return Vector3d(inside(6.0), inside(5.0), inside(3.0)); };
  const auto angle = [] { return 0.001 * *rc::gen::inRange(-3000, 3000); };
  const RigidTransform X_WA = from_xyz_rpy(place(), {angle(), angle(), angle()});
  const RigidTransform X_WT = from_xyz_rpy(place(), {angle(), angle(), angle()});
  RC_PRE((X_WA.translation - X_WT.translation).norm() > 0.1);
  AntennaPattern pattern;
  pattern.shape = PatternShape::kPatch;
  pattern.beam_width_rad = pattern.vertical_beam_width_rad = 1.2;
  pattern.polarization = PolarizationKind::kRightCircular;
  const Complex there = traced(world, pattern, X_WA, X_WT, 3);
  const Complex back = traced(world, pattern, X_WT, X_WA, 3);
  RC_ASSERT(std::abs(there - back) < 1e-9 * std::abs(there) + 1e-13);
}

RC_GTEST_PROP(PathGain, NoPathIsStrongerThanTheSameWayThroughFreeSpace, ()) {
  const RadioWorld world =
      hall({6.0, 5.0, 3.0}, *rc::gen::element<std::string>("concrete", "metal", "wood"));
  const auto inside = [](double most) {
    return 0.3 + (most - 0.6) * 0.001 * *rc::gen::inRange(0, 1000);
  };
  const auto place = [&] { return Vector3d(inside(6.0), inside(5.0), inside(3.0)); };
  const RigidTransform X_WA = at(place());
  const RigidTransform X_WT = at(place(), 0.7);
  TraceOptions options;
  options.order = 3;
  std::vector<RadioPath> paths;
  trace_paths(world.scene, images_of(world.scene, X_WA.translation, options), X_WT.translation,
              options, paths);
  const Carrier carrier = carrier_in(world, kFrequency);
  const AntennaPattern pattern = isotropic(0.3);
  for (const RadioPath& path : paths) {
    const Complex h = path_gain(path, {pattern, X_WA}, {pattern, X_WT}, world, carrier, {});
    RC_ASSERT(std::abs(h) <= carrier.lambda_m / (4.0 * kPi * path.length_m) * (1.0 + 1e-9));
  }
}

TEST(PathBudget, AddsUpToTheGain) {
  const RadioWorld world = hall({6.0, 5.0, 3.0}, "concrete");
  const RigidTransform X_WA = at({1.0, 1.0, 1.5}, 0.3);
  const RigidTransform X_WT = at({4.5, 3.5, 0.7}, 2.0);
  TraceOptions options;
  options.order = 3;
  std::vector<RadioPath> paths;
  trace_paths(world.scene, images_of(world.scene, X_WA.translation, options), X_WT.translation,
              options, paths);
  ASSERT_GT(paths.size(), 50U);
  const Carrier carrier = carrier_in(world, kFrequency);
  AntennaPattern antenna = isotropic(0.0);
  antenna.polarization = PolarizationKind::kLeftCircular;
  AntennaPattern dipole = isotropic(0.2);
  dipole.shape = PatternShape::kDipole;
  dipole.gain_dbi = 2.15;
  for (const RadioPath& path : paths) {
    for (const bool polarized : {true, false}) {
      const ChannelEffects effects{true, polarized};
      const PathBudget budget =
          path_budget(path, {antenna, X_WA}, {dipole, X_WT}, world, carrier, effects);
      double sum = budget.spreading_db + budget.antenna_db + budget.tag_db + budget.polarization_db;
      for (const double bounce : budget.bounce_db) sum += bounce;
      for (const double crossing : budget.crossing_db) sum += crossing;
      EXPECT_EQ(budget.bounce_db.size(), static_cast<std::size_t>(path.bounce_count));
      EXPECT_NEAR(
          sum, db(path_gain(path, {antenna, X_WA}, {dipole, X_WT}, world, carrier, effects)), 1e-6);
    }
  }
}

TEST(PathGain, LosesASlabsTransmissionWhereItCrosses) {
  Scene scene;
  scene.collisions.push_back({"wall", Box{{0.1, 20.0, 20.0}}, from_translation({2.0, 0.0, 0.0})});
  RadioWorldOptions options;
  options.rules = {{"wall", find_material(known_materials(), "brick"), {}}};
  Diagnostics diagnostics;
  const RadioWorld world = radio_world(scene, options, diagnostics);
  const Carrier carrier = carrier_in(world, kFrequency);
  const Complex eta = permittivity(find_material(known_materials(), "brick"), kFrequency);
  const Complex behind = traced(world, isotropic(0.0), at({0, 0, 0}), at({4.0, 0.0, 0.0}), 0);
  const Complex free =
      carrier.lambda_m / (4.0 * kPi * 4.0) * std::polar(1.0, -carrier.wave_number * 4.0);
  // A slab at normal incidence, by the matrices of its two faces and of the path between them.
  const double thickness = 0.1;
  const Complex n = std::sqrt(eta);
  const Complex q = carrier.wave_number * thickness * n;
  const Complex slab = 1.0 / (std::cos(q) + Complex(0.0, 0.5) * (n + 1.0 / n) * std::sin(q));
  const Complex expected = free * slab * std::polar(1.0, carrier.wave_number * thickness);
  EXPECT_LT(std::abs(behind - expected), 1e-6 * std::abs(expected));
}

}  // namespace
}  // namespace tagfield
