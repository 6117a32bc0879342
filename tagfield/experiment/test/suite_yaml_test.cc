// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tagfield/base/units.h"
#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/files/files.h"
#include "tagfield/localization/locate.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

const std::string kScenario = TAGFIELD_SOURCE_DIR "/scenarios/paper_warehouse.yaml";

/// A suite's file in a folder of its own.
class SuiteFile {
 public:
  explicit SuiteFile(const std::string& text)
      : folder_(fs::temp_directory_path() /
                fs::path(::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
    write_text_file(path(), text);
  }
  ~SuiteFile() { fs::remove_all(folder_); }
  SuiteFile(const SuiteFile&) = delete;
  SuiteFile& operator=(const SuiteFile&) = delete;

  [[nodiscard]] std::string path() const { return (folder_ / "suite.yaml").string(); }

 private:
  fs::path folder_;
};

std::string complaint_of(const std::string& text, bool prepared = false) {
  const SuiteFile file(text);
  try {
    const Suite suite = load_suite(file.path());
    Diagnostics diagnostics;
    if (prepared) prepare(suite, built_in_methods(), diagnostics);
  } catch (const Error& error) {
    std::string said = error.what();
    const std::size_t folder = said.find(file.path());
    if (folder == 0) said.replace(0, file.path().size(), "suite.yaml");
    return said;
  }
  return "";
}

/// A suite with these conditions, of which the first is on line 4.
std::string with_conditions(const std::string& conditions) {
  return "scenario: " + kScenario + "\nmethods: [hyperbola]\nconditions:\n" + conditions;
}

TEST(SuiteYaml, ReadsEveryKey) {
  const SuiteFile file("name: hall\ndescription: all of it\nscenario: " + kScenario +
                       "\nseeds: {first: 7, count: 20}\nphase_noise_rad: 0.2\nmethods:\n"
                       "  - hyperbola\n"
                       "  - {name: coarse, method: hyperbola, localization: {stride_m: 1}}\n"
                       "conditions:\n"
                       "  - {name: plain}\n"
                       "  - name: all\n"
                       "    set: {pose.source: \"true\", tags.tag1.position: [1, 2, 3]}\n"
                       "    localization: {offset: known}\n"
                       "    seeds: 3\n"
                       "    lose: {share: 0.3, burst_s: 1, every_s: 10}\n"
                       "    believed: {sigma_m: 0.02, yaw_sigma_deg: 1, time_constant_s: 10}\n"
                       "    phase_noise_rad: 0.4\n"
                       "    methods: [coarse]\n"
                       "  - {name: unknown, believed: unknown}\n"
                       "  - {name: exact, believed: exact}\n");
  const Suite suite = load_suite(file.path());
  EXPECT_EQ(suite.name, "hall");
  EXPECT_EQ(suite.description, "all of it");
  EXPECT_EQ(suite.first_seed, 7U);
  EXPECT_EQ(suite.count, 20U);
  ASSERT_EQ(suite.methods.size(), 2U);
  EXPECT_EQ(suite.methods[0].name, "hyperbola");
  EXPECT_EQ(suite.methods[1].method, "hyperbola");
  EXPECT_EQ(suite.methods[1].localization, (std::vector<Override>{{"localization.stride_m", "1"}}));
  ASSERT_EQ(suite.conditions.size(), 4U);
  EXPECT_EQ(suite.conditions[0].scenario, kScenario);
  EXPECT_EQ(suite.conditions[0].phase_noise_rad, 0.2);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(suite.conditions[0].believed));
  const Condition& all = suite.conditions[1];
  ASSERT_EQ(all.settings.size(), 3U);
  EXPECT_EQ(all.settings[1], (Override{"tags.tag1.position", "[1, 2, 3]"}));
  EXPECT_EQ(all.settings[2], (Override{"localization.offset", "known"}));
  EXPECT_EQ(all.count, 3U);
  ASSERT_TRUE(all.lose);
  EXPECT_EQ(all.lose->share, 0.3);
  EXPECT_EQ(all.lose->burst_s, 1.0);
  EXPECT_EQ(all.lose->every_s, 10.0);
  EXPECT_NEAR(std::get<PoseErrorModel>(all.believed).yaw_sigma_rad, kPi / 180.0, 1e-15);
  EXPECT_EQ(all.phase_noise_rad, 0.4);
  EXPECT_EQ(all.methods, std::vector<std::string>{"coarse"});
  EXPECT_TRUE(std::holds_alternative<UnknownPoseError>(suite.conditions[2].believed));
  EXPECT_EQ(std::get<PoseErrorModel>(suite.conditions[3].believed).sigma_m, 0.0);
}

