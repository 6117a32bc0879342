// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/diffracted_gain.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <memory>

#include "tagfield/base/units.h"
#include "tagfield/propagation/trace_paths.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3d;

constexpr double kEdgeFrequency = 865.7e6;

AntennaPattern without_pattern(double tilt_rad) {
  AntennaPattern pattern;
  pattern.tilt_rad = tilt_rad;
  return pattern;
}

Material known(const std::string& name) { return find_material(known_materials(), name); }

RadioWorld world_of(const Shape& shape, const RigidTransform& X_WC, const Material& material) {
  Scene scene;
  scene.collisions.push_back({"thing::link::c", shape, X_WC});
  RadioWorldOptions options;
  options.rules = {{"thing", material, {}}};
  Diagnostics diagnostics;
  return radio_world(scene, options, diagnostics);
}

/// A sheet in the plane x = 0 with its border along z at y = 0.
MeshPtr half_plane(double half) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, -half}, {0, 0, half}, {0, -half, half}, {0, -half, -half}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return std::make_shared<const TriangleMesh>(mesh);
}

struct Field {
  Complex optics;
  Complex bent;
  [[nodiscard]] Complex all() const { return optics + bent; }
};

Field field_at(const RadioWorld& world, const RadioEnd& antenna, const RadioEnd& tag, int order = 1,
               const ChannelEffects& effects = {}) {
  TraceOptions options;
  options.order = order;
  std::vector<RadioPath> paths;
  const Vector3d& p_WA = antenna.X_WA.translation;
  const Vector3d& p_WT = tag.X_WA.translation;
  trace_paths(world.scene, images_of(world.scene, p_WA, options), p_WT, options, paths);
  const Carrier carrier = carrier_in(world, kEdgeFrequency);
  Field field{one_way_gain(paths, antenna, tag, world, carrier, effects), 0.0};
  std::vector<DiffractedPath> over;
  trace_diffracted(world.scene, world.edges(), p_WA, p_WT, options, over);
  for (const DiffractedPath& path : over) {
    field.bent += diffracted_gain(path, world.edges(), antenna, tag, world, carrier, effects,
                                  {true, order > 0});
  }
  return field;
}

RigidTransform placed(const Vector3d& p_W) { return {Eigen::Quaterniond::Identity(), p_W}; }

/// Exact knife-edge diffraction of Recommendation ITU-R P.526: |(1 + j)/2 ∫_ν^∞ e^{−jπt²/2} dt|.
double knife_edge_db(double nu) {
  constexpr int kSteps = 40000;
  constexpr double kEnd = 10.0;  // Along t = ν + s e^{−jπ/4} the integrand just decays.
  const auto f = [&](double s) {
    const Complex t = nu + s * std::polar(1.0, -0.25 * kPi);
    return std::exp(Complex(0.0, -0.5 * kPi) * t * t) * std::polar(1.0, -0.25 * kPi);
  };
  Complex sum = f(0.0) + f(kEnd);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(i * kEnd / kSteps);
  return 20.0 * std::log10(std::abs(Complex(0.5, 0.5) * sum * (kEnd / kSteps / 3.0)));
}

TEST(DiffractedGain, BehindAScreenIsTheKnifeEdges) {
  const RadioWorld world = world_of(half_plane(2000.0), {}, known("perfect_conductor"));
  ASSERT_EQ(world.edges().size(), 4U);
  // Distant ends, so that angles are small, where the knife-edge formula holds.
  const double far = 60.0;
  const double lambda = wavelength(kEdgeFrequency);
  for (const double depth : {0.0, 0.5, 1.0, 2.0, 4.0}) {
    std::vector<double> bent;
    for (const double tilt : {0.0, 0.5 * kPi}) {
      const AntennaPattern pattern = without_pattern(tilt);
      const RigidTransform X_WA = placed({-far, -depth - 1e-6, 0});
      const RigidTransform X_WT = placed({far, -depth - 1e-6, 0});
      const Field field = field_at(world, {pattern, X_WA}, {pattern, X_WT});
      EXPECT_EQ(field.optics, Complex(0.0)) << depth;
      const double free = lambda / (4.0 * kPi * 2.0 * far);
      bent.push_back(20.0 * std::log10(std::abs(field.bent) / free));
    }
    // The knife-edge formula ignores polarization; a screen is as much above it in one polarization
    // as below in the other.
    const double nu = depth * std::sqrt(2.0 / lambda * (2.0 / far));
    EXPECT_NEAR(0.5 * (bent[0] + bent[1]), knife_edge_db(nu), 0.02 + 0.02 * nu) << depth;
    EXPECT_NEAR(bent[0], bent[1], 0.25 + 0.6 * nu) << depth;
  }
}

