// SPDX-License-Identifier: Apache-2.0
/// Results of every method on surveys of many kinds, compared with those in recorded/: whatever
/// changes a result shows here. They are right only as far as the other tests say so.
///
///     TAGFIELD_RECORD=1 build/release/bin/localization_test --gtest_filter='*Recorded*'
///
/// records them anew after a change that is meant to alter them; `git diff` then shows what it did.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>

#include "made_survey.h"
#include "tagfield/base/number.h"
#include "tagfield/localization/bound.h"

namespace tagfield {
namespace {

using namespace made;

struct Kind {
  std::string name;
  SurveyPlan plan;
  std::function<void(Survey&)> change{};  ///< Of what is known, or of rows.
};

std::vector<MountedAntenna> both_sides() {
  return {{"left", {0.1, 0.2, 0.0}, kPi / 2.0}, {"right", {0.1, -0.2, 0.3}, -kPi / 2.0}};
}

std::vector<Eigen::Vector3d> portal() {
  return {{-1.0, -2.0, 0.5}, {-1.0, 2.0, 1.5}, {6.0, -2.0, 1.5}, {6.0, 2.0, 0.5}};
}

/// Stands still twice.
Path with_stops() {
  Path path = s_curve(7.0, 0.035);
  for (const int at : {50, 120}) {
    const Eigen::Vector3d stop = path[static_cast<std::size_t>(at)];
    path.insert(path.begin() + at, 25, stop);
  }
  return path;
}

void give_covariances(Survey& survey) {
  survey.known.pose_error.reset();
  double sigma = 0.01;
  for (AntennaPose& pose : survey.poses) {
    pose.covariance = Eigen::Vector3d(sigma * sigma, 2e-4, 1e-4).asDiagonal();
    sigma = sigma > 0.03 ? 0.01 : sigma + 1e-4;
  }
}

void give_offsets(Survey& survey) {
  for (const auto& [antenna, offset] : survey.offsets_rad) {
    survey.known.offsets.push_back({antenna, std::nullopt, offset});
  }
}

/// Rows of a clock that was not set, a repeated row, and a read before the first pose.
void spoil_rows(Survey& survey) {
  survey.reads[40].stamp = Time{};
  survey.poses[7].stamp = Time{};
  survey.reads.push_back(survey.reads[10]);
  survey.reads.push_back(survey.reads[20]);
  survey.reads.back().stamp -= duration_from_seconds(100.0);
}

/// Two tags of one ID.
void give_same_ids(Survey& survey) {
  for (TagRead& read : survey.reads) {
    if (read.tag == "tag2") read.tag = "tag1";
  }
}

void swap_ports(Survey& survey) {
  for (TagRead& read : survey.reads) {
    if (read.antenna == "port1") {
      read.antenna = "port3";
    } else if (read.antenna == "port3") {
      read.antenna = "port1";
    }
  }
}

/// Only the tags on the left of a path in the direction of 0.4 rad, which is known.
void keep_left(Survey& survey) {
  const Eigen::Vector3d left(-std::sin(0.4), std::cos(0.4), 0.0);
  const auto is_right = [&](const TagRead& read) { return survey.truth[read.tag].dot(left) < 0.0; };
  survey.reads.erase(std::remove_if(survey.reads.begin(), survey.reads.end(), is_right),
                     survey.reads.end());
  survey.known.area.side = TagSide::kLeft;
  survey.known.area.box =
      Eigen::AlignedBox2d(Eigen::Vector2d(-1.0, -1.0), Eigen::Vector2d(6.0, 6.0));
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  all.push_back({"corner", {.reference_tags = 1}});
  all.push_back({"aisles", {.path = aisles(0.06), .tags = 3}});
  all.push_back({"heights", {.lowest_m = 0.5, .highest_m = 1.8}});
  all.push_back({"unknown_heights", {}, [](Survey& survey) {
                   survey.known.heights = {};
                   survey.known.heights.of_tag["tag2"] = 0.4;
                   survey.known.pose_error.reset();
                 }});
  all.push_back({"hopping",
                 {.antennas = both_sides(), .channels = 4, .dwell = 7, .pi_ambiguity = true},
                 [](Survey& survey) { survey.known.pi_ambiguity = true; }});
  all.push_back({"hopping_slowly",
                 {.path = l_turn(2.5, 2.0, 0.015),
                  .channels = 2,
                  .dwell = 40,
                  .tags = 3,
                  .pi_ambiguity = true},
                 [](Survey& survey) { survey.known.pi_ambiguity = true; }});
  all.push_back({"pose_error",
                 {.antennas = both_sides(), .tags = 6, .reference_tags = 2, .pose_m = 0.02},
                 [](Survey& survey) {
                   survey.known.map_error =
                       MapError{std::nullopt, Eigen::Vector3d(1e-4, 2e-4, 1e-5).asDiagonal()};
                 }});
  all.push_back({"covariances", {.tags = 6, .pose_m = 0.02}, give_covariances});
  all.push_back({"unstated", {.tags = 6, .pose_m = 0.01}, [](Survey& survey) {
                   survey.known.pose_error.reset();
                 }});
  all.push_back({"reflections", {.strays = 0.05, .mirrors = walls(0.4)}});
  all.push_back({"known_world", {.pose_m = 0.01, .mirrors = walls(0.5)}, [](Survey& survey) {
                   survey.known.trace = known_mirrors(walls(0.5));
                   survey.known.world_sigma_m = 0.005;
                 }});
  all.push_back({"straight", {.path = straight(7.0, 0.035, 0.4)}});
  all.push_back({"straight_left", {.path = straight(7.0, 0.035, 0.4), .tags = 8}, keep_left});
  all.push_back({"circular", {.circular = true}});
  all.push_back({"late", {.latency_s = 0.15}});
  all.push_back({"moving", {.velocity = {0.02, -0.01, 0.0}}});
  all.push_back({"same_ids", {}, give_same_ids});
  all.push_back({"stops", {.path = with_stops()}, spoil_rows});
  all.push_back({"offsets", {.antennas = both_sides()}, give_offsets});
  all.push_back({"wrong_sign", {.phase_sign = -1.0}});
  all.push_back({"no_phases", {.tags = 7, .reference_tags = 5}, [](Survey& survey) {
                   for (TagRead& read : survey.reads) read.phase_rad = 0.0;
                 }});
  all.push_back({"random_phases", {.strays = 1.0}});
  const SurveyPlan at_rest = {.path = straight(5.0, 0.02),
                              .fixed = portal(),
                              .channels = 12,
                              .tags = 8,
                              .reference_tags = 5,
                              .farthest_m = 1.5,
                              .range_m = 20.0};
  all.push_back({"portal", at_rest, [](Survey& survey) {
                   survey.known.area.box =
                       Eigen::AlignedBox2d(Eigen::Vector2d(-1.0, -2.0), Eigen::Vector2d(6.0, 2.0));
                 }});
  all.push_back({"swapped_ports", at_rest, swap_ports});
  all.push_back({"rail",
                 {.path = straight(1.0, 0.02),
                  .tags = 3,
                  .nearest_m = 0.8,
                  .farthest_m = 2.0,
                  .lost = 0.0,
                  .mirrors = {{1, 2.5, 0.4}}}});
  return all;
}

std::string number(double value) { return fmt::format("{:.9g}", value); }

std::string text_of(const TagEstimate& estimate, const Candidate& candidate) {
  std::string text = fmt::format("    {} {} {} {} {}", number(candidate.p_WT.x()),
                                 number(candidate.p_WT.y()), number(candidate.p_WT.z()),
                                 number(candidate.rms_m), number(candidate.expected_error_m));
  if (candidate.covariance && &candidate == &estimate.candidates.front()) {
    const Eigen::Matrix3d& c = *candidate.covariance;
    for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}}) {
      text += ' ' + number(c(i, j));
    }
  }
  return text + '\n';
}

