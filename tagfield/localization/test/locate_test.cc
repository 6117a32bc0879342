// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/locate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_reads.h"

namespace tagfield {
namespace {

using namespace made;

struct Scenario {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
  std::map<std::string, Eigen::Vector3d> truth;
};

Scenario make_scenario(int tags) {
  Scenario scenario;
  Rng rng(20);
  const Path path = aisles(0.02);
  const Time start = time_from_seconds(1.7e9);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double time = static_cast<double>(i) / 15.0;
    scenario.poses.push_back(
        {start + duration_from_seconds(time), "mobile", from_translation(path[i])});
  }
  for (int k = 0; k < tags; ++k) {
    const std::string tag = "tag" + std::to_string(k);
    const Eigen::Vector3d p_WT = beside(path, uniform(rng, 1.0, 4.0), 0.9, rng);
    scenario.truth[tag] = p_WT;
    for (const PhaseSample& sample : read_along(path, p_WT, Noise{}, rng)) {
      scenario.reads.push_back(
          {sample.stamp, "reader", "mobile", tag, sample.frequency_hz, sample.phase_rad, -50.0});
    }
  }
  return scenario;
}

LocalizationOptions at_height(double height, int threads = 1) {
  LocalizationOptions options;
  options.known.heights.of_all = height;
  options.known.pose_error = PoseErrorModel{};  // Exact.
  options.threads = threads;
  return options;
}

void expect_equal(const std::vector<TagEstimate>& a, const std::vector<TagEstimate>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].tag, b[i].tag);
    EXPECT_EQ(a[i].verdict, b[i].verdict);
    ASSERT_EQ(a[i].candidates.size(), b[i].candidates.size());
    for (std::size_t k = 0; k < a[i].candidates.size(); ++k) {
      EXPECT_EQ(a[i].candidates[k].p_WT, b[i].candidates[k].p_WT);
      EXPECT_EQ(a[i].candidates[k].rms_m, b[i].candidates[k].rms_m);
    }
  }
}

