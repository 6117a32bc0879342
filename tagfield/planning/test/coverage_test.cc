// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/planning/internal/tag_coverage.h"
#include "tagfield/planning/moment.h"
#include "tagfield/planning/test/radio_hall.h"
#include "tagfield/simulator/robot.h"

namespace tagfield {
namespace {

CoverageRequest request_for(const Scenario& scenario, const Eigen::AlignedBox2d& region,
                            double step_m) {
  CoverageRequest request;
  for (std::size_t i = 0; i < scenario.antennas.size(); ++i) request.antennas.push_back(i);
  request.tag = isotropic_tag();
  request.heights_m = {1.0};
  request.grid = grid_over(region, step_m);
  return request;
}

Coverage covered(const Scenario& scenario, const Eigen::AlignedBox2d& region, double step_m = 0.1) {
  return cover(scenario, sample_drive(scenario, 1, std::nullopt),
               request_for(scenario, region, step_m));
}

const Eigen::AlignedBox2d kAround(Eigen::Vector2d(-8.0, -8.0), Eigen::Vector2d(8.0, 8.0));

Scenario one_gate() {
  return hall_with(physical_antenna("gate", {0.0, 0.0, 1.0}, isotropic_model()),
                   physical_tag("near", {1.0, 0.0, 1.0}));
}

const CoverageCell& cell_at(const Coverage& coverage, double x, double y) {
  const CoverageGrid& grid = coverage.grid;
  const auto column = static_cast<std::size_t>((x - grid.corner_m.x()) / grid.step_m);
  const auto row = static_cast<std::size_t>((y - grid.corner_m.y()) / grid.step_m);
  return coverage.layers.front().cells[row * grid.columns + column];
}

TEST(Coverage, OfAnIsotropicAntennaIsACircleOfFriissRadius) {
  const Coverage coverage = covered(one_gate(), kAround);
  // From 30 dBm down to −18 dBm.
  const double radius_m =
      kSpeedOfLight / kTestCarrier_hz / (4.0 * kPi) * std::pow(10.0, 48.0 / 20.0);
  ASSERT_NEAR(radius_m, 6.92, 0.01);
  const CoverageLayer& layer = coverage.layers.front();
  for (std::size_t i = 0; i < layer.cells.size(); ++i) {
    const double distance_m =
        coverage.grid.middle(i % coverage.grid.columns, i / coverage.grid.columns).norm();
    EXPECT_EQ(layer.cells[i].probability, distance_m <= radius_m ? 1.0 : 0.0) << distance_m;
    EXPECT_NEAR(layer.cells[i].power_dbm, 30.0 + friis_db(distance_m), 1e-6);
    EXPECT_NEAR(layer.cells[i].margin_db, 48.0 + friis_db(distance_m), 1e-6);
  }
  EXPECT_NEAR(share_read(layer), kPi * radius_m * radius_m / 256.0, 0.005);
}

TEST(Coverage, HasAShadowBehindMetal) {
  Scenario scenario = one_gate();
  add_box(scenario, "metal", {2.0, 0.0, 1.0}, {0.2, 1.0, 2.0});
  const Coverage coverage = covered(scenario, kAround, 0.2);
  EXPECT_LT(cell_at(coverage, 4.0, 0.0).power_dbm, kMinPower_db);
  EXPECT_EQ(cell_at(coverage, 4.0, 0.0).antenna, -1);
  EXPECT_EQ(cell_at(coverage, -4.0, 0.0).probability, 1.0);
  // At x = 4.1 the edge of the shadow is at y = 0.5·4.1/1.9 = 1.08 to 1.14, by the front or the
  // back corners.
  EXPECT_EQ(cell_at(coverage, 4.1, 0.9).probability, 0.0);
  EXPECT_EQ(cell_at(coverage, 4.1, 1.3).probability, 1.0);
}

TEST(Coverage, IsTheSameForAnyNumberOfThreads) {
  Scenario scenario = one_gate();
  RadioModel model = isotropic_model();
  model.effects.reflections = true;
  model.reflection_order = 1;
  model.diffuse_k_db = 6.0;
  scenario.antennas.push_back(physical_antenna("other", {3.0, 2.0, 1.5}, model));
  add_box(scenario, "wood", {2.0, 0.0, 1.0}, {0.2, 1.0, 2.0});
  CoverageRequest request = request_for(scenario, kAround, 0.5);
  const std::vector<DriveSample> samples = sample_drive(scenario, 1, std::nullopt);
  const Coverage alone = cover(scenario, samples, request);
  request.threads = 4;
  const Coverage together = cover(scenario, samples, request);
  EXPECT_EQ(coverage_to_csv(alone, alone.layers.front()),
            coverage_to_csv(together, together.layers.front()));
  EXPECT_EQ(coverage_to_json(alone), coverage_to_json(together));
}

TEST(Coverage, OfThePapersModelHalvesAtTheRange) {
  Scenario scenario = one_gate();
  AntennaParameters& parameters = scenario.antennas.front().parameters;
  parameters.model = PaperAntenna{};
  paper(parameters).range_m = 5.05;
  const Coverage coverage = covered(scenario, kAround);
  // The centre of a cell is at 5.05, 0.05 m.
  EXPECT_NEAR(cell_at(coverage, 5.05, 0.05).probability, 0.5, 0.01);
  EXPECT_NEAR(cell_at(coverage, 5.05, 0.05).margin_db, 0.0, 0.01);
  EXPECT_GT(cell_at(coverage, 3.05, 0.05).probability, 0.999);
}

TEST(Coverage, TellsWhoReadsTheTags) {
  Scenario scenario = hall_with(physical_antenna("west", {-5.0, 0.0, 1.0}, isotropic_model()),
                                physical_tag("own", {-11.0, 0.0, 1.0}));
  RadioModel weak = isotropic_model();
  weak.transmit_power_dbm = 10.0;
  scenario.antennas.push_back(physical_antenna("east", {0.0, 0.0, 1.0}, weak));
  scenario.tags.push_back(physical_tag("both", {-0.3, 0.0, 1.0}));
  scenario.tags.push_back(physical_tag("wrong", {-2.0, 0.0, 1.0}));
  scenario.tags.push_back(physical_tag("never", {30.0, 0.0, 1.0}));
  const Coverage coverage = covered(scenario, kAround, 2.0);
  // "east" reaches 0.69 m and "west" 6.92 m, by Friis.
  ASSERT_EQ(coverage.tags.size(), 4U);
  EXPECT_EQ(coverage.tags[0].verdict, TagVerdict::kIntended);
  EXPECT_EQ(coverage.tags[1].verdict, TagVerdict::kAlsoOther);
  EXPECT_EQ(coverage.tags[1].nearest, 1);
  ASSERT_EQ(coverage.tags[1].readers.size(), 2U);
  EXPECT_EQ(coverage.tags[1].meant_for, (std::vector<std::string>{"east"}));
  EXPECT_NEAR(coverage.expected_read.mean, 3.0, 1e-12);
  EXPECT_EQ(coverage.tags[2].verdict, TagVerdict::kWrong);
  EXPECT_EQ(coverage.tags[2].nearest, 1);
  EXPECT_NEAR(coverage.tags[2].nearest_m, 2.0, 1e-9);
  EXPECT_EQ(coverage.tags[3].verdict, TagVerdict::kNever);
}

/// As stock parked before a door: whoever reads it reads too far.
TEST(Coverage, AZoneWithoutReadersIsMeantForNone) {
  Scenario scenario = hall_with(physical_antenna("door", {0.0, 0.0, 1.0}, isotropic_model()),
                                physical_tag("parked", {2.0, 0.0, 1.0}));
  scenario.tags.push_back(physical_tag("outside", {0.0, 2.0, 1.0}));
  scenario.zones = {
      {"parked",
       Eigen::AlignedBox3d(Eigen::Vector3d(1.0, -1.0, 0.0), Eigen::Vector3d(3.0, 1.0, 2.0)),
       {},
       {}}};
  const Coverage coverage = covered(scenario, kAround, 2.0);
  ASSERT_EQ(coverage.tags.size(), 2U);
  EXPECT_EQ(coverage.tags[0].verdict, TagVerdict::kWrong);
  ASSERT_EQ(coverage.tags[0].readers.size(), 1U);
  EXPECT_FALSE(coverage.tags[0].readers[0].is_meant);
  EXPECT_EQ(coverage.tags[1].verdict, TagVerdict::kIntended);
}

TEST(Coverage, LooksFromAllPlacesOfADrive) {
  Scenario scenario = one_gate();
  scenario.duration_s.reset();
  RobotSpec robot;
  robot.name = "cart";
  robot.start = {-6.0, 0.0, 0.0};
  robot.waypoints = {{6.0, 0.0}};
  scenario.robots = {robot};
  scenario.antennas.front().on = "cart";
  const std::vector<DriveSample> samples = sample_drive(scenario, 1, std::nullopt);
  const std::vector<std::size_t> places = places_of(samples, 0);
  // 12 m in steps of 0.25 m or, at 15 Hz, slightly more.
  EXPECT_GE(places.size(), 40U);
  EXPECT_LE(places.size(), 50U);
  const Eigen::AlignedBox2d region(Eigen::Vector2d(-8.0, -8.0), Eigen::Vector2d(8.0, 8.0));
  const Coverage coverage = cover(scenario, samples, request_for(scenario, region, 0.5));
  // The antenna passes the cell at the same x: the least distance is that in y.
  EXPECT_NEAR(cell_at(coverage, 2.1, 4.1).power_dbm, 30.0 + friis_db(4.25), 0.05);
  EXPECT_EQ(cell_at(coverage, -4.1, 6.6).probability, 1.0);
  const std::vector<DriveSample> moment = sample_drive(scenario, 1, time_from_seconds(1.0));
  ASSERT_EQ(moment.size(), 1U);
  EXPECT_LT(moment.front().X_WA.front().translation.x(), -5.0);
}

TEST(Coverage, RefusesWhatCannotBe) {
  EXPECT_THROW(grid_over(kAround, 1e-4), Error);
  EXPECT_THROW(sample_drive(one_gate(), 1, time_from_seconds(100.0)), Error);
}

TEST(LocalLink, OfASingleWayIsTheLinkItself) {
  const RadioModel model = isotropic_model();
  Diagnostics unheard;
  const RadioWorld world = radio_world(Scene{}, {}, unheard);
  const RadioView view =
      view_from(model, world, from_translation({0.0, 0.0, 1.0}), kTestCarrier_hz, 1, 1);
  const auto kind = isotropic_tag();
  const TagEnd tag{*kind, from_translation({2.0, 3.0, 1.5}), 7};
  std::vector<RadioPath> paths;
  const RadioLink link = link_of(view, tag, paths);
  const LocalLink local = local_link(view, tag, {kTestCarrier_hz}, 0, paths);
  EXPECT_NEAR(local.tag_dbm, link.tag_dbm, 1e-9);
  EXPECT_NEAR(local.reply_dbm, link.reply_dbm, 1e-9);
  EXPECT_EQ(local.probability, 1.0);
}

TEST(LocalLink, PlacesAQuarterWavelengthApartAverageAStandingWave) {
  // A metal wall perpendicular to the path reflects everything: 1 + a − 2√a cos(2kx) has the mean 1
  // + a over x. At x ± λ/4, cos(2kx) has the opposite sign, so two positions in three weigh against
  // one.
  RadioModel model = isotropic_model();
  model.effects.reflections = true;
  model.reflection_order = 1;
  Scenario scenario = hall_with(physical_antenna("gate", {0.0, 0.0, 0.0}, model),
                                physical_tag("tag", {50.0, 0.0, 0.0}));
  add_box(scenario, "perfect_conductor", {60.0, 0.0, 0.0}, {1.0, 40.0, 40.0});
  const RadioView view = view_from(model, *scenario.radio_world, from_translation({0.0, 0.0, 0.0}),
                                   kTestCarrier_hz, 1, 1);
  const double lambda = kSpeedOfLight / kTestCarrier_hz;
  const auto kind = isotropic_tag();
  std::vector<RadioPath> paths;
  double least = 1e9;
  double most = -1e9;
  for (int i = 0; i < 8; ++i) {
    const TagEnd tag{*kind, from_translation({50.0 + i * lambda / 16.0, 0.0, 0.0}), 7};
    const LocalLink local = local_link(view, tag, {kTestCarrier_hz}, 0, paths);
    const double level = std::pow(10.0, (local.tag_dbm - 30.0 - friis_db(50.0)) / 10.0);
    least = std::min(least, level);
    most = std::max(most, level);
  }
  // a = (50/69)², and a third of the standing wave remains: 1 + a ± 2√a/3.
  const double a = std::pow(50.0 / 69.0, 2);
  EXPECT_NEAR(least, 1.0 + a - 2.0 * std::sqrt(a) / 3.0, 0.06);
  EXPECT_NEAR(most, 1.0 + a + 2.0 * std::sqrt(a) / 3.0, 0.06);
}

TEST(Coverage, EffectsThatItLeavesOutAreNamed) {
  const auto warnings = [](const RadioModel& model, const std::string& other_reader) {
    Scenario scenario = hall_with(physical_antenna("a", {0.0, 0.0, 1.0}, model),
                                  physical_tag("t", {2.0, 0.0, 1.0}));
    scenario.tags.push_back(physical_tag("u", {2.0, 0.02, 1.0}));
    AntennaSpec other = physical_antenna("b", {5.0, 0.0, 1.0}, model);
    other.parameters.reader = other_reader;
    scenario.antennas.push_back(other);
    Diagnostics diagnostics;
    warn_of_effects_left_out(scenario, diagnostics);
    return diagnostics.warnings();
  };
  RadioModel model = isotropic_model();
  const std::string own = physical_antenna("a", {}, model).parameters.reader;
  EXPECT_TRUE(warnings(model, "other").empty());
  model.interference = model.effects.interference = true;
  EXPECT_TRUE(warnings(model, own).empty());
  model.tag_coupling = model.effects.coupling = true;
  model.effects.inventory = true;
  model.gen2.emplace();
  model.gen2->inventory.capture_db = 3.0;
  ASSERT_EQ(warnings(model, "other").size(), 1U);
  const std::string said = warnings(model, "other").front();
  for (const char* const effect : {"interference", "coupling", "capture_db"}) {
    EXPECT_NE(said.find(effect), std::string::npos) << said;
  }
}

TEST(Moment, PlansLaserDrivenRobotsOverTheirGoals) {
  Scenario scenario = one_gate();
  scenario.duration_s.reset();
  scenario.pose.source = PoseSource::kSlam;
  RobotSpec robot;
  robot.name = "cart";
  robot.goals_W = {{2.0, 0.0, 0.0}};
  scenario.robots = {robot};
  Diagnostics diagnostics;
  const Scenario planned = as_planned(scenario, diagnostics);
  EXPECT_EQ(diagnostics.warnings().size(), 1U);
  Simulation simulation = simulation_at(planned, 1, time_from_seconds(2.0));
  EXPECT_GT(simulation.robots().front().true_pose(0.0).translation.x(), 0.3);
}

}  // namespace
}  // namespace tagfield