std::string text_of(const LocalizationResult& result, const Diagnostics& diagnostics) {
  std::string text = result.why.empty() ? "" : result.method + ": " + result.why + '\n';
  for (const TagEstimate& estimate : result.estimates) {
    text += fmt::format("  {} {} of {} reads {}\n", estimate.tag, to_string(estimate.verdict),
                        estimate.reads, estimate.reason);
    for (const Candidate& candidate : estimate.candidates) text += text_of(estimate, candidate);
  }
  for (std::size_t i = 0; i < result.corrected_poses.size(); i += 100) {
    const Eigen::Vector3d& p = result.corrected_poses[i].X_WA.translation;
    text += fmt::format("  pose {} {} {}\n", number(p.x()), number(p.y()), number(p.z()));
  }
  for (const std::string& warning : diagnostics.warnings()) text += "  ! " + warning + '\n';
  return text;
}

/// No position may be listed twice, as if it were two.
void expect_distinct(const LocalizationResult& result) {
  for (const TagEstimate& estimate : result.estimates) {
    for (const Candidate& one : estimate.candidates) {
      for (const Candidate& other : estimate.candidates) {
        if (&one == &other) continue;
        EXPECT_GT((one.p_WT - other.p_WT).norm(), 1e-3) << result.method << ' ' << estimate.tag;
      }
    }
  }
}

