// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/tracks_figure.h"

#include <gtest/gtest.h>

#include "tagfield/report/test/text_holds.h"

namespace tagfield {
namespace {

constexpr const char* kName = "line that tags pass";

/// One track along x from −1 to 1 m.
std::vector<TagTrack> one_track() {
  TagTrack tag;
  tag.tag = "tag1";
  tag.verdict = TrackVerdict::kTracked;
  Track track;
  for (const double x : {-1.0, 0.0, 1.0}) {
    TrackPoint point;
    point.stamp = time_from_seconds(x + 1.0);
    point.p_WT = {x, 0.0, 0.0};
    track.points.push_back(point);
  }
  tag.tracks = {track};
  return {tag};
}

TEST(TracksFigure, DrawsAndNamesTheLine) {
  const Figure figure = tracks_figure(one_track(), {}, {}, PassingLine{{0.0, 5.0}, 1.5707963});
  // In the middle of the axes from 50 to 545, from top to bottom.
  EXPECT_TRUE(holds(figure.svg.body,
                    "<line x1=\"297.5\" y1=\"366\" x2=\"297.5\" y2=\"66\" class=\"rule\">"));
  EXPECT_TRUE(holds(figure.svg.body, kName));
  EXPECT_TRUE(holds(figure.caption, "Dashed"));
}

TEST(TracksFigure, DrawsNoLineThatIsNotGivenOrFarAway) {
  for (const std::optional<PassingLine>& line :
       {std::optional<PassingLine>(), std::optional(PassingLine{{3.0, 0.0}, 1.5707963}),
        std::optional(PassingLine{{0.0, 9.0}, 0.0})}) {
    const Figure figure = tracks_figure(one_track(), {}, {}, line);
    EXPECT_FALSE(holds(figure.svg.body, kName));
    EXPECT_FALSE(holds(figure.caption, "Dashed"));
  }
}

}  // namespace
}  // namespace tagfield
