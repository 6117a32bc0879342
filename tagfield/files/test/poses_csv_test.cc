// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/poses_csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "odd_names.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

const char* const kPosesHeader = "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n";

std::vector<AntennaPose> poses_of(const std::string& text, const std::string& who = "antenna") {
  const TemporaryFolder folder;
  return read_poses_csv(folder.with("p.csv", text), who);
}

AntennaPose any_pose() {
  const auto some = [] { return 1e-8 * (*rc::gen::inRange(-2'000'000'000, 2'000'000'001)) / 3.0; };
  AntennaPose pose;
  pose.stamp = Time(Duration(*rc::gen::arbitrary<std::int64_t>() / 2));
  pose.antenna = odd_name();
  pose.X_WA = from_xyz_rpy({some(), some(), some()}, {some(), some(), some()});
  return pose;
}

TEST(PosesToCsv, WritesADocumentedRow) {
  const AntennaPose pose = {Time(Duration(66'666'667)), "a", from_translation({1.0, -2.5, 0.25})};
  EXPECT_EQ(poses_to_csv({pose}),
            std::string(kPosesHeader) + "0.066666667,a,1,-2.5,0.25,0,0,0,1\n");
  EXPECT_EQ(poses_to_csv({}), kPosesHeader);
}

TEST(PosesCsv, KeepsCovariancesWhereTheyAreGiven) {
  AntennaPose with = {Time(Duration(1)), "a", from_translation({1.0, 2.0, 3.0})};
  with.covariance.emplace();
  *with.covariance << 4.0, 0.1, 0.2, 0.1, 5.0, 0.3, 0.2, 0.3, 6.0;
  AntennaPose without = with;
  without.covariance.reset();
  const auto poses = poses_of(poses_to_csv({with, without}));
  ASSERT_TRUE(poses[0].covariance.has_value());
  EXPECT_TRUE(*poses[0].covariance == *with.covariance);
  EXPECT_FALSE(poses[1].covariance.has_value());
}

TEST(PosesCsv, RefusesNegativeVariances) {
  const std::string header =
      "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw,cov_xx,cov_xy,cov_xyaw,cov_yy,cov_yyaw,cov_yawyaw\n";
  EXPECT_NE(error_of([&] {
              poses_of(header + "0,a,0,0,0,0,0,0,1,-1,0,0,1,0,1\n");
            }).find(":2: cov_xx, cov_yy and cov_yawyaw are variances"),
            std::string::npos);
}

RC_GTEST_PROP(PosesCsv, ReadsBackWhatItWrote, ()) {
  const AntennaPose pose = any_pose();
  const auto who = *rc::gen::elementOf(std::vector<std::string>{"antenna", "robot"});
  const auto poses = poses_of(poses_to_csv({pose, pose}, who), who);
  RC_ASSERT(poses.size() == 2u);
  RC_ASSERT(poses[1].stamp == pose.stamp);
  RC_ASSERT(poses[1].antenna == pose.antenna);
  const RigidTransform& X = poses[1].X_WA;
  RC_ASSERT(X.translation == pose.X_WA.translation);
  RC_ASSERT(X.rotation.coeffs() == pose.X_WA.rotation.coeffs());
}

TEST(ReadPosesCsv, TakesQuaternionsAsXyzw) {
  const auto poses = poses_of(std::string(kPosesHeader) + "1,a,0,0,0,0,0,1,0\n");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].X_WA.rotation.z(), 1.0);
  EXPECT_NEAR(std::abs(yaw_of(poses[0].X_WA.rotation)), std::acos(-1.0), 1e-15);
}

TEST(ReadPosesCsv, NormalizesRoundedQuaternions) {
  const auto poses = poses_of(std::string(kPosesHeader) + "1,a,0,0,0,0,0,0.71,0.71\n");
  EXPECT_NEAR(poses.at(0).X_WA.rotation.norm(), 1.0, 1e-15);
  EXPECT_NO_THROW(poses_of(std::string(kPosesHeader) + "1,a,0,0,0,0,0,0,1.099\n"));
  EXPECT_NO_THROW(poses_of(std::string(kPosesHeader) + "1,a,0,0,0,0,0,0,-0.901\n"));
}

TEST(ReadPosesCsv, RefusesQuaternionsFarFromUnit) {
  for (const char* q : {"0,0,0,0", "0,0,0,1.11", "0,0,0,0.89", "1,1,1,1", "1e200,0,0,0"}) {
    const std::string text = std::string(kPosesHeader) + "1,a,0,0,0,0,0,0,1\n2,a,0,0,0," + q + "\n";
    const std::string message = error_of([&] { poses_of(text); });
    EXPECT_TRUE(contains(message, "p.csv:3: qx,qy,qz,qw has length")) << q << ": " << message;
  }
}

TEST(ReadPosesCsv, NamesColumnAndLineOfBadInput) {
  EXPECT_TRUE(contains(error_of([] { poses_of("stamp_s,antenna\n"); }), "no column 'x_m'"));
  EXPECT_TRUE(contains(error_of([] { poses_of(kPosesHeader, "robot"); }), "no column 'robot'"));
  const std::string header = kPosesHeader;
  EXPECT_TRUE(contains(error_of([&] { poses_of(header + "1,a,x,0,0,0,0,0,1\n"); }), ":2: x_m is"));
  EXPECT_TRUE(contains(error_of([&] { poses_of(header + "1,a,0,nan,0,0,0,0,1\n"); }), "y_m is"));
  EXPECT_TRUE(contains(error_of([&] { poses_of(header + "1,,0,0,0,0,0,0,1\n"); }), "is empty"));
  EXPECT_TRUE(contains(error_of([&] { poses_of(header + "?,a,0,0,0,0,0,0,1\n"); }), "stamp_s: "));
}

}  // namespace
}  // namespace tagfield
