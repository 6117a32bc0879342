// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/tracks_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tagfield/report/axes.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/map_view.h"
#include "tagfield/report/style_sheet.h"
#include "tagfield/report/svg.h"

namespace tagfield {
namespace {

constexpr double kTracksLeft = 50.0;
constexpr double kTracksTop = 66.0;
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

/// True positions by tag, only during the time in which the tag was tracked.
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

constexpr std::size_t kMaxSpeeds = 12;  ///< Tags with their own colours and names.

const std::vector<TrackPoint>* points_of(const TagTrack& tag) {
  if (tag.tracks.empty() || tag.tracks.front().points.empty()) return nullptr;
  return &tag.tracks.front().points;
}

/// The step by which all tracks are thinned to about 2 kMaxMarks points in total.
std::size_t thinning_of(const std::vector<TagTrack>& tracks) {
  std::size_t count = 0;
  for (const TagTrack& tag : tracks) {
    if (const auto* points = points_of(tag)) count += points->size();
  }
  return thinning(count, 2 * kMaxMarks);
}

std::string tracks_data(const std::vector<TagTrack>& tracks, std::size_t step) {
  std::string csv = "tag,time_s,x_m,y_m,z_m,vx_m_s,vy_m_s\n";
  for (const TagTrack& tag : tracks) {
    const auto* points = points_of(tag);
    for (std::size_t i = 0; points != nullptr && i < points->size(); i += step) {
      const TrackPoint& point = (*points)[i];
      add_data(csv, tag.tag, format_stamp(point.stamp), point.p_WT.x(), point.p_WT.y(),
               point.p_WT.z(), point.v_WT.x(), point.v_WT.y());
    }
  }
  return csv;
}

/// The part of the line that is within the axes.
std::optional<std::pair<Place, Place>> drawn_line(const PassingLine& line, const Axes& axes) {
  const Eigen::Vector2d along(std::cos(line.heading_rad), std::sin(line.heading_rad));
  double from = -1e300;
  double to = 1e300;
  for (int i = 0; i < 2; ++i) {
    const Scale& scale = i == 0 ? axes.x : axes.y;
    const double low = scale.low - line.point(i);
    const double high = scale.high - line.point(i);
    if (std::abs(along(i)) < 1e-9) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    from = std::max(from, std::min(low / along(i), high / along(i)));
    to = std::min(to, std::max(low / along(i), high / along(i)));
  }
  if (from >= to) return std::nullopt;
  const auto at = [&](double distance_m) {
    const Eigen::Vector2d p = line.point + distance_m * along;
    return place_in(axes, p.x(), p.y());
  };
  return std::pair(at(from), at(to));
}

std::vector<LegendEntry> tracks_legend(const std::vector<TagTrack>& tracks, bool truth_known,
                                       bool line_shown) {
  std::vector<LegendEntry> legend;
  const auto any = [&](TrackVerdict verdict) {
    return std::any_of(tracks.begin(), tracks.end(), [&](const TagTrack& tag) {
      return points_of(tag) != nullptr && tag.verdict == verdict;
    });
  };
  if (any(TrackVerdict::kTracked)) legend.push_back({Symbol::kLine, "line0", "track"});
  if (any(TrackVerdict::kAmbiguous)) {
    legend.push_back({Symbol::kLine, "line1", "ambiguous: most likely"});
  }
  if (truth_known) legend.push_back({Symbol::kLine, "true-line", "true path"});
  if (line_shown) legend.push_back({Symbol::kLine, "rule", "line that tags pass"});
  legend.push_back({Symbol::kDiamond, "ink", "antenna"});
  return legend;
}

void draw_tracks(Svg& svg, const Axes& axes, const std::vector<TagTrack>& tracks,
                 std::size_t step) {
  for (const TagTrack& tag : tracks) {
    const auto* points = points_of(tag);
    if (points == nullptr) continue;
    std::vector<Place> places;
    for (std::size_t i = 0; i < points->size(); i += step) {
      places.push_back(place_in(axes, (*points)[i].p_WT.x(), (*points)[i].p_WT.y()));
    }
    const bool sure = tag.verdict == TrackVerdict::kTracked;
    add_polyline(svg, places, styled(sure ? "line0" : "line1"));
    add_circle(svg, places.back(), 3.0, styled(sure ? "line0" : "line1"),
               clean_text(tag.tag) + ": its last read");
  }
}

void draw_antennas_of_tracks(Svg& svg, const Axes& axes, const std::vector<AntennaPose>& antennas) {
  std::map<std::string, Place> places;
  for (const AntennaPose& pose : antennas) {
    const Eigen::Vector3d& p = pose.X_WA.translation;
    places.emplace(pose.antenna, place_in(axes, p.x(), p.y()));
  }
  MapView map;
  map.axes = axes;
  for (const auto& [antenna, place] : places) {
    add_diamond(svg, place, 7.0, styled("ink"), clean_text(antenna));
    take_place(map, place, 8.0);
  }
  if (places.size() > kMaxRows) return;
  for (const auto& [antenna, place] : places) {
    draw_label(svg, map, place, shortened(antenna, 18));
  }
}

}  // namespace

Figure tracks_figure(const std::vector<TagTrack>& tracks, const std::vector<AntennaPose>& antennas,
                     const Truth& truth, const std::optional<PassingLine>& line) {
  Figure figure{"tracks", "", "Tracks from above", "", {}, ""};
  const Bounds box = bounds_of(tracks, antennas);
  Axes axes;
  axes.x = tight_scale(box.low[0], box.high[0], 6);
  axes.y = tight_scale(box.low[1], box.high[1], 6);
  axes.x.from = kTracksLeft;
  axes.x.to = kDrawingWidth - 15.0;
  axes.y.from = kTracksTop + kPlotHeight;
  axes.y.to = kTracksTop;
  Svg& svg = figure.svg;
  svg.height = kTracksTop + kPlotHeight + 50.0;
  const auto ways = true_ways(tracks, truth, axes);
  const std::size_t step = thinning_of(tracks);
  const auto passed = line ? drawn_line(*line, axes) : std::nullopt;
  draw_legend(svg, tracks_legend(tracks, !ways.empty(), passed.has_value()));
  draw_axes(svg, axes, "x [m]", "y [m]");
  if (passed) {
    add_line(svg, passed->first, passed->second, styled("rule"), "the line that tags pass");
  }
  for (const auto& [tag, way] : ways) add_polyline(svg, way, styled("true-line"));
  draw_tracks(svg, axes, tracks, step);
  draw_antennas_of_tracks(svg, axes, antennas);
  figure.caption =
      "Each tag’s most likely track from its first read to its last, which is a ring. x and y have "
      "different scales.";
  if (passed) figure.caption += " Dashed: the line at which their order is counted.";
  if (step > 1) figure.caption += fmt::format(" One point in {} is drawn.", step);
  figure.data = tracks_data(tracks, step);
  return figure;
}

Figure speeds_figure(const std::vector<TagTrack>& tracks) {
  Figure figure{"speeds", "", "Speed over time", "", {}, ""};
  std::vector<const TagTrack*> followed;
  std::vector<double> times;
  std::vector<double> speeds;
  for (const TagTrack& tag : tracks) {
    const auto* points = points_of(tag);
    if (points == nullptr) continue;
    followed.push_back(&tag);
    for (const TrackPoint& point : *points) {
      times.push_back(to_seconds(point.stamp));
      speeds.push_back(point.v_WT.head<2>().norm());
    }
  }
  if (followed.empty()) {
    figure.missing = "no tag was tracked.";
    return figure;
  }
  Svg& svg = figure.svg;
  const bool named = followed.size() <= kMaxSpeeds;
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; named && i < followed.size(); ++i) {
    legend.push_back({Symbol::kLine, fmt::format("line{} tag{}", i % kSeriesColors, i),
                      shortened(followed[i]->tag, 16)});
  }
  const double top = named ? draw_legend(svg, legend) : 0.0;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const auto [slowest, fastest] = std::minmax_element(speeds.begin(), speeds.end());
  const double margin = std::max(0.02 * *fastest, 1e-3);  // Noise alone should not fill the axis.
  Axes axes{tight_scale(*first, std::max(*last, *first + 1e-3), 6),
            round_scale(std::max(*slowest - margin, 0.0), *fastest + margin, 5)};
  axes.x.from = 58.0;
  axes.x.to = kDrawingWidth - 20.0;
  axes.y.to = top + 30.0;
  axes.y.from = axes.y.to + 230.0;
  svg.height = axes.y.from + 48.0;
  draw_axes(svg, axes, "time [s]", "level speed [m/s]");
  const std::size_t step = thinning_of(tracks);
  for (std::size_t i = 0; i < followed.size(); ++i) {
    const std::vector<TrackPoint>& points = *points_of(*followed[i]);
    std::vector<Place> places;
    for (std::size_t k = 0; k < points.size(); k += step) {
      places.push_back(
          place_in(axes, to_seconds(points[k].stamp), points[k].v_WT.head<2>().norm()));
    }
    add_polyline(svg, places, styled(fmt::format("line{} tag{}", i % kSeriesColors, i)));
  }
  figure.caption = "Of each tag’s most likely track, as smoothed over all of its reads.";
  if (step > 1) figure.caption += fmt::format(" One point in {} is drawn.", step);
  figure.data = tracks_data(tracks, step);
  return figure;
}

}  // namespace tagfield