TEST(SuiteYaml, ComplainsOfFileAndLine) {
  EXPECT_EQ(complaint_of("methds: [hyperbola]\n"),
            "suite.yaml:1: unknown key 'methds' (did you mean 'methods'?)");
  EXPECT_EQ(
      complaint_of("name: a hall\nantennas: []\n"),
      "suite.yaml:1: is a scenario, not a suite: 'tagfield run' simulates it (docs/bench.md)");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, lose: {shar: 0.3}}\n")),
            "suite.yaml:4: unknown key 'shar' in conditions[0].lose (did you mean 'share'?)");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, lose: {share: 1.5}}\n")),
            "suite.yaml:4: conditions[0].lose.share must be from 0 to 1, is 1.5");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, lose: {burst_s: 1}}\n")),
            "suite.yaml:4: conditions[0].lose has no 'every_s'");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, lose: {burst_s: 1e15, every_s: 1}}\n")),
            "suite.yaml:4: conditions[0].lose.burst_s must be at most 1000 times every_s, is "
            "1000000000000000: "
            "nothing would be read");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a}\n  - {name: a}\n")),
            "suite.yaml:5: condition 'a' is there twice");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, methods: [hyperbol]}\n")),
            "suite.yaml:4: there is no method 'hyperbol' (did you mean 'hyperbola'?)");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, seeds: 0}\n")),
            "suite.yaml:4: conditions[0].seeds must be from 1 to 1000000, is 0");
  EXPECT_EQ(complaint_of("methods: [hyperbola]\nconditions:\n  - {name: a}\n"),
            "suite.yaml:3: conditions[0] has no 'scenario', and neither has the suite");
  EXPECT_EQ(complaint_of("scenario: " + kScenario + "\nmethods: []\nconditions: [{name: a}]\n"),
            "suite.yaml:2: methods must have at least one method");
}

TEST(SuiteYaml, ReadsFaults) {
  const SuiteFile file(with_conditions(
      "  - {name: word, fault: duplicate_epcs}\n"
      "  - {name: map, fault: {random_phases: true, random_rssi: true, timestamp_delay_s: 0.2}}\n"
      "  - {name: names, fault: {swapped_antennas: [a, b]}}\n"));
  const Suite suite = load_suite(file.path());
  EXPECT_TRUE(suite.conditions[0].fault.value().duplicate_epcs);
  EXPECT_FALSE(suite.conditions[0].fault->random_phases);
  const Faults& map = suite.conditions[1].fault.value();
  EXPECT_TRUE(map.random_phases && map.random_rssi);
  EXPECT_EQ(map.timestamp_delay_s, 0.2);
  EXPECT_EQ(suite.conditions[2].fault.value().swapped_antennas,
            (std::vector<std::string>{"a", "b"}));
}

TEST(SuiteYaml, ComplainsOfFaults) {
  const auto complaint = [](const std::string& fault, bool prepared = false) {
    return complaint_of(with_conditions("  - {name: a, fault: " + fault + "}\n"), prepared);
  };
  EXPECT_EQ(complaint("random_phase"),
            "suite.yaml:4: conditions[0].fault is 'random_phase', which is not known (did you mean "
            "'random_phases'?)");
  EXPECT_EQ(complaint("{random_phase: true}"),
            "suite.yaml:4: unknown key 'random_phase' in conditions[0].fault (did you mean "
            "'random_phases'?)");
  EXPECT_EQ(complaint("{random_rssi: false}"),
            "suite.yaml:4: conditions[0].fault.random_rssi is false: leave it out");
  EXPECT_EQ(complaint("{}"), "suite.yaml:4: conditions[0].fault names no fault");
  EXPECT_EQ(complaint("{timestamp_delay_s: 4000}"),
            "suite.yaml:4: conditions[0].fault.timestamp_delay_s must be at most 3600, is 4000");
  EXPECT_EQ(complaint("{swapped_antennas: [a]}"),
            "suite.yaml:4: conditions[0].fault.swapped_antennas must be the names of two antennas");
  EXPECT_EQ(complaint("{random_phases: true, constant_phases: true}"),
            "suite.yaml:4: conditions[0].fault can have only one of random_phases, constant_phases "
            "and wrong_phase_sign");
  EXPECT_EQ(complaint("{swapped_antennas: [mobile, mobil]}", true),
            "suite.yaml:4: condition 'a': fault.swapped_antennas: there is no antenna 'mobil' (did "
            "you mean 'mobile'?)");
}

