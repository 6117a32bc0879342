// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/store/seed_run_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tagfield/experiment/internal/exact_json.h"

namespace tagfield {
namespace {

using Member = nlohmann::json;

Member member_of(const std::vector<double>& numbers) {
  Member list = Member::array();
  for (const double number : numbers) list.push_back(exact_json(number));
  return list;
}

std::vector<double> numbers_of(const Member& list) {
  std::vector<double> numbers;
  numbers.reserve(list.size());
  for (const Member& number : list) numbers.push_back(exact_double_in(number));
  return numbers;
}

Member member_of(const TagOutcome& outcome) {
  Member candidates = Member::array();
  for (const Candidate& candidate : outcome.estimate.candidates) {
    candidates.push_back({exact_json(std::optional(candidate.p_WT)), exact_json(candidate.rms_m),
                          exact_json(candidate.expected_error_m)});
  }
  return Member::array({outcome.seed, outcome.estimate.tag, to_string(outcome.estimate.verdict),
                        outcome.estimate.reason, std::move(candidates), outcome.estimate.reads,
                        outcome.reads, exact_json(outcome.truth_m), outcome.moved,
                        outcome.reference});
}

TagOutcome outcome_in(const Member& member) {
  TagOutcome outcome;
  outcome.seed = member.at(0).get<std::uint64_t>();
  outcome.estimate.tag = member.at(1).get<std::string>();
  outcome.estimate.verdict = verdict_from_string(member.at(2).get<std::string>());
  outcome.estimate.reason = member.at(3).get<std::string>();
  for (const Member& candidate : member.at(4)) {
    outcome.estimate.candidates.push_back({exact_place_in(candidate.at(0)).value(),
                                           exact_double_in(candidate.at(1)),
                                           exact_double_in(candidate.at(2))});
  }
  outcome.estimate.reads = member.at(5).get<std::size_t>();
  outcome.reads = member.at(6).get<std::size_t>();
  outcome.truth_m = exact_place_in(member.at(7));
  outcome.moved = member.at(8).get<bool>();
  outcome.reference = member.at(9).get<bool>();
  return outcome;
}

Member member_of(const std::vector<TagOutcome>& outcomes) {
  Member list = Member::array();
  for (const TagOutcome& outcome : outcomes) list.push_back(member_of(outcome));
  return list;
}

std::vector<TagOutcome> outcomes_in(const Member& list) {
  std::vector<TagOutcome> outcomes;
  for (const Member& outcome : list) outcomes.push_back(outcome_in(outcome));
  return outcomes;
}

/// Run-length encoded cells.
Member member_of(const OccupancyGrid& map) {
  Member lengths = Member::array();
  for (std::size_t i = 0; i < map.cells.size();) {
    std::size_t end = i;
    while (end < map.cells.size() && map.cells[end] == map.cells[i]) ++end;
    lengths.push_back({static_cast<int>(map.cells[i]), end - i});
    i = end;
  }
  return {{"resolution_m", exact_json(map.resolution_m)},
          {"size", {map.width, map.height}},
          {"origin", {exact_json(map.origin.x()), exact_json(map.origin.y())}},
          {"cells", std::move(lengths)}};
}

OccupancyGrid map_in(const Member& member) {
  OccupancyGrid map;
  map.resolution_m = exact_double_in(member.at("resolution_m"));
  map.width = member.at("size").at(0).get<int>();
  map.height = member.at("size").at(1).get<int>();
  map.origin = {exact_double_in(member.at("origin").at(0)),
                exact_double_in(member.at("origin").at(1))};
  for (const Member& run : member.at("cells")) {
    map.cells.insert(map.cells.end(), run.at(1).get<std::size_t>(),
                     static_cast<std::int8_t>(run.at(0).get<int>()));
  }
  return map;
}

Member member_of(const PlanarPose& pose) {
  return {exact_json(pose.x), exact_json(pose.y), exact_json(pose.yaw)};
}

PlanarPose pose_in(const Member& member) {
  return {exact_double_in(member.at(0)), exact_double_in(member.at(1)),
          exact_double_in(member.at(2))};
}

Member member_of(const NavigationRun& run) {
  Member goals = Member::array();
  for (const GoalOutcome& goal : run.goals) {
    goals.push_back({member_of(goal.goal_M), static_cast<int>(goal.state), goal.reason,
                     member_of(goal.truth_W), exact_json(goal.seconds)});
  }
  Member findings = Member::array();
  for (const Finding& finding : run.findings) {
    findings.push_back({static_cast<int>(finding.why), finding.noticed, exact_json(finding.seconds),
                        exact_json(finding.driven_m), finding.wrong});
  }
  Member contacts = Member::array();
  for (const RobotContact& contact : run.robot_contacts) {
    contacts.push_back({contact.one, contact.other, exact_json(contact.at_s),
                        exact_json(contact.place.x()), exact_json(contact.place.y())});
  }
  Member survey;
  if (run.survey) {
    survey = {exact_json(run.survey->path_length_m), exact_json(run.survey->simulated_s)};
  }
  return {{"survey", std::move(survey)},
          {"map", member_of(run.map)},
          {"goals", std::move(goals)},
          {"position_errors_m", member_of(run.position_errors_m)},
          {"yaw_errors_rad", member_of(run.yaw_errors_rad)},
          {"closest_m", exact_json(run.closest_m)},
          {"collisions", run.collisions},
          {"robot_contacts", std::move(contacts)},
          {"findings", std::move(findings)},
          {"times_lost", run.times_lost}};
}

NavigationRun navigation_in(const Member& member) {
  NavigationRun run;
  const Member& survey = member.at("survey");
  if (!survey.is_null()) {
    run.survey.emplace();
    run.survey->path_length_m = exact_double_in(survey.at(0));
    run.survey->simulated_s = exact_double_in(survey.at(1));
  }
  run.map = map_in(member.at("map"));
  for (const Member& goal : member.at("goals")) {
    run.goals.push_back({pose_in(goal.at(0)), static_cast<DriveState>(goal.at(1).get<int>()),
                         goal.at(2).get<std::string>(), pose_in(goal.at(3)),
                         exact_double_in(goal.at(4))});
  }
  run.position_errors_m = numbers_of(member.at("position_errors_m"));
  run.yaw_errors_rad = numbers_of(member.at("yaw_errors_rad"));
  run.closest_m = exact_double_in(member.at("closest_m"));
  run.collisions = member.at("collisions").get<int>();
  for (const Member& contact : member.at("robot_contacts")) {
    run.robot_contacts.push_back(
        {contact.at(0).get<std::string>(),
         contact.at(1).get<std::string>(),
         exact_double_in(contact.at(2)),
         {exact_double_in(contact.at(3)), exact_double_in(contact.at(4))}});
  }
  for (const Member& finding : member.at("findings")) {
    run.findings.push_back({static_cast<PositionLoss>(finding.at(0).get<int>()),
                            finding.at(1).get<bool>(), exact_optional_in(finding.at(2)),
                            exact_double_in(finding.at(3)), finding.at(4).get<int>()});
  }
  run.times_lost = member.at("times_lost").get<int>();
  return run;
}

SeedRun run_of_member(const Member& member) {
  SeedRun run;
  run.seed = member.at("seed").get<std::uint64_t>();
  run.simulated_s = exact_double_in(member.at("simulated_s"));
  run.path_length_m = exact_double_in(member.at("path_length_m"));
  run.method = member.at("method").get<std::string>();
  run.method_why = member.at("method_why").get<std::string>();
  run.outcomes = outcomes_in(member.at("outcomes"));
  run.errors_with_true_pose_m = numbers_of(member.at("errors_with_true_pose_m"));
  for (const Member& other : member.at("compared")) {
    run.compared.push_back({other.at(0).get<std::string>(), outcomes_in(other.at(1))});
  }
  const Member& navigation = member.at("navigation");
  if (!navigation.is_null()) run.navigation = navigation_in(navigation);
  const Member& inventory = member.at("inventory");
  if (!inventory.is_null()) run.inventory = inventory_from_json(inventory.dump(), "inventory");
  return run;
}

}  // namespace

std::string to_json_line(const SeedRun& run, const std::vector<std::string>& warnings) {
  Member compared = Member::array();
  for (const ComparedMethod& other : run.compared) {
    compared.push_back({other.method, member_of(other.outcomes)});
  }
  Member member = {{"seed", run.seed},
                   {"simulated_s", exact_json(run.simulated_s)},
                   {"path_length_m", exact_json(run.path_length_m)},
                   {"method", run.method},
                   {"method_why", run.method_why},
                   {"outcomes", member_of(run.outcomes)},
                   {"errors_with_true_pose_m", member_of(run.errors_with_true_pose_m)},
                   {"compared", std::move(compared)},
                   {"navigation", nullptr},
                   {"inventory", nullptr},
                   {"warnings", warnings}};
  if (run.navigation) member["navigation"] = member_of(*run.navigation);
  if (run.inventory) member["inventory"] = Member::parse(to_json(*run.inventory));
  return one_line_of(member);
}

KeptSeed kept_seed_in(std::string_view json, const Location& location) {
  try {
    const Member member = Member::parse(json.begin(), json.end());
    return {run_of_member(member), member.at("warnings").get<std::vector<std::string>>()};
  } catch (const std::exception&) {
    fail(location, "is not a run's result");
  }
}

}  // namespace tagfield
