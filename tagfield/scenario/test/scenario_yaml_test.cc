// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/scenario_yaml.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr const char* kWhole = R"(name: test
seed: 7
duration_s: 3
robots:
  - {name: r, start: [1, 2, 0.5], waypoints: [[3, 2]]}
antennas:
  - name: a
    on: r
    pose: [0, 0, 1.5, 0, 0, 1.5707963267948966]
    lift: {travel_m: 1.5}
    frequency_hz: 915e6
    optional_distribution: gamma_distribution
    optional_distribution_params: [2, 0.1]
tags:
  - {id: t1, position: [1, 2, 3], appears_s: 1, disappears_s: 2}
  - id: t2
    trajectory: [[0, 0, 0, 1], [2, 4, 0, 1]]
pose: {source: noisy, sigma_m: 0.02, yaw_sigma_deg: 0.5}
localization: {tag_height_m: 1.2, stride_m: 0.4}
)";

std::string write_scenario(const std::string& text) {
  return folder_of_test().with("scenario.yaml", text);
}

/// The error message for the whole scenario with `from` replaced by `to`, without the folder.
std::string complaint(const std::string& from, const std::string& to) {
  std::string text = kWhole;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const std::string path = write_scenario(text);
  try {
    load_scenario(path, {});
  } catch (const Error& error) {
    const std::string what = error.what();
    return what.rfind(path, 0) == 0 ? what.substr(path.size() + 1) : what;
  }
  return "no complaint";
}

TEST(LoadScenario, TakesEveryPart) {
  const Scenario scenario = load_scenario(write_scenario(kWhole), {});
  EXPECT_EQ(scenario.name, "test");
  EXPECT_EQ(scenario.seed, 7U);
  EXPECT_EQ(scenario.duration_s, 3.0);
  ASSERT_EQ(scenario.robots.size(), 1U);
  EXPECT_EQ(scenario.robots[0].start.yaw, 0.5);
  ASSERT_EQ(scenario.antennas.size(), 1U);
  const AntennaSpec& antenna = scenario.antennas[0];
  EXPECT_EQ(antenna.on, "r");
  EXPECT_NEAR(yaw_of(antenna.X_PA.rotation), kPi / 2.0, 1e-12);
  EXPECT_EQ(antenna.lift.travel_m, 1.5);
  EXPECT_EQ(paper(antenna.parameters).model.frequency_hz, 915e6);
  EXPECT_EQ(paper(antenna.parameters).model.optional.kind, DistributionKind::kGamma);
  ASSERT_EQ(scenario.tags.size(), 2U);
  EXPECT_EQ(scenario.tags[0].disappears, time_from_seconds(2.0));
  EXPECT_FALSE(moves(scenario.tags[0]));
  EXPECT_TRUE(moves(scenario.tags[1]));
  EXPECT_EQ(scenario.pose.source, PoseSource::kNoisy);
  EXPECT_NEAR(scenario.pose.yaw_sigma_rad, 0.5 * kPi / 180.0, 1e-15);
  EXPECT_EQ(scenario.localization.known_height, KnownHeight::kNumber);
}

TEST(LoadScenario, ComplainsByLine) {
  EXPECT_EQ(complaint("frequency_hz: 915e6", "frequency_hz: 0"),
            "11: antennas[0].frequency_hz must be greater than 0, is 0");
  EXPECT_EQ(complaint("frequency_hz: 915e6", "frequency_hz: .nan"),
            "11: antennas[0].frequency_hz must be finite, is nan");
  EXPECT_EQ(complaint("frequency_hz: 915e6", "frequenzy_hz: 915e6"),
            "11: unknown key 'frequenzy_hz' in antennas[0] (did you mean 'frequency_hz'?)");
  EXPECT_EQ(complaint("frequency_hz: 915e6", "range_m: -7"),
            "11: antennas[0].range_m must be greater than 0, is -7");
  EXPECT_EQ(complaint("frequency_hz: 915e6", "rate_hz: 0"),
            "11: antennas[0].rate_hz must be greater than 0, is 0");
  EXPECT_EQ(complaint("gamma_distribution", "gama_distribution"),
            "12: antennas[0].optional_distribution: unknown distribution 'gama_distribution' (did "
            "you mean 'gamma_distribution'?)");
  EXPECT_EQ(complaint("[2, 0.1]", "[2]"),
            "12: antennas[0].optional_distribution: gamma_distribution takes 2 parameters (alpha, "
            "beta), got 1");
  EXPECT_EQ(complaint("disappears_s: 2", "disappears_s: 1"),
            "15: tags[0].disappears_s must be later than appears_s");
  EXPECT_EQ(complaint("[2, 4, 0, 1]", "[0, 4, 0, 1]"),
            "17: tags[1].trajectory times must rise: 0.000000000 s follows 0.000000000 s");
  EXPECT_EQ(complaint("source: noisy", "source: nosy"),
            "18: pose.source is 'nosy', which is not known (did you mean 'noisy'?)");
  EXPECT_EQ(complaint("seed: 7", "seed: -7"),
            "2: seed is '-7', expected a whole number, 0 or more");
  EXPECT_EQ(complaint("id: t2", "id: t2\n    id: t3"), "17: tags[1] has 'id' twice");
  EXPECT_NE(complaint("robots:", "robots: [").find("not valid YAML"), std::string::npos);
}

