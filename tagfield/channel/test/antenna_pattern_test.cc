// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/antenna_pattern.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

AntennaPattern patch(double gain_dbi, double horizontal_deg, double vertical_deg) {
  AntennaPattern pattern;
  pattern.shape = PatternShape::kPatch;
  pattern.gain_dbi = gain_dbi;
  pattern.beam_width_rad = radians(horizontal_deg);
  pattern.vertical_beam_width_rad = radians(vertical_deg);
  return pattern;
}

AntennaPattern dipole() {
  AntennaPattern pattern;
  pattern.shape = PatternShape::kDipole;
  pattern.gain_dbi = 2.15;
  return pattern;
}

Vector3d in_azimuth(double deg) { return {std::cos(radians(deg)), std::sin(radians(deg)), 0.0}; }
Vector3d in_elevation(double deg) { return {std::cos(radians(deg)), 0.0, std::sin(radians(deg))}; }
double db(double power) { return 10.0 * std::log10(power); }

TEST(PatchGain, FallsByHalfAtHalfOfItsWidths) {
  const AntennaPattern pattern = patch(8.0, 70.0, 60.0);
  EXPECT_NEAR(db(gain(pattern, Vector3d::UnitX())), 8.0, 1e-12);
  EXPECT_NEAR(db(gain(pattern, in_azimuth(35.0))), 8.0 - 3.0103, 1e-3);
  EXPECT_NEAR(db(gain(pattern, in_azimuth(-35.0))), 8.0 - 3.0103, 1e-3);
  EXPECT_NEAR(db(gain(pattern, in_elevation(30.0))), 8.0 - 3.0103, 1e-3);
  EXPECT_NEAR(db(gain(pattern, -Vector3d::UnitX())), 8.0 - 20.0, 1e-12);
}

TEST(DipoleGain, IsTheHalfWaveDipoles) {
  EXPECT_NEAR(db(gain(dipole(), Vector3d::UnitX())), 2.15, 1e-12);
  EXPECT_EQ(gain(dipole(), Vector3d::UnitZ()), 0.0);
  // cos(½π cos 60°)/sin 60° = 0.81650.
  EXPECT_NEAR(gain(dipole(), in_elevation(30.0)) / gain(dipole(), Vector3d::UnitX()),
              0.81650 * 0.81650, 1e-5);
}

TEST(Directivity, OfAHalfWaveDipoleIsTheTextbooks) {
  EXPECT_NEAR(directivity_dbi(dipole()), 2.15, 0.01);
}

TEST(Directivity, OfACosineLobeIsTwiceExponentAndOne) {
  // Over half the sphere: 4π/(2π/(n + 1)).
  AntennaPattern pattern = patch(0.0, 65.0, 65.0);
  pattern.front_to_back_db = 100.0;
  const double n = std::log(0.5) / std::log(std::cos(radians(32.5)));
  EXPECT_NEAR(directivity_dbi(pattern), db(2.0 * (n + 1.0)), 0.01);
}

TEST(TableGain, IsItsRowsAndBetweenThemStraight) {
  AntennaPattern pattern;
  pattern.shape = PatternShape::kTable;
  pattern.table = {{0.0, 8.0, 8.0}, {radians(90.0), -4.0, -10.0}, {kPi, -20.0, -20.0}};
  EXPECT_NEAR(db(gain(pattern, Vector3d::UnitX())), 8.0, 1e-9);
  EXPECT_NEAR(db(gain(pattern, in_azimuth(45.0))), 2.0, 1e-9);
  EXPECT_NEAR(db(gain(pattern, in_elevation(45.0))), -1.0, 1e-9);
  EXPECT_NEAR(db(gain(pattern, -Vector3d::UnitX())), -20.0, 1e-9);
  EXPECT_NEAR(db(peak_gain(pattern)), 8.0, 1e-9);
}

