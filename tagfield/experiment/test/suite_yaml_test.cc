#include "tagfield/experiment/bench/suite_yaml.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tagfield/base/units.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/experiment/bench/run_bench.h"
#include "tagfield/files/files.h"
#include "tagfield/localization/locate.h"

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

/// A suite with these conditions, of which the first stands in line 4.
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
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, lose: {shar: 0.3}}\n")),
            "suite.yaml:4: unknown key 'shar' in conditions[0].lose (did you mean 'share'?)");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, lose: {share: 1.5}}\n")),
            "suite.yaml:4: conditions[0].lose.share must be from 0 to 1, is 1.5");
  EXPECT_EQ(complaint_of(with_conditions("  - {name: a, lose: {burst_s: 1}}\n")),
            "suite.yaml:4: conditions[0].lose has no 'every_s'");
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