TEST(Locate, FindsEveryTagInTheOrderOfTheirIds) {
  const Scenario scenario = make_scenario(12);
  Diagnostics diagnostics;
  const auto estimates =
      locate_tags(scenario.reads, scenario.poses, at_height(0.9), diagnostics).estimates;
  ASSERT_EQ(estimates.size(), 12u);
  EXPECT_TRUE(std::is_sorted(estimates.begin(), estimates.end(),
                             [](const auto& a, const auto& b) { return a.tag < b.tag; }));
  for (const TagEstimate& estimate : estimates) {
    ASSERT_EQ(estimate.verdict, Verdict::kLocated) << estimate.tag;
    EXPECT_LT((estimate.candidates[0].p_WT - scenario.truth.at(estimate.tag)).norm(), 0.05);
  }
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(Locate, SameResultWhateverTheThreadsAndTheOrder) {
  Scenario scenario = make_scenario(6);
  Diagnostics diagnostics;
  const auto one =
      locate_tags(scenario.reads, scenario.poses, at_height(0.9, 1), diagnostics).estimates;
  const auto two =
      locate_tags(scenario.reads, scenario.poses, at_height(0.9, 2), diagnostics).estimates;
  expect_equal(one, two);
  std::reverse(scenario.reads.begin(), scenario.reads.end());
  std::reverse(scenario.poses.begin(), scenario.poses.end());
  expect_equal(one,
               locate_tags(scenario.reads, scenario.poses, at_height(0.9), diagnostics).estimates);
}

TEST(Locate, TakesTheHeightOfTheTagBeforeThatOfAllBeforeTheAntennas) {
  const Scenario scenario = make_scenario(2);
  Diagnostics diagnostics;
  LocalizationOptions options;
  options.known.heights.of_tag["tag0"] = 0.9;
  auto estimates = locate_tags(scenario.reads, scenario.poses, options, diagnostics).estimates;
  EXPECT_DOUBLE_EQ(estimates.at(0).candidates.at(0).p_WT.z(), 0.9);
  EXPECT_NEAR(estimates.at(1).candidates.at(0).p_WT.z(), 0.4, 1e-9);
  options.known.heights.of_all = 1.1;
  estimates = locate_tags(scenario.reads, scenario.poses, options, diagnostics).estimates;
  EXPECT_DOUBLE_EQ(estimates.at(0).candidates.at(0).p_WT.z(), 0.9);
  EXPECT_DOUBLE_EQ(estimates.at(1).candidates.at(0).p_WT.z(), 1.1);
}

TEST(Locate, ATagWithoutPosesIsListedWithItsReason) {
  Scenario scenario = make_scenario(1);
  scenario.reads.push_back(
      {time_from_seconds(1.0), "reader", "unknown", "zebra", 865.7e6, 1.0, -50.0});
  Diagnostics diagnostics;
  const auto estimates =
      locate_tags(scenario.reads, scenario.poses, at_height(0.9), diagnostics).estimates;
  ASSERT_EQ(estimates.size(), 2u);
  EXPECT_EQ(estimates[1].tag, "zebra");
  EXPECT_EQ(estimates[1].verdict, Verdict::kNotLocated);
  EXPECT_EQ(estimates[1].reason, "cannot localize: no reads that have an antenna pose and a phase");
  EXPECT_EQ(diagnostics.warnings().size(), 1u);
}

TEST(Locate, NothingGivesNothing) {
  Diagnostics diagnostics;
  EXPECT_TRUE(locate_tags({}, {}, {}, diagnostics).estimates.empty());
}

TEST(Locate, AHeightThatIsNotFiniteIsAnError) {
  Diagnostics diagnostics;
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(locate_tags({}, {}, at_height(infinity), diagnostics), Error);
}

std::vector<std::string> warnings_of(const Scenario& scenario, LocalizationOptions options,
                                     const std::string& method) {
  Diagnostics diagnostics;
  options.method = method;
  locate_tags(scenario.reads, scenario.poses, options, diagnostics);
  return diagnostics.warnings();
}

bool warns(const Scenario& scenario, const LocalizationOptions& options, const std::string& method,
           const std::string& words) {
  const auto warnings = warnings_of(scenario, options, method);
  return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

TEST(Locate, WarnsOfMethodsThatTakePosesOfUnknownErrorAsExact) {
  Scenario scenario = make_scenario(2);
  LocalizationOptions unknown = at_height(0.9);
  unknown.known.pose_error.reset();
  const std::string nothing = "the poses' error is not stated, and ";
  for (const char* method : {"hyperbola", "ml", "sar"}) {
    EXPECT_TRUE(warns(scenario, unknown, method, nothing + "'" + method + "' takes them as exact"));
    EXPECT_FALSE(warns(scenario, at_height(0.9), method, "as exact"));
  }
  EXPECT_TRUE(warnings_of(scenario, unknown, "joint").empty());
  EXPECT_TRUE(warnings_of(scenario, unknown, "landmarc").empty());

  for (AntennaPose& pose : scenario.poses) pose.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  EXPECT_TRUE(warns(scenario, unknown, "ml", "the poses' covariances are not used, and 'ml'"));
  EXPECT_FALSE(warns(scenario, unknown, "joint", "as exact"));
}

TEST(Locate, SaysNothingOfPosesWhereNoAntennaMovedOrNothingWasLocated) {
  Scenario scenario = make_scenario(2);
  LocalizationOptions unknown = at_height(0.9);
  unknown.known.pose_error.reset();
  scenario.reads.resize(4);
  EXPECT_FALSE(warns(scenario, unknown, "ml", "as exact"));
  scenario = make_scenario(2);
  for (AntennaPose& pose : scenario.poses) pose.X_WA = scenario.poses.front().X_WA;
  EXPECT_FALSE(warns(scenario, unknown, "ml", "as exact"));
}

}  // namespace
}  // namespace tagfield
