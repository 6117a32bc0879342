// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/link_explanation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/channel/paper_model.h"
#include "tagfield/planning/link_verdict.h"
#include "tagfield/planning/test/radio_hall.h"

namespace tagfield {
namespace {

LinkExplanation explained(const Scenario& scenario, double time_s = 0.0) {
  const AntennaSpec& antenna = scenario.antennas.front();
  const TagSpec& tag = scenario.tags.front();
  return explain_link(scenario, {antenna, tag, time_from_seconds(time_s), antenna.X_PA,
                                 tag.motion.front().X_WB, 1});
}

Scenario three_metres_apart() {
  return hall_with(physical_antenna("gate", {0.0, 0.0, 1.0}, isotropic_model()),
                   physical_tag("tag", {3.0, 0.0, 1.0}));
}

/// The lines must add up, whatever their texts.
void expect_sums(const LinkExplanation& link) {
  EXPECT_NEAR(sum_of(link.physical->to_tag), link.physical->tag_dbm, 0.01);
  EXPECT_NEAR(sum_of(link.physical->to_reader), link.physical->reply_dbm, 0.01);
}

TEST(LinkExplanation, IsFriisInFreeSpace) {
  const LinkExplanation link = explained(three_metres_apart());
  EXPECT_NEAR(link.physical->tag_dbm, 30.0 + friis_db(3.0), 1e-9);
  EXPECT_NEAR(link.physical->reply_dbm, 30.0 + 2.0 * friis_db(3.0) - 5.0, 1e-9);
  expect_sums(link);
  // −10.7 dBm against −18, and −56.5 dBm against −84.
  EXPECT_TRUE(link.read);
  EXPECT_EQ(link.verdict, "read: +7.3 dB at the tag, +27.5 dB at the reader");
  ASSERT_EQ(link.physical->paths.size(), 1U);
  EXPECT_NEAR(*link.physical->paths.front().relative_db, 0.0, 1e-9);
}

TEST(LinkExplanation, NothingRemainsOfATagSeenEndOn) {
  // A dipole along z, 2 m above an antenna that looks at it.
  RadioModel model = isotropic_model();
  model.effects.patterns = true;
  Scenario scenario = hall_with(physical_antenna("gate", {0.0, 0.0, 1.0}, model),
                                physical_tag("tag", {0.0, 0.0, 3.0}));
  TagModel tag;
  tag.antenna.shape = PatternShape::kDipole;
  scenario.tags.front().model = std::make_shared<const TagModel>(tag);
  const LinkExplanation link = explained(scenario);
  EXPECT_FALSE(link.read);
  EXPECT_NE(link.verdict.find("not read: nothing at the tag"), std::string::npos) << link.verdict;
  EXPECT_EQ(signed_db(link.physical->tag_dbm), "nothing");
  for (const BudgetLine& line : link.physical->to_tag) {
    EXPECT_EQ(line.what.find("remains"), std::string::npos) << line.what << ' ' << line.db;
  }
}

TEST(LinkExplanation, GivesTheTabulatedRepliesAtOneTwoAndFiveMetres) {
  // 35.15 dBm EIRP with a 6 dBi circular antenna, a 2 dBi linear tag, modulation −5 dB.
  RadioModel model = isotropic_model();
  model.effects.polarization = true;
  model.transmit_power_dbm = 29.15;
  model.antenna.gain_dbi = 6.0;
  model.antenna.polarization = PolarizationKind::kRightCircular;
  TagModel tag;
  tag.antenna.gain_dbi = 2.0;
  for (const auto& [distance_m, reply_dbm] : {std::pair(1.0, -28.2), {2.0, -40.3}, {5.0, -56.2}}) {
    Scenario scenario = hall_with(physical_antenna("gate", {0.0, 0.0, 1.0}, model),
                                  physical_tag("tag", {distance_m, 0.0, 1.0}));
    scenario.tags.front().model = std::make_shared<const TagModel>(tag);
    const LinkExplanation link = explained(scenario);
    EXPECT_NEAR(link.physical->reply_dbm, reply_dbm, 0.1) << distance_m;
    expect_sums(link);
  }
}

TEST(LinkExplanation, NamesWhatBlocksTheOnlyWay) {
  Scenario scenario = three_metres_apart();
  add_box(scenario, "metal", {1.5, 0.0, 1.0}, {0.2, 1.0, 1.0});
  const LinkExplanation link = explained(scenario);
  EXPECT_FALSE(link.read);
  EXPECT_EQ(link.verdict, "not read: blocked by crate (metal)");
  EXPECT_FALSE(link.physical->arrives);
  expect_sums(link);
  ASSERT_EQ(link.physical->paths.size(), 1U);
  EXPECT_TRUE(link.physical->paths.front().blocked);
  ASSERT_EQ(link.physical->paths.front().crossings.size(), 1U);
  EXPECT_NEAR(link.physical->paths.front().crossings.front().thickness_m, 0.2, 1e-5);
}

TEST(LinkExplanation, SaysBehindWhatTheTagIs) {
  // 9 m: 30 − 50.3 = −20.3 dBm even in free space; concrete attenuates further.
  Scenario scenario = three_metres_apart();
  scenario.tags.front() = physical_tag("tag", {9.0, 0.0, 1.0});
  const LinkExplanation open = explained(scenario);
  EXPECT_EQ(open.verdict, "not read: −2.3 dB at the tag, 9.00 m away");
  add_box(scenario, "concrete", {4.0, 0.0, 1.0}, {0.3, 1.0, 1.0});
  const LinkExplanation behind = explained(scenario);
  EXPECT_NE(behind.verdict.find("at the tag, behind crate (concrete)"), std::string::npos)
      << behind.verdict;
  expect_sums(behind);
  // The loss by the box is the whole difference, and has its own line.
  double crate_db = 0.0;
  for (const BudgetLine& line : behind.physical->to_tag) {
    if (line.what.rfind("through crate (concrete, 0.30 m)", 0) == 0) crate_db = line.db;
  }
  EXPECT_LT(crate_db, -3.0);
  EXPECT_NEAR(behind.physical->tag_dbm - open.physical->tag_dbm, crate_db, 1e-9);
}

TEST(LinkExplanation, AddsUpWithReflections) {
  RadioModel model = isotropic_model();
  model.effects.polarization = true;
  model.effects.reflections = true;
  model.reflection_order = 2;
  Scenario scenario = hall_with(physical_antenna("gate", {0.0, 0.0, 1.0}, model),
                                physical_tag("tag", {3.0, 0.0, 1.0}));
  add_box(scenario, "metal", {1.5, 3.0, 1.0}, {4.0, 0.2, 2.0});
  const LinkExplanation link = explained(scenario);
  expect_sums(link);
  ASSERT_EQ(link.physical->paths.size(), 2U);
  const PathExplanation& mirrored = link.physical->paths.back();
  EXPECT_EQ(mirrored.order, 1);
  // By the image at 2·2.9 m to the side.
  EXPECT_NEAR(mirrored.length_m, std::hypot(3.0, 5.8), 1e-9);
  EXPECT_NEAR(mirrored.excess_m, std::hypot(3.0, 5.8) - 3.0, 1e-9);
  ASSERT_EQ(mirrored.bounces.size(), 1U);
  EXPECT_EQ(mirrored.bounces.front().object, "crate");
  EXPECT_EQ(mirrored.bounces.front().material, "metal");
}

TEST(LinkExplanation, KnowsTagsThatAreNotThere) {
  Scenario scenario = three_metres_apart();
  scenario.tags.front().appears = time_from_seconds(12.0);
  scenario.tags.front().disappears = time_from_seconds(20.0);
  EXPECT_EQ(explained(scenario, 1.0).verdict, "not read: not there yet (appears at 12 s)");
  EXPECT_TRUE(explained(scenario, 12.0).read);
  EXPECT_EQ(explained(scenario, 20.0).verdict, "not read: gone (disappeared at 20 s)");
}

TEST(LinkExplanation, KnowsWhoseTurnItIs) {
  RadioModel model = isotropic_model();
  model.gen2 = Gen2Reader{};
  model.gen2->port_dwell_s = 0.2;
  Scenario scenario = hall_with(physical_antenna("second", {0.0, 0.0, 1.0}, model),
                                physical_tag("tag", {3.0, 0.0, 1.0}));
  AntennaSpec first = physical_antenna("first", {0.0, 5.0, 1.0}, model);
  first.parameters.reader = "second";  // The reader of both.
  scenario.antennas.insert(scenario.antennas.begin(), first);
  const auto at = [&](double time_s) {
    const TagSpec& tag = scenario.tags.front();
    return explain_link(scenario, {scenario.antennas[1], tag, time_from_seconds(time_s),
                                   scenario.antennas[1].X_PA, tag.motion.front().X_WB, 1});
  };
  EXPECT_EQ(at(0.1).verdict.substr(0, 50), "not read just now: the antenna's turn is at 0.2 s;");
  EXPECT_TRUE(at(0.3).read);
  EXPECT_GT(*at(0.3).physical->decode_probability, 0.99);
}

TEST(LinkExplanation, OfThePapersModelIsRangeAndMeans) {
  Scenario scenario = three_metres_apart();
  AntennaParameters& parameters = scenario.antennas.front().parameters;
  parameters.model = PaperAntenna{};
  paper(parameters).range_sigma = 0.0;
  paper(parameters).range_m = 7.0;
  const LinkExplanation link = explained(scenario);
  ASSERT_TRUE(link.paper);
  EXPECT_EQ(link.verdict, "read: 4.00 m inside the range of 7.00 m (7.00 m in this update)");
  const double lambda = kSpeedOfLight / kTestCarrier_hz;
  EXPECT_NEAR(link.paper->phase_rad, std::fmod(4.0 * kPi * 3.0 / lambda, kTwoPi), 1e-9);
  EXPECT_EQ(link.paper->rssi_dbm, std::round(40.0 * std::log10(lambda / (12.0 * kPi))));
}

TEST(LinkExplanation, PapersProbabilityIsThatOfItsNormalDistribution) {
  AntennaParameters antenna;
  paper(antenna).range_m = 7.0;
  paper(antenna).range_sigma = 0.05;
  EXPECT_NEAR(read_probability(antenna, 7.0), 0.5, 1e-9);
  // One sigma beyond and two sigma within: from a table of the normal distribution.
  EXPECT_NEAR(read_probability(antenna, 7.35), 0.158655, 1e-5);
  EXPECT_NEAR(read_probability(antenna, 6.30), 0.977250, 1e-5);
  paper(antenna).range_sigma = 0.0;
  EXPECT_EQ(read_probability(antenna, 7.0), 1.0);
  EXPECT_EQ(read_probability(antenna, 7.01), 0.0);
}

TEST(LinkExplanation, PapersProbabilityCountsWhatReachesTheSensitivity) {
  AntennaParameters antenna;
  antenna.name = "a";
  PaperAntenna& model = paper(antenna);
  model.range_sigma = 0.0;
  model.model.rssi_noise = 0.008;
  LinkGeometry link;
  link.distance_m = 3.0;
  for (const double min_dbm : {-120.0, -90.5, -85.0, -80.0, -75.0, -70.0}) {
    model.sensitivity_dbm = min_dbm;
    constexpr int kReads = 20'000;
    int heard = 0;
    for (int i = 0; i < kReads; ++i) {
      const Signal signal = read_signal(antenna, 1, 2, link, Time(Duration(i)), 3);
      if (signal.rssi_dbm >= min_dbm) ++heard;
    }
    const double expected = read_probability(antenna, link.distance_m);
    const double sigma = std::sqrt(expected * (1.0 - expected) / kReads);
    EXPECT_NEAR(static_cast<double>(heard) / kReads, expected, 4.0 * sigma + 1e-9) << min_dbm;
  }
  model.model.rssi_noise = 0.0;
  EXPECT_EQ(read_probability(antenna, 3.0), 0.0);
  model.sensitivity_dbm = -120.0;
  EXPECT_EQ(read_probability(antenna, 3.0), 1.0);
}

TEST(LinkExplanation, SaysWhereThePapersReplyIsTooWeak) {
  Scenario scenario = three_metres_apart();
  PaperAntenna antenna;
  antenna.sensitivity_dbm = -50.0;
  scenario.antennas.front().parameters.model = antenna;
  const LinkExplanation link = explained(scenario);
  EXPECT_FALSE(link.read);
  EXPECT_EQ(link.verdict, "not read: -81 dBm without noise are below the sensitivity of -50 dBm");
}

TEST(LinkExplanation, WritesMarginsAsBooksDo) {
  EXPECT_EQ(signed_db(6.24), "+6.2 dB");
  EXPECT_EQ(signed_db(-3.14), "−3.1 dB");
  EXPECT_EQ(signed_db(-0.01), "+0.0 dB");
  EXPECT_EQ(signed_db(-380.0), "nothing");
}

TEST(PathExplanation, CallsSolidsAsPeopleDo) {
  EXPECT_EQ(object_of("racks::rack_4::shelf_2"), "rack_4");
  EXPECT_EQ(object_of("walls::link::wall_north"), "wall_north");
  EXPECT_EQ(object_of("crate::link::collision"), "crate");
  EXPECT_EQ(object_of("shelf_007::shelf::link::collision_1"), "shelf_007");
  EXPECT_EQ(object_of("box"), "box");
}

}  // namespace
}  // namespace tagfield
