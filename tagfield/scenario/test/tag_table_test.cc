// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/tag_table.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

std::string write_table(const std::string& text) {
  return folder_of_test().with("tag_table.csv", text);
}

std::vector<TagSpec> read(const std::string& path) {
  Diagnostics unheard;
  return read_tag_table(path, nullptr, unheard);
}

TEST(TagTable, GivesATagARow) {
  const auto tags = read(write_table("tag,x_m,y_m,z_m\nE200,1,2,3\nE201,-1,0,0.5\n"));
  ASSERT_EQ(tags.size(), 2U);
  EXPECT_EQ(tags[1].id, "E201");
  EXPECT_EQ(tags[1].motion.front().X_WB.translation, Eigen::Vector3d(-1.0, 0.0, 0.5));
  EXPECT_EQ(tags[1].location.line, 3);
}

TEST(TagTable, HasOrientationAndKind) {
  const auto tags =
      read(write_table("tag,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,profile\na,1,2,3,0,0,1."
                       "5707963267948966,monza_r6\n"
                       "b,1,2,3,0,0,0,\n"));
  ASSERT_EQ(tags.size(), 2U);
  // The tag's normal points along y.
  EXPECT_TRUE((tags[0].motion.front().X_WB.rotation * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  ASSERT_NE(tags[0].model, nullptr);
  EXPECT_EQ(tags[0].model->name, "monza_r6");
  EXPECT_EQ(tags[1].model, nullptr);
}

TEST(TagTable, SaysWhichColumnsAreNotUsed) {
  Diagnostics diagnostics;
  const std::string path = write_table("tag,x_m,y_m,z_m,profle\na,1,2,3,monza_r6\n");
  EXPECT_EQ(read_tag_table(path, nullptr, diagnostics).size(), 1U);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(
      diagnostics.warnings().front().find("column 'profle' is not used (did you mean 'profile'?)"),
      std::string::npos);
}

TEST(TagTable, RefusesHalfAnOrientationAndUnknownKinds) {
  const auto complaint = [](const std::string& text) {
    try {
      read(write_table(text));
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(complaint("tag,x_m,y_m,z_m,yaw_rad\na,1,2,3,0\n").find("roll_rad"), std::string::npos);
  EXPECT_NE(complaint("tag,x_m,y_m,z_m,profile\na,1,2,3,monza_r7\n").find("'monza_r6'"),
            std::string::npos);
}

TEST(TagTable, ComplainsByLine) {
  const std::string path = write_table("tag,x_m,y_m,z_m\na,1,2,3\nb,1,nan,3\n");
  try {
    read(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("tag_table.csv:3: y_m"), std::string::npos);
  }
}

}  // namespace
}  // namespace tagfield
