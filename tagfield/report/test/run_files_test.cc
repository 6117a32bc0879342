// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/run_files.h"

#include <gtest/gtest.h>

#include "tagfield/base/error.h"
#include "tagfield/report/test/run_folder.h"

namespace tagfield {
namespace {

TEST(ReadRunFiles, TellsMovingAntennasFromFixedOnes) {
  const RunFolder folder(FolderPlan{});
  const RunFiles run = read_run_files(folder.path());
  ASSERT_EQ(run.tracks.size(), 2U);
  EXPECT_EQ(busiest_track(run, true)->antenna, "mobile");
  EXPECT_EQ(busiest_track(run, false)->antenna, "fixed");
  EXPECT_EQ(busiest_track(run, false)->reads.size(), 3U);
}

TEST(ReadRunFiles, TakesReadsInAnyOrder) {
  const RunFolder folder(FolderPlan{});
  folder.put("reads.csv",
             "stamp_s,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n"
             "2,mobile,tag1,865.7e6,1,-60\n1,mobile,tag1,865.7e6,1,-50\n1,other,tag1,9e8,1,-50\n");
  const RunFiles run = read_run_files(folder.path());
  const auto reads = reads_of(*busiest_track(run, true), "tag1");
  ASSERT_EQ(reads.size(), 2U);
  EXPECT_DOUBLE_EQ(reads[0]->rssi_dbm, -50.0);
}

TEST(ReadRunFiles, TakesTheBeliefThatTheTruePosesWereComparedWith) {
  FolderPlan plan;
  const RunFolder folder(plan);
  folder.put("compared_poses.csv",
             "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n0,mobile,7,0,0,0,0,0,1\n"
             "1,mobile,8,0,0,0,0,0,1\n");
  EXPECT_NE(busiest_track(read_run_files(folder.path()), true)->believed.size(), 2U);
  Summary summary = summary_of(plan);
  summary.compared_pose = ComparedPose{"tf", 0.1, std::nullopt, 0};
  folder.put("summary.json", to_json(summary));
  const RunFiles run = read_run_files(folder.path());
  EXPECT_EQ(busiest_track(run, true)->believed.size(), 2U);
  EXPECT_FALSE(busiest_track(run, false)->believed.empty());
}

TEST(ReadRunFiles, DoesWithoutTruthAndTopView) {
  FolderPlan plan;
  plan.truth = false;
  plan.top_view = false;
  const RunFolder folder(plan);
  const RunFiles run = read_run_files(folder.path());
  EXPECT_TRUE(run.top_view.empty());
  EXPECT_TRUE(run.true_positions.empty());
  EXPECT_TRUE(run.tracks.front().truth.empty());
}

TEST(ReadRunFiles, NamesTheFileThatIsBad) {
  for (const std::string name :
       {"summary.json", "reads.csv", "antenna_poses.csv", "top_view.json", "truth/tags.csv"}) {
    const RunFolder folder(FolderPlan{});
    folder.put(name, "nonsense");
    try {
      read_run_files(folder.path());
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(folder.path() + "/" + name, 0), 0U) << error.what();
    }
  }
}

TEST(BusiestTag, IsTheFirstInNaturalOrderAmongEquals) {
  FolderPlan plan;
  plan.tags = {"tag10", "tag9"};
  const RunFolder folder(plan);
  const RunFiles run = read_run_files(folder.path());
  EXPECT_EQ(busiest_tag(*busiest_track(run, true)), "tag9");
}

TEST(TruePlace, HoldsFromItsStampOn) {
  const RunFolder folder(FolderPlan{});
  folder.put("truth/tags.csv", "stamp_s,tag,x_m,y_m,z_m\n5,t,2,0,0\n1,t,1,0,0\n");
  const RunFiles run = read_run_files(folder.path());
  EXPECT_FALSE(true_position(run, "t", time_from_seconds(0.5)));
  EXPECT_DOUBLE_EQ(true_position(run, "t", time_from_seconds(1.0))->x(), 1.0);
  EXPECT_DOUBLE_EQ(true_position(run, "t", time_from_seconds(9.0))->x(), 2.0);
  EXPECT_FALSE(true_position(run, "u", time_from_seconds(9.0)));
}

}  // namespace
}  // namespace tagfield