/// With the believed poses as true ones.
std::string bounds_of(const Survey& survey) {
  BoundInput input;
  Diagnostics diagnostics;
  input.truth = make_problem(survey.reads, survey.poses, survey.known, diagnostics);
  input.places = survey.truth;
  for (const auto& [antenna, offset] : survey.offsets_rad) input.phase_noise_rad[antenna] = 0.1;
  std::string text;
  for (const bool jointly : {false, true}) {
    const Bounds bounds = jointly ? joint_bounds(input) : single_bounds(input);
    text += jointly ? "joint bounds\n" : "single bounds\n";
    for (std::size_t i = 0; i < bounds.tags.size(); ++i) {
      const Eigen::Matrix3d covariance = covariance_of(bounds, i);
      text += fmt::format("  {} {} {} {}\n", bounds.tags[i], number(covariance(0, 0)),
                          number(covariance(0, 1)), number(covariance(1, 1)));
    }
  }
  return text;
}

std::string results_of(const Kind& kind) {
  Rng rng(7);
  Survey survey = make_survey(kind.plan, rng);
  if (kind.change) kind.change(survey);
  std::string text = bounds_of(survey);
  for (const Method& method : built_in_methods()) {
    LocalizationOptions options;
    options.method = method.name;
    options.known = survey.known;
    Diagnostics diagnostics;
    const LocalizationResult result = locate_tags(survey.reads, survey.poses, options, diagnostics);
    expect_distinct(result);
    text += method.name + '\n' + text_of(result, diagnostics);
  }
  return text;
}

/// Compilers and processors may round differently.
bool is_same(const std::string& word, const std::string& recorded) {
  if (word == recorded) return true;
  const auto a = parse_number(word);
  const auto b = parse_number(recorded);
  return a && b && std::abs(*a - *b) <= 1e-9 + 1e-5 * std::abs(*b);
}

bool is_same_line(const std::string& line, const std::string& recorded) {
  std::istringstream words(line);
  std::istringstream expected(recorded);
  std::string word;
  std::string other;
  while (words >> word) {
    if (!(expected >> other) || !is_same(word, other)) return false;
  }
  return !(expected >> other);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream all(text);
  for (std::string line; std::getline(all, line);) lines.push_back(line);
  return lines;
}

class Recorded : public testing::TestWithParam<Kind> {};

TEST_P(Recorded, ResultsAreThoseRecorded) {
  const std::string path = fmt::format("{}/tagfield/localization/test/recorded/{}.txt",
                                       TAGFIELD_SOURCE_DIR, GetParam().name);
  const std::string results = results_of(GetParam());
  if (std::getenv("TAGFIELD_RECORD") != nullptr) {
    std::ofstream(path) << results;
    return;
  }
  std::ifstream file(path);
  std::stringstream recorded;
  recorded << file.rdbuf();
  const std::vector<std::string> lines = lines_of(results);
  const std::vector<std::string> expected = lines_of(recorded.str());
  ASSERT_FALSE(expected.empty()) << path;
  for (std::size_t i = 0; i < std::min(lines.size(), expected.size()); ++i) {
    ASSERT_TRUE(is_same_line(lines[i], expected[i]))
        << path << ':' << i + 1 << "\nrecorded: " << expected[i] << "\nnow:      " << lines[i];
  }
  EXPECT_EQ(lines.size(), expected.size()) << path;
}

INSTANTIATE_TEST_SUITE_P(Kinds, Recorded, testing::ValuesIn(kinds()),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace tagfield