/// Found by fuzzing: a name too long for the operating system caused an exception of another type.
TEST(LoadScenario, ComplainsOfAProfileThatCantBeLookedFor) {
  const std::string name(300, 'a');
  const std::string complained = complaint("seed: 7", "seed: 7\ntag_profile: " + name);
  EXPECT_EQ(complained.rfind("3: tag_profile is '", 0), 0U) << complained;
  EXPECT_NE(complained.find(name + "': there is no such file"), std::string::npos) << complained;
}

/// A key of a tag's own, such as its mounting, changes that and nothing else.
TEST(LoadScenario, OwnSettingsOfATagOverrideTheProfileOfAll) {
  const std::string text =
      "duration_s: 1\nmodel: link_budget\ntag_profile: monza_r6\n"
      "antennas: [{name: a, pose: [0, 0, 1]}]\n"
      "tags:\n"
      "  - {id: as_all, position: [1, 0, 1]}\n"
      "  - {id: on_metal, position: [2, 0, 1], detuning_db: 6}\n"
      "  - {id: other, position: [3, 0, 1], profile: higgs_3, detuning_db: 6}\n";
  const Scenario scenario = load_scenario(write_scenario(text), {});
  ASSERT_EQ(scenario.tags.size(), 3U);
  const TagModel& as_all = *scenario.tags[0].model;
  const TagModel& on_metal = *scenario.tags[1].model;
  EXPECT_EQ(as_all.sensitivity_dbm, -22.1);
  EXPECT_EQ(on_metal.sensitivity_dbm, -22.1);
  EXPECT_EQ(on_metal.modulation_db, as_all.modulation_db);
  EXPECT_EQ(on_metal.antenna.gain_dbi, as_all.antenna.gain_dbi);
  EXPECT_EQ(as_all.detuning_db, 0.0);
  EXPECT_EQ(on_metal.detuning_db, 6.0);
  EXPECT_EQ(scenario.tags[2].model->sensitivity_dbm, -18.0);
  EXPECT_EQ(scenario.tags[2].model->detuning_db, 6.0);
}

