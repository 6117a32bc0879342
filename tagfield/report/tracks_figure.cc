// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/tracks_figure.h"

#include <algorithm>
#include <map>

#include "tagfield/report/axes.h"
#include "tagfield/report/svg.h"

namespace tagfield {
namespace {

constexpr double kTracksLeft = 50.0;
constexpr double kTracksTop = 60.0;
constexpr double kPlotHeight = 300.0;

struct Bounds {
  double low[2] = {1e300, 1e300};
  double high[2] = {-1e300, -1e300};
};

void take_in(const Eigen::Vector3d& p, Bounds& box) {
  for (int i = 0; i < 2; ++i) {
    box.low[i] = std::min(box.low[i], p(i));
    box.high[i] = std::max(box.high[i], p(i));
  }
}

Bounds bounds_of(const std::vector<TagTrack>& tracks, const std::vector<AntennaPose>& antennas) {
  Bounds box;
  for (const AntennaPose& pose : antennas) take_in(pose.X_WA.translation, box);
  for (const TagTrack& tag : tracks) {
    if (tag.tracks.empty()) continue;
    for (const TrackPoint& point : tag.tracks.front().points) take_in(point.p_WT, box);
  }
  if (box.low[0] > box.high[0]) take_in(Eigen::Vector3d::Zero(), box);
  for (int i = 0; i < 2; ++i) {
    box.low[i] -= 0.2;
    box.high[i] += 0.2;
  }
  return box;
}

/// True places by tag, only of the time in which the tag was tracked.
std::map<std::string, std::vector<Place>> true_ways(const std::vector<TagTrack>& tracks,
                                                    const Truth& truth, const Axes& axes) {
  std::map<std::string, std::pair<Time, Time>> spans;
  for (const TagTrack& tag : tracks) {
    if (tag.tracks.empty() || tag.tracks.front().points.empty()) continue;
    const auto& points = tag.tracks.front().points;
    spans[tag.tag] = {points.front().stamp, points.back().stamp};
  }
  std::map<std::string, std::vector<Place>> ways;
  for (const TagPosition& row : truth.tag_positions) {
    const auto span = spans.find(row.tag);
    if (span == spans.end()) continue;
    if (row.stamp < span->second.first || row.stamp > span->second.second) continue;
    ways[row.tag].push_back(place_in(axes, row.p_WT.x(), row.p_WT.y()));
  }
  return ways;
}

}  // namespace

std::string tracks_figure(const std::vector<TagTrack>& tracks,
                          const std::vector<AntennaPose>& antennas, const Truth& truth) {
  const Bounds box = bounds_of(tracks, antennas);
  Axes axes;
  axes.x = tight_scale(box.low[0], box.high[0], 6);
  axes.y = tight_scale(box.low[1], box.high[1], 6);
  axes.x.from = kTracksLeft;
  axes.x.to = kDrawingWidth - 15.0;
  axes.y.from = kTracksTop + kPlotHeight;
  axes.y.to = kTracksTop;
  Svg svg;
  svg.height = kTracksTop + kPlotHeight + 50.0;
  draw_axes(svg, axes, "x [m]", "y [m]");
  for (const auto& [tag, way] : true_ways(tracks, truth, axes)) {
    add_polyline(svg, way, stroked("#909090", 0.8, 3.0));
  }
  for (const TagTrack& tag : tracks) {
    if (tag.tracks.empty()) continue;
    std::vector<Place> places;
    for (const TrackPoint& point : tag.tracks.front().points) {
      places.push_back(place_in(axes, point.p_WT.x(), point.p_WT.y()));
    }
    const bool sure = tag.verdict == TrackVerdict::kTracked;
    add_polyline(svg, places, stroked(sure ? "#0060c0" : "#c07000", 0.9, 1.2));
  }
  std::map<std::string, Place> places;
  for (const AntennaPose& pose : antennas) {
    places.emplace(pose.antenna,
                   place_in(axes, pose.X_WA.translation.x(), pose.X_WA.translation.y()));
  }
  for (const auto& [antenna, place] : places) {
    add_diamond(svg, place, 6.0, filled("#b00020", 1.0), antenna);
    add_rimmed_text(svg, place + Place(8.0, 4.0), antenna, Anchor::kStart);
  }
  return standalone_svg(svg, "Tracks from above",
                        "Tracks of the tags (blue; orange: ambiguous), where they truly went "
                        "(grey), and the antennas (red).");
}

}  // namespace tagfield
