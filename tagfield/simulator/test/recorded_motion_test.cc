// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/recorded_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/files/files.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/truth_csv.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/simulator/test/recorded.h"
#include "tagfield/stream/recording.h"

namespace tagfield {
namespace {

std::string temp(const std::string& name) { return folder_of_test().file(name); }

std::string write(const std::string& name, const std::string& text) {
  return folder_of_test().with(name, text);
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

constexpr const char* kPoses = "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n";

TEST(ReadRecordedAntenna, TakesTheRowsOfThatAntenna) {
  const std::string path = write("poses.csv", std::string(kPoses) +
                                                  "0.1,a,1,2,3,0,0,0,1\n"
                                                  "0.15,b,9,9,9,0,0,0,1\n"
                                                  "0.2,a,4,5,6,0,0,1,0\n");
  const Trajectory trajectory = read_recorded_antenna(path, "a");
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[1].stamp, time_from_seconds(0.2));
  EXPECT_EQ(trajectory[1].X_WB.translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(trajectory[1].X_WB.rotation.z(), 1.0);
}

TEST(ReadRecordedAntenna, SaysWhatIsWrong) {
  const std::string path =
      write("poses.csv", std::string(kPoses) + "0.2,a,1,2,3,0,0,0,1\n0.2,a,1,2,3,0,0,0,1\n");
  EXPECT_EQ(message_of([&] { read_recorded_antenna(path, "b"); }),
            path + ": has no poses of antenna 'b'");
  EXPECT_NE(message_of([&] { read_recorded_antenna(path, "a"); }).find(path + ": antenna 'a'"),
            std::string::npos);
}

TEST(ReplayTags, GivesListedAndNewTagsTheirRows) {
  const std::string path = write("tags.csv",
                                 "stamp_s,tag,x_m,y_m,z_m\n"
                                 "0,listed,1,0,0\n"
                                 "0.5,new,5,0,0\n"
                                 "1,listed,1,0,0\n"
                                 "2,listed,2,0,0\n");
  std::vector<TagSpec> tags = {tag_at("other", {7, 7, 7}), tag_at("listed", {9, 9, 9})};
  tags[1].on = "robot";
  replay_tags(path, tags);
  ASSERT_EQ(tags.size(), 3U);
  EXPECT_FALSE(moves(tags[0]));
  EXPECT_EQ(tags[0].motion.front().X_WB.translation.x(), 7.0);
  EXPECT_EQ(tags[1].on, "");
  ASSERT_EQ(tags[1].motion.size(), 2U);  // the second row repeats the first
  EXPECT_EQ(tags[1].motion[1].stamp, time_from_seconds(2.0));
  EXPECT_EQ(tags[2].id, "new");
  EXPECT_EQ(tags[2].appears, time_from_seconds(0.5));
  EXPECT_FALSE(moves(tags[2]));
}

TEST(ReplayTags, RefusesStampsThatDoNotRise) {
  const std::string path =
      write("tags.csv", "stamp_s,tag,x_m,y_m,z_m\n1,a,0,0,0\n0.5,b,0,0,0\n1,a,0,0,0\n");
  std::vector<TagSpec> tags;
  EXPECT_EQ(message_of([&] { replay_tags(path, tags); }),
            path + ":4: stamps of tag 'a' must rise from row to row");
}

TEST(Replay, AntennaUpdatesAtItsRowsAndNowhereElse) {
  const std::string poses = write("poses.csv", std::string(kPoses) +
                                                   "0.010100000,a,0,0,1,0,0,0,1\n"
                                                   "0.010200000,a,1,0,1,0,0,0,1\n"
                                                   "0.900000000,a,2,0,1,0,0,0,1\n");
  write("scenario.yaml",
        "antennas: [{name: a, recorded: poses.csv, rate_hz: 100}]\n"
        "tags: [{id: t, position: [0, 1, 1]}]\n");
  const Scenario scenario = load_scenario(temp("scenario.yaml"), {});
  const Recording recording = recorded_run(scenario);
  EXPECT_EQ(poses_to_csv(recording.truth.antenna_poses), read_text_file(poses));
  ASSERT_EQ(recording.reads.size(), 3U);
  EXPECT_EQ(recording.reads[2].stamp, time_from_seconds(0.9));
  EXPECT_NEAR(recording.truth.distances[1].distance_m, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(recording.truth.distances[2].distance_m, std::sqrt(5.0), 1e-12);
}

TEST(Replay, TagHoldsItsPlaceUntilItsNextRow) {
  write("tags.csv", "stamp_s,tag,x_m,y_m,z_m\n0.15,t,1,0,0\n0.4,t,3,0,0\n");
  write("scenario.yaml",
        "duration_s: 0.6\nantennas: [{name: a, pose: [0, 0, 0], rate_hz: 10}]\n"
        "tag_recording: tags.csv\n");
  const Recording recording = recorded_run(load_scenario(temp("scenario.yaml"), {}));
  std::vector<double> distances;
  for (const TrueDistance& distance : recording.truth.distances) {
    distances.push_back(distance.distance_m);
  }
  EXPECT_EQ(distances, (std::vector<double>{1.0, 1.0, 3.0, 3.0}));  // at 0.2, 0.3, 0.4, 0.5 s
}

constexpr const char* kDriving = R"(seed: 5
time_step_s: 0.013
robots:
  - {name: r, start: [0, 0, 0.3], waypoints: [[2, 0.5], [2, 2]]}
antennas:
  - {name: up, on: r, pose: [0.1, 0, 0.5, 0.1, 0.2, 0.3], lift: {travel_m: 0.7}}
  - {name: slow, on: r, pose: [0, 0.1, 1.5], rate_hz: 7}
tags:
  - {id: rest, position: [2, 3, 1.1]}
  - {id: load, on: r, position: [0.2, 0, 0.4]}
  - {id: moving, trajectory: [[0, 0, 3, 1], [7, 4, 3, 1.5]]}
  - {id: late, position: [1, -1, 1], appears_s: 2.0001}
)";

/// A run's recorded ground truth, replayed without robots, reproduces its reads bit for bit.
TEST(Replay, OfARunGivesItsReads) {
  write("scenario.yaml", kDriving);
  const Scenario scenario = load_scenario(temp("scenario.yaml"), {});
  const Recording first = recorded_run(scenario);
  ASSERT_GT(first.reads.size(), 300U);
  write("poses.csv", poses_to_csv(first.truth.antenna_poses));
  StagedFolder folder(temp("run"));
  stage_truth(first.truth, folder);
  folder.commit();
  std::string yaml = kDriving;
  yaml.erase(yaml.find("robots:"), yaml.find("antennas:") - yaml.find("robots:"));
  yaml.erase(yaml.find("tags:"));
  yaml += "tag_recording: run/truth/tags.csv\n";
  write("replay.yaml", yaml);
  const std::vector<Override> overrides = {
      {"antennas.up.recorded", temp("run/truth/antenna_poses.csv")},
      {"antennas.slow.recorded", temp("run/truth/antenna_poses.csv")}};
  const Recording second = recorded_run(load_scenario(temp("replay.yaml"), overrides));
  EXPECT_EQ(reads_to_csv(second.reads), reads_to_csv(first.reads));
  EXPECT_EQ(poses_to_csv(second.truth.antenna_poses), poses_to_csv(first.truth.antenna_poses));
}

TEST(Replay, NeedsNoDurationOnlyIfAnAntennaIsRecorded) {
  const std::string poses = write("poses.csv", std::string(kPoses) + "0.25,a,1,2,3,0,0,0,1\n");
  write("scenario.yaml",
        "antennas: [{name: a, pose: [0, 0, 1]}]\ntags: [{id: t, position: [0, 1, 1]}]\n");
  Diagnostics diagnostics;
  EXPECT_NE(message_of([&] {
              load_scenario_with_world(temp("scenario.yaml"), {}, diagnostics);
            }).find("has no 'duration_s'"),
            std::string::npos);
  const ScenarioWithWorld loaded = load_scenario_with_world(
      temp("scenario.yaml"), {{"antennas.a.recorded", poses}}, diagnostics);
  EXPECT_EQ(recorded_run(loaded.scenario).reads.size(), 1U);
}

}  // namespace
}  // namespace tagfield