/// Maximum change of the field between consecutive positions of the tag on a circle around the
/// edge, relative to the free-space field.
double greatest_jump(const RadioWorld& world, const AntennaPattern& pattern, const Vector3d& p_WA,
                     double around_rad, double z, double from, double to, int steps, int order,
                     const ChannelEffects& effects) {
  const double free = wavelength(kEdgeFrequency) / (4.0 * kPi * p_WA.norm());
  Complex before;
  double most = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    const RigidTransform X_WT =
        placed({around_rad * std::cos(angle), around_rad * std::sin(angle), z});
    const Complex now =
        field_at(world, {pattern, placed(p_WA)}, {pattern, X_WT}, order, effects).all();
    if (i > 0) most = std::max(most, std::abs(now - before) / free);
    before = now;
  }
  return most;
}

struct EdgeCase {
  const char* what;
  Shape shape;
  RigidTransform X_WC;
  Material material;
  double from;  ///< Range of the tag's angles: free space.
  double to;
  int order;
  double antenna;  ///< Its angle.
};

std::vector<EdgeCase> edge_cases() {
  // The box's edge is along z at x = y = 0; the box is where x < 0 and y < 0.
  const Shape box = Box{{40.0, 40.0, 60.0}};
  const RigidTransform at_edge = placed({-20.0, -20.0, 0.0});
  Material walls = known("concrete");
  walls.wall_m = 0.05;
  Material stated = known("wood");
  stated.crossing_db = 7.0;
  const double down = -0.5 * kPi;
  const auto sheet = half_plane(30.0);
  return {
      {"metal sheet", sheet, {}, known("metal"), down + 0.02, 1.5 * kPi - 0.02, 1, 2.6},
      {"metal sheet, no mirrors", sheet, {}, known("metal"), down + 0.02, 1.5 * kPi - 0.02, 0, 2.6},
      {"concrete sheet", sheet, {}, known("concrete"), down + 0.02, 1.5 * kPi - 0.02, 1, 2.6},
      {"metal box", box, at_edge, known("metal"), down + 0.02, kPi - 0.02, 1, 2.6},
      {"metal box, both faces lit", box, at_edge, known("metal"), down + 0.02, kPi - 0.02, 1, 0.9},
      {"concrete box", box, at_edge, known("concrete"), down + 0.02, kPi - 0.02, 1, 2.6},
      {"hollow box", box, at_edge, walls, down + 0.02, kPi - 0.02, 1, 2.6},
      {"box with a stated loss", box, at_edge, stated, down + 0.02, kPi - 0.02, 1, 2.6}};
}

TEST(DiffractedGain, LeavesNoStepAtAnyBoundary) {
  for (const EdgeCase& test : edge_cases()) {
    const RadioWorld world = world_of(test.shape, test.X_WC, test.material);
    for (const double z : {0.0, 3.0}) {
      for (const auto& [tilt, polarization] :
           {std::pair(0.0, true), std::pair(0.35 * kPi, true), std::pair(0.35 * kPi, false)}) {
        const Vector3d p_WA(4.0 * std::cos(test.antenna), 4.0 * std::sin(test.antenna), 0.0);
        EXPECT_LT(greatest_jump(world, without_pattern(tilt), p_WA, 1.0, z, test.from, test.to,
                                8000, test.order, {true, polarization}),
                  0.04)
            << test.what << " z " << z << " tilt " << tilt << " " << polarization;
      }
    }
  }
}

