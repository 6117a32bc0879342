// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/truth_csv.h"

#include <gtest/gtest.h>

#include "tagfield/base/error.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

TEST(Truth, ComesBackTheSame) {
  const TemporaryFolder run;
  Truth truth;
  truth.antenna_poses = {{time_from_seconds(1.5), "a", from_translation({1.0, 2.0, 3.0})}};
  truth.robot_poses = {{time_from_seconds(2.5), "r", from_planar(1.0, 2.0, 0.5)}};
  truth.tag_positions = {{time_from_seconds(0.25), "a,\"b\"", {-1.0, 0.1 + 0.2, 2.0 / 3.0}}};
  truth.distances = {{time_from_seconds(0.25), "a", "t", 1.25}};
  StagedFolder folder(run.path());
  stage_truth(truth, folder);
  folder.commit();
  const Truth after = read_truth(run.path().string());
  ASSERT_EQ(after.antenna_poses.size(), 1U);
  EXPECT_EQ(after.antenna_poses[0].antenna, "a");
  ASSERT_EQ(after.robot_poses.size(), 1U);
  EXPECT_NEAR(yaw_of(after.robot_poses[0].X_WA.rotation), 0.5, 1e-8);
  ASSERT_EQ(after.tag_positions.size(), 1U);
  EXPECT_EQ(after.tag_positions[0].tag, "a,\"b\"");
  EXPECT_EQ(after.tag_positions[0].stamp, time_from_seconds(0.25));
  EXPECT_EQ(after.tag_positions[0].p_WT, truth.tag_positions[0].p_WT);
  EXPECT_EQ(run.text_of("truth/distances.csv"),
            "stamp_s,antenna,tag,distance_m\n0.250000000,a,t,1.25\n");
}

TEST(ReadTruth, NamesTheFileThatIsMissing) {
  const TemporaryFolder run;
  StagedFolder folder(run.path());
  stage_truth({}, folder);
  folder.commit();
  std::filesystem::remove(run.path() / "truth/tags.csv");
  try {
    read_truth(run.path().string());
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("truth/tags.csv"), std::string::npos);
  }
}

}  // namespace
}  // namespace tagfield
