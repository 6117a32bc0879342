// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/odometry_csv.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

constexpr const char* kHeader = "antenna,x_m,y_m,z_m,qx,qy,qz,qw,alpha1,alpha2,alpha3,alpha4\n";

TEST(OdometryCsv, IsReadAsWritten) {
  OdometryByAntenna odometry;
  odometry["le,ft"] = {from_xyz_rpy({0.3, -0.1, 1.0}, {0.1, 0.2, 0.5}), {0.02, 0.009, 0.01, 0.002}};
  odometry["right"] = {RigidTransform{}, {0.0, 0.0, 0.0, 0.0}};
  const TemporaryFolder folder;
  const auto read = read_odometry_csv(folder.with("odometry.csv", odometry_to_csv(odometry)));
  ASSERT_EQ(read.size(), 2U);
  for (const auto& [antenna, of] : odometry) {
    EXPECT_TRUE(read.at(antenna).X_PA.translation.isApprox(of.X_PA.translation)) << antenna;
    EXPECT_TRUE(read.at(antenna).X_PA.rotation.isApprox(of.X_PA.rotation)) << antenna;
    EXPECT_EQ(read.at(antenna).noise.alpha1, of.noise.alpha1) << antenna;
    EXPECT_EQ(read.at(antenna).noise.alpha2, of.noise.alpha2) << antenna;
    EXPECT_EQ(read.at(antenna).noise.alpha3, of.noise.alpha3) << antenna;
    EXPECT_EQ(read.at(antenna).noise.alpha4, of.noise.alpha4) << antenna;
  }
}

TEST(OdometryCsv, RefusesWhatMakesNoSense) {
  const TemporaryFolder folder;
  const auto error_in = [&](const std::string& rows) {
    const std::string file = folder.with("odometry.csv", kHeader + rows);
    return error_of([&] { read_odometry_csv(file); });
  };
  EXPECT_NE(error_in("a,0,0,1,0,0,0,1,0.1,0,0,0\na,0,0,1,0,0,0,1,0.1,0,0,0\n").find(":3: antenna"),
            std::string::npos);
  EXPECT_NE(error_in("a,0,0,1,0,0,0,2,0.1,0,0,0\n").find("expected 1"), std::string::npos);
  EXPECT_NE(error_in("a,0,0,1,0,0,0,1,-0.1,0,0,0\n").find(":2: "), std::string::npos);
}

}  // namespace
}  // namespace tagfield