TEST(DiffractedGain, FillsStepsThatOpticsHas) {
  // The test above would detect them: at the shadow boundary and at the reflection boundary.
  const RadioWorld world = world_of(half_plane(30.0), {}, known("metal"));
  const AntennaPattern pattern = without_pattern(0.0);
  const RigidTransform X_WA = placed({-4.0, 2.0, 0.0});
  const auto optics = [&](double angle) {
    const RigidTransform X_WT = placed({std::cos(angle), std::sin(angle), 0.0});
    return field_at(world, {pattern, X_WA}, {pattern, X_WT}).optics;
  };
  const double free = wavelength(kEdgeFrequency) / (4.0 * kPi * X_WA.translation.norm());
  for (const double boundary : {std::atan2(-2.0, 4.0), std::atan2(-2.0, -4.0)}) {
    EXPECT_GT(std::abs(optics(boundary + 1e-3) - optics(boundary - 1e-3)) / free, 0.5) << boundary;
  }
}

TEST(DiffractedGain, LosesOnEitherLegWhatItCrosses) {
  // A screen's edge, with walls of a given loss before it, behind it, or both.
  Material wall = known("wood");
  wall.crossing_db = 6.0;
  const auto bent = [&](bool before, bool behind) {
    Scene scene;
    scene.collisions.push_back({"screen::link::c", half_plane(30.0), {}});
    const Box sheet{{0.02, 20.0, 20.0}};
    if (before) scene.collisions.push_back({"wall::link::a", sheet, placed({-2.0, 0.0, 0.0})});
    if (behind) scene.collisions.push_back({"wall::link::b", sheet, placed({2.0, 0.0, 0.0})});
    RadioWorldOptions options;
    options.rules = {{"screen", known("metal"), {}}, {"wall", wall, {}}};
    Diagnostics diagnostics;
    const RadioWorld world = radio_world(scene, options, diagnostics);
    const RigidTransform X_WA = placed({-4.0, -1.0, 0.0});
    const RigidTransform X_WT = placed({4.0, -1.0, 0.0});
    const Carrier carrier = carrier_in(world, kEdgeFrequency);
    std::vector<DiffractedPath> over;
    TraceOptions trace;
    trace_diffracted(world.scene, world.edges(), X_WA.translation, X_WT.translation, trace, over);
    // Only paths over the screen's edge, not over those of the walls.
    Complex sum{};
    for (const DiffractedPath& path : over) {
      if (std::abs(path.p_W.x()) > 0.1 || std::abs(path.p_W.y()) > 0.1) continue;
      sum += diffracted_gain(path, world.edges(), {without_pattern(0.0), X_WA},
                             {without_pattern(0.0), X_WT}, world, carrier, {}, {true, false});
    }
    return std::abs(sum);
  };
  const double open = bent(false, false);
  ASSERT_GT(open, 0.0);
  const double lost = std::pow(10.0, -6.0 / 20.0);
  EXPECT_NEAR(bent(true, false) / open, lost, 1e-6);
  EXPECT_NEAR(bent(false, true) / open, lost, 1e-6);
  EXPECT_NEAR(bent(true, true) / open, lost * lost, 1e-6);
}

RC_GTEST_PROP(DiffractedGain, IsTheSameFromBothEnds, ()) {
  const auto number = [](double from, double to) {
    return from + (to - from) * *rc::gen::inRange(0, 1000001) * 1e-6;
  };
  // Not for hollow objects, whose walls are evaluated at the angle of entry.
  const char* const names[] = {"metal", "concrete", "wood"};
  const Material material = known(names[*rc::gen::inRange(0, 3)]);
  const RadioWorld world =
      world_of(Box{{2.0, 3.0, 4.0}}, from_xyz_rpy({0, 0, 0}, {0.3, 0.2, 0.1}), material);
  const auto place = [&] {
    const Vector3d p(number(-6, 6), number(-6, 6), number(-6, 6));
    RC_PRE(p.norm() > 3.0);
    return from_xyz_rpy(p, {number(0, 6), number(0, 6), number(0, 6)});
  };
  const AntennaPattern pattern = without_pattern(number(0, 3));
  const RigidTransform X_WA = place();
  const RigidTransform X_WT = place();
  const Complex there = field_at(world, {pattern, X_WA}, {pattern, X_WT}).bent;
  const Complex back = field_at(world, {pattern, X_WT}, {pattern, X_WA}).bent;
  RC_ASSERT(std::abs(there - back) <= 1e-6 * std::abs(there) + 1e-10);
}

}  // namespace
}  // namespace tagfield
