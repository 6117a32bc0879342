// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/tag_positions_csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "odd_names.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

using Places = std::map<std::string, Eigen::Vector3d>;

Places places_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_tag_positions_csv(folder.with("p.csv", text));
}

TEST(TagPlacesToCsv, WritesARowATag) {
  EXPECT_EQ(tag_positions_to_csv({{"t2", {1.5, -2.0, 0.25}}, {"t1", {0.0, 0.0, 2.0}}}),
            "tag,x_m,y_m,z_m\nt1,0,0,2\nt2,1.5,-2,0.25\n");
}

RC_GTEST_PROP(TagPlacesCsv, ReadsBackWhatItWrote, ()) {
  Places places;
  const auto count = *rc::gen::inRange(0, 8);
  for (int i = 0; i < count; ++i) {
    const double x = 0.1 * (*rc::gen::inRange(-100, 100));
    places[odd_name()] = {x, 1.0 / (1.0 + x * x), -x};
  }
  RC_ASSERT(places_of(tag_positions_to_csv(places)) == places);
}

TEST(ReadTagPlacesCsv, NamesColumnAndLineOfBadInput) {
  const auto complaint = [](const std::string& text) { return error_of([&] { places_of(text); }); };
  EXPECT_TRUE(contains(complaint("tag,x_m,y_m\na,1,2\n"), "p.csv:1: no column 'z_m'"));
  EXPECT_TRUE(contains(complaint("tag,x_m,y_m,z_m\na,1,far,3\n"), "p.csv:2: y_m"));
  EXPECT_TRUE(contains(complaint("tag,x_m,y_m,z_m\na,1,2,3\na,1,2,3\n"),
                       "p.csv:3: tag 'a' is listed twice"));
}

}  // namespace
}  // namespace tagfield