TEST(CheckPattern, WarnsOfAGainThatTheLobeCannotHave) {
  Diagnostics diagnostics;
  check(patch(8.0, 65.0, 65.0), diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  check(patch(14.0, 65.0, 65.0), diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(diagnostics.warnings()[0].find("a gain of 14.0 dBi is more than the"),
            std::string::npos);
}

TEST(CheckPattern, NamesWhatIsOutOfRange) {
  Diagnostics diagnostics;
  EXPECT_THROW(check(patch(8.0, 0.0, 65.0), diagnostics), Error);
  EXPECT_THROW(check(patch(80.0, 65.0, 65.0), diagnostics), Error);
  EXPECT_THROW(check(patch(std::nan(""), 65.0, 65.0), diagnostics), Error);
  AntennaPattern table;
  table.shape = PatternShape::kTable;
  table.table = {{1.0, 0.0, 0.0}, {0.5, 0.0, 0.0}};
  EXPECT_THROW(check(table, diagnostics), Error);
}

std::complex<double> dot(const Eigen::Vector3cd& a, const Eigen::Vector3cd& b) {
  return (a.array() * b.array()).sum();
}

/// The coupling of an antenna that faces along x with one that faces back, rotated by `roll` about
/// that axis.
std::complex<double> face_to_face(const AntennaPattern& a, const AntennaPattern& b, double roll) {
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(roll, Vector3d::UnitX()) * Eigen::AngleAxisd(kPi, Vector3d::UnitZ()))
          .toRotationMatrix();
  return dot(field_direction(a, Vector3d::UnitX()), R * field_direction(b, Vector3d::UnitX()));
}

TEST(Polarization, LinearToLinearGoesWithTheCosine) {
  AntennaPattern linear;
  for (const double angle : {0.0, 0.3, 1.0, kPi / 2}) {
    EXPECT_NEAR(std::norm(face_to_face(linear, linear, angle)), std::cos(angle) * std::cos(angle),
                1e-12);
  }
}

TEST(Polarization, CircularToLinearIsHalfAtAnyAngle) {
  AntennaPattern linear;
  AntennaPattern circular;
  circular.polarization = PolarizationKind::kRightCircular;
  for (const double angle : {0.0, 0.3, 1.0, kPi / 2}) {
    EXPECT_NEAR(std::norm(face_to_face(circular, linear, angle)), 0.5, 1e-12);
  }
}

TEST(Polarization, SameHandsFitAndOtherHandsDoNot) {
  AntennaPattern right;
  right.polarization = PolarizationKind::kRightCircular;
  AntennaPattern left;
  left.polarization = PolarizationKind::kLeftCircular;
  EXPECT_NEAR(std::norm(face_to_face(right, right, 0.7)), 1.0, 1e-12);
  EXPECT_NEAR(std::norm(face_to_face(left, left, 0.7)), 1.0, 1e-12);
  EXPECT_NEAR(std::norm(face_to_face(right, left, 0.7)), 0.0, 1e-12);
}

TEST(Polarization, OfCrossedWiresIsLinearAtTheSideAndOfTheOtherHandBehind) {
  AntennaPattern right;
  right.polarization = PolarizationKind::kRightCircular;
  const Eigen::Vector3cd side = field_direction(right, Vector3d::UnitY());
  EXPECT_NEAR(std::abs(side.z()), 1.0, 1e-12);
  // Behind, seen along the direction of propagation, the field of the same wires rotates in the
  // opposite sense.
  const Eigen::Vector3cd front = field_direction(right, Vector3d::UnitX());
  const Eigen::Vector3cd back = field_direction(right, -Vector3d::UnitX());
  EXPECT_NEAR((front - back).norm(), 0.0, 1e-12);
}

TEST(Polarization, RightHandTurnsClockwiseForWhomItLeaves) {
  // IEEE 145: seen along the direction of propagation, the field rotates clockwise in time. Along
  // x, with y to the left and z up, clockwise is from z (up) to −y (right).
  AntennaPattern right;
  right.polarization = PolarizationKind::kRightCircular;
  const Eigen::Vector3cd e = field_direction(right, Vector3d::UnitX());
  const auto at = [&](double phase) { return Vector3d((e * std::polar(1.0, phase)).real()); };
  const double to_up = std::arg(std::conj(e.z()));
  EXPECT_GT(at(to_up).z(), 0.7);
  EXPECT_LT(at(to_up + kPi / 2).y(), -0.7);
}

RC_GTEST_PROP(FieldDirection, IsAUnitVectorAcrossTheWay, ()) {
  const double z = 0.001 * *rc::gen::inRange(-1000, 1001);
  const double around = 0.001 * *rc::gen::inRange(0, 6284);
  const double radius = std::sqrt(1.0 - z * z);
  const Vector3d u(radius * std::cos(around), radius * std::sin(around), z);
  for (const auto kind : {PolarizationKind::kLinear, PolarizationKind::kRightCircular}) {
    for (const auto shape : {PatternShape::kPatch, PatternShape::kDipole}) {
      AntennaPattern pattern = patch(6.0, 80.0, 80.0);
      pattern.shape = shape;
      pattern.polarization = kind;
      pattern.tilt_rad = 0.4;
      const Eigen::Vector3cd e = field_direction(pattern, u);
      RC_ASSERT(std::abs(e.norm() - 1.0) < 1e-9);
      RC_ASSERT(std::abs(dot(e, u.cast<std::complex<double>>())) < 1e-9);
    }
  }
}

}  // namespace
}  // namespace tagfield