TEST(SuiteYaml, ReadsRecordings) {
  const SuiteFile file(
      "methods: [hyperbola]\nconditions:\n"
      "  - name: a\n"
      "    recording: {reads: r.csv, poses: p.csv, truth: /t.csv, experiment: one, side: +y,\n"
      "                box: [2, 3, 0, 1], tag_height_m: 0.9, tag_heights: h.csv, format: adarf}\n"
      "    believed: {sigma_m: 0.01}\n"
      "  - {name: b, recording: {reads: r.csv, truth: t.csv, format: own/form.yaml}}\n");
  const Suite suite = load_suite(file.path());
  const SuiteRecording& a = suite.conditions[0].recording.value();
  const std::string folder = fs::path(file.path()).parent_path().string();
  EXPECT_EQ(a.reads, folder + "/r.csv");
  EXPECT_EQ(a.poses, folder + "/p.csv");
  EXPECT_EQ(a.truth, "/t.csv");
  EXPECT_EQ(a.heights, folder + "/h.csv");
  EXPECT_EQ(a.experiment, "one");
  EXPECT_EQ(a.format, "adarf");
  EXPECT_EQ(a.tag_height_m, 0.9);
  EXPECT_EQ(a.area.side, TagSide::kPlusY);
  EXPECT_EQ(a.area.box.value().min(), Eigen::Vector2d(0, 1));
  EXPECT_EQ(suite.conditions[1].recording.value().format, folder + "/own/form.yaml");
  // None of the files exist, which is not an error.
  Diagnostics diagnostics;
  EXPECT_TRUE(prepare(suite, built_in_methods(), diagnostics).conditions.empty());
  ASSERT_EQ(diagnostics.warnings().size(), 2U);
  EXPECT_EQ(diagnostics.warnings()[0],
            file.path() + ":3: condition 'a' is skipped: there is no " + folder + "/r.csv");
}

TEST(SuiteYaml, ComplainsOfRecordings) {
  const auto complaint = [](const std::string& more) {
    return complaint_of("methods: [hyperbola]\nconditions:\n  - {name: a, " + more + "}\n");
  };
  const std::string recording = "recording: {reads: r.csv, poses: p.csv, truth: t.csv}";
  EXPECT_EQ(complaint(recording), "");
  const std::vector<std::string> keys = {"seeds: 3", "set: {a: 1}", "phase_noise_rad: 0.1",
                                         "scenario: s.yaml"};
  for (const std::string& key : keys) {
    const std::string name = key.substr(0, key.find(':'));
    EXPECT_EQ(complaint(fmt::format("{}, {}", recording, key)),
              fmt::format("suite.yaml:3: conditions[0].{} has no effect on a recording", name));
  }
  EXPECT_EQ(complaint("recording: {reads: r.csv, poses: p.csv}"),
            "suite.yaml:3: conditions[0].recording has no 'truth'");
  EXPECT_EQ(complaint("recording: {reads: r.csv, truth: t.csv}"),
            "suite.yaml:3: conditions[0].recording has no 'poses', which tables in Tagfield's own "
            "form require, and no 'format'");
  EXPECT_EQ(complaint("recording: {reads: r.csv, truth: t.csv, format: adarf, sid: +y}"),
            "suite.yaml:3: unknown key 'sid' in conditions[0].recording (did you mean 'side'?)");
}

TEST(SuiteYaml, ComplainsOfWhatTheScenarioWouldNotTake) {
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, set: {pose.sigm_m: 1}}\n"), true),
            "suite.yaml:4: condition 'a': set: unknown key 'sigm_m' in pose (did you mean "
            "'sigma_m'?)");
  EXPECT_EQ(
      complaint_of(
          "scenario: " + kScenario + "\nmethods:\n  - hyperbole\nconditions: [{name: a}]\n", true),
      "suite.yaml:3: method 'hyperbole': there is no method 'hyperbole' (did you mean "
      "'hyperbola'?)");
}

TEST(SuiteYaml, KeepsOnlyWhatIsAskedFor) {
  Suite suite;
  suite.methods = {{"a", "hyperbola", {}, {}}, {"b", "hyperbola", {}, {}}};
  Condition of_both;
  of_both.name = "of both";
  Condition of_a;
  of_a.name = "of a";
  of_a.methods = {"a"};
  suite.conditions = {of_both, of_a};
  const Suite only_b = only(suite, {"b"}, {});
  EXPECT_EQ(only_b.methods.size(), 1U);
  ASSERT_EQ(only_b.conditions.size(), 1U);
  EXPECT_EQ(only_b.conditions[0].name, "of both");
  EXPECT_EQ(only(suite, {}, {"of a"}).conditions.size(), 1U);
  EXPECT_THROW(only(suite, {"c"}, {}), Error);
  EXPECT_THROW(only(suite, {"b"}, {"of a"}), Error);
}

}  // namespace
}  // namespace tagfield