TEST(LoadScenario, TakesOverridesWithTheirOwnPlace) {
  const std::string path = write_scenario(kWhole);
  EXPECT_EQ(
      paper(load_scenario(path, {{"antennas.a.range_m", "5"}}).antennas[0].parameters).range_m,
      5.0);
  EXPECT_EQ(load_scenario(path, {{"seed", "9"}}).seed, 9U);
  try {
    load_scenario(path, {{"antennas.a.range_m", "-5"}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "--set: antennas[0].range_m must be greater than 0, is -5");
  }
  try {
    load_scenario(path, {{"pose.sigm_m", "1"}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "--set: unknown key 'sigm_m' in pose (did you mean 'sigma_m'?)");
  }
}

TEST(LoadScenario, WantsAWorldsPath) {
  const std::string path = write_scenario("world: {path: }\n");
  try {
    load_scenario(path, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--set world.path=FILE"), std::string::npos);
  }
}

TEST(LoadScenarioWithWorld, WantsAntennasAndTags) {
  Diagnostics diagnostics;
  const std::string path = write_scenario("duration_s: 1\ntags: [{id: a, position: [0, 0, 0]}]\n");
  try {
    load_scenario_with_world(path, {}, diagnostics);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no antennas"), std::string::npos);
  }
}

TEST(ParseOverride, SplitsAtTheFirstEqualsSign) {
  EXPECT_EQ(parse_override("a.b=c=d"), (Override{"a.b", "c=d"}));
  EXPECT_THROW(parse_override("a.b"), Error);
  EXPECT_THROW(parse_override("=1"), Error);
  EXPECT_THROW(parse_override("a.b="), Error);
}

TEST(LoadScenario, RefusesPhysicalKeysBesideThePapersModel) {
  const std::string belongs = " belongs to model: link_budget or model: multipath, but ";
  EXPECT_EQ(
      complaint("frequency_hz: 915e6", "transmit_power_dbm: 30"),
      "11: antennas[0].transmit_power_dbm" + belongs + "the antenna is simulated by model: paper");
  EXPECT_EQ(complaint("frequency_hz: 915e6", "profiles: [reader.yaml]"),
            "11: antennas[0].profiles" + belongs + "the antenna is simulated by model: paper");
  EXPECT_EQ(complaint("{id: t1,", "{id: t1, sensitivity_dbm: -20,"),
            "15: tags[0].sensitivity_dbm" + belongs + "all antennas are simulated by model: paper");
  EXPECT_EQ(complaint("seed: 7", "without: [noise]"),
            "2: without" + belongs + "all antennas are simulated by model: paper");
}

TEST(LoadScenario, TakesASensitivityOfThePapersAntennas) {
  EXPECT_FALSE(
      paper(load_scenario(write_scenario(kWhole), {}).antennas[0].parameters).sensitivity_dbm);
  const Scenario scenario =
      load_scenario(write_scenario(kWhole), {{"antennas.a.sensitivity_dbm", "-70"}});
  EXPECT_EQ(paper(scenario.antennas[0].parameters).sensitivity_dbm, -70.0);
  EXPECT_NE(
      complaint("frequency_hz: 915e6", "sensitivity_dbm: -200").find("sensitivity_dbm must be"),
      std::string::npos);
  EXPECT_NE(
      complaint("{id: t1,", "{id: t1, sensitivity_dbm: -18,").find("sensitivity_dbm belongs to"),
      std::string::npos);
}

TEST(LoadScenario, TakesEpcsAsTagIdsAsTheyAreWritten) {
  std::string text = kWhole;
  const std::string uri = "urn:epc:id:sgtin:0614141.812345.6789";
  text.replace(text.find("id: t1"), 6, "id: " + uri);
  EXPECT_EQ(load_scenario(write_scenario(text), {}).tags[0].id, uri);
  EXPECT_EQ(complaint("id: t1", "id: urn:epc:id:sgtin:0614141.81234.6789"),
            "15: EPC 'urn:epc:id:sgtin:0614141.81234.6789': item reference '81234' must be 6 "
            "digits");
  EXPECT_EQ(complaint("id: t2", "id: urn:epc:raw:96.xE2801160600002054CC2096F"),
            "16: EPC 'urn:epc:raw:96.xE2801160600002054CC2096F': must begin with urn:epc:id: or "
            "urn:epc:tag:");
}

TEST(LoadScenario, WarnsOfThePapersKeysBesideAPhysicalModel) {
  std::string text = kWhole;
  text.replace(text.find("    frequency_hz"), 0, "    model: link_budget\n    range_m: 5\n");
  Diagnostics diagnostics;
  const Scenario scenario = load_scenario(write_scenario(text), {}, diagnostics);
  EXPECT_NE(physical(scenario.antennas[0].parameters), nullptr);
  ASSERT_EQ(diagnostics.warnings().size(), 3U);
  EXPECT_NE(diagnostics.warnings()[0].find("antennas[0].range_m belongs to model: paper and has no "
                                           "effect with model: link_budget"),
            std::string::npos);
}

const char* const kTwoReaders = R"(model: link_budget
duration_s: 1
interference: on
tag_coupling: on
antennas:
  - {name: a, reader: one, pose: [0, 0, 1]}
  - {name: b, reader: two, pose: [4, 0, 1], spectrum_mask: multiple}
tags:
  - {id: t1, position: [1, 0, 1]}
  - {id: t2, position: [1, 0.05, 1]}
)";

/// The error or warning for the two readers with `from` replaced by `to`.
std::string said_of_two(const std::string& from, const std::string& to) {
  std::string text = kTwoReaders;
  text.replace(text.find(from), from.size(), to);
  const std::string path = write_scenario(text);
  Diagnostics diagnostics;
  try {
    load_scenario(path, {}, diagnostics);
  } catch (const Error& error) {
    return std::string(error.what()).substr(path.size() + 1);
  }
  std::string said;
  for (const std::string& warning : diagnostics.warnings()) said += warning.substr(path.size() + 1);
  return said;
}

TEST(LoadScenario, RefusesInterferenceWhereNobodyElseSends) {
  EXPECT_EQ(said_of_two("on", "on"), "");
  const std::string nobody =
      "3: interference has no effect: no other reader sends while antenna 'a' does; expected off, "
      "or another reader with sharing: channel";
  EXPECT_EQ(said_of_two("reader: two", "reader: one"), nobody);
  EXPECT_EQ(said_of_two("duration_s: 1", "duration_s: 1\nwithout: [interference]"), "");
}

TEST(LoadScenario, WarnsOfMasksThatNobodyMindsAndOfLoneTags) {
  EXPECT_EQ(said_of_two("interference: on", "interference: off"),
            "7: spectrum_mask of antenna 'b' has no effect: no other reader that sends at the same "
            "time has interference: on");
  EXPECT_EQ(said_of_two("  - {id: t2, position: [1, 0.05, 1]}\n", ""),
            "4: tag_coupling has no effect: there is one tag only");
}

}  // namespace
}  // namespace tagfield
