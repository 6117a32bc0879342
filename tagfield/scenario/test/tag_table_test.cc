#include "tagfield/scenario/internal/tag_table.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

std::string write_table(const std::string& text) {
  return folder_of_test().with("tag_table.csv", text);
}

TEST(TagTable, GivesATagARow) {
  const auto tags = read_tag_table(write_table("tag,x_m,y_m,z_m\nE200,1,2,3\nE201,-1,0,0.5\n"));
  ASSERT_EQ(tags.size(), 2U);
  EXPECT_EQ(tags[1].id, "E201");
  EXPECT_EQ(tags[1].motion.front().X_WB.translation, Eigen::Vector3d(-1.0, 0.0, 0.5));
  EXPECT_EQ(tags[1].location.line, 3);
}

TEST(TagTable, ComplainsByLine) {
  const std::string path = write_table("tag,x_m,y_m,z_m\na,1,2,3\nb,1,nan,3\n");
  try {
    read_tag_table(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("tag_table.csv:3: y_m"), std::string::npos);
  }
}

}  // namespace
}  // namespace tagfield
