// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/localization/phase_curves/hyperbola.h"
#include "tagfield/localization/phase_curves/unwrap.h"
#include "tagfield/report/axes.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/figure_data.h"

namespace tagfield {
namespace {

constexpr double kPhaseTop = 58.0;
constexpr std::size_t kMaxRules = 40;
constexpr std::size_t kFewReads =
    8;  ///< Shorter segments, as at the limit of the range, are only clutter.

/// A sample as drawn.
struct PhasePoint {
  double time_s = 0.0;  ///< Since the first read of the tag.
  double measured_m = 0.0;
  std::optional<double> true_m;  ///< True distance, shifted to agree in the segment's mean.
};
using Segment = std::vector<PhasePoint>;

std::optional<double> true_distance(const RunFiles& run, const AntennaTrack& track,
                                    const std::string& tag, Time stamp) {
  const auto p_WT = true_position(run, tag, stamp);
  const auto X_WA = pose_at(track.truth, stamp);
  if (!p_WT || !X_WA) return std::nullopt;
  return (*p_WT - X_WA->translation).norm();
}

std::vector<PhaseSegment> segments_of(const AntennaTrack& track, const std::string& tag) {
  const SamplesByTag samples = believed_samples(track, reads_of(track, tag));
  const auto of_tag = samples.find(tag);
  if (of_tag == samples.end() || of_tag->second.empty()) return {};
  return unwrap(of_tag->second.begin()->second, HyperbolaOptions{}.max_step);
}

/// The phase gives only changes, so the true distance is shifted to agree in the segment's mean.
void align_truth(Segment& segment) {
  double sum = 0.0;
  std::size_t known = 0;
  for (const PhasePoint& point : segment) {
    if (!point.true_m) continue;
    sum += *point.true_m - point.measured_m;
    ++known;
  }
  for (PhasePoint& point : segment) {
    if (point.true_m) *point.true_m -= sum / static_cast<double>(known);
  }
}

Segment points_of(const PhaseSegment& segment, const RunFiles& run, const AntennaTrack& track,
                  const std::string& tag, Time start) {
  Segment points;
  for (std::size_t i = 0; i < segment.samples.size(); ++i) {
    const Time stamp = segment.samples[i].stamp;
    points.push_back(
        {to_seconds(stamp - start), segment.distance_m[i], true_distance(run, track, tag, stamp)});
  }
  align_truth(points);
  return points;
}

std::vector<Segment> drawn_segments(const RunFiles& run, const AntennaTrack& track,
                                    const std::string& tag) {
  std::vector<Segment> drawn;
  const std::vector<PhaseSegment> segments = segments_of(track, tag);
  drawn.reserve(segments.size());
  for (const PhaseSegment& segment : segments) {
    drawn.push_back(points_of(segment, run, track, tag, segments.front().samples.front().stamp));
  }
  return drawn;
}

/// Range of a property over all points, including 0.
template <typename Property>
std::pair<double, double> range_of(const std::vector<Segment>& segments, Property property) {
  double low = 0.0;
  double high = 0.0;
  for (const Segment& segment : segments) {
    for (const PhasePoint& point : segment) {
      low = std::min(low, property(point));
      high = std::max(high, property(point));
    }
  }
  return {low, high};
}

std::size_t size_of(const std::vector<Segment>& segments) {
  std::size_t size = 0;
  for (const Segment& segment : segments) size += segment.size();
  return size;
}

double residual_mm(const PhasePoint& point) {
  return point.true_m ? 1e3 * (point.measured_m - *point.true_m) : 0.0;
}

Scale time_scale(const std::vector<Segment>& segments) {
  const double last = range_of(segments, [](const PhasePoint& p) { return p.time_s; }).second;
  Scale scale = tight_scale(0.0, std::max(last, 1e-3), 6);
  scale.from = 58.0;
  scale.to = kDrawingWidth - 18.0;
  return scale;
}

void draw_starts(Svg& svg, const Axes& axes, const std::vector<Segment>& segments) {
  if (segments.size() > kMaxRules) return;
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const double x = place_on(axes.x, segments[i].front().time_s);
    add_line(svg, {x, axes.y.from}, {x, axes.y.to}, styled("rule"));
  }
}

/// Draws one property of the points as dots, at most `kMaxMarks` of them over all segments.
template <typename Property>
void draw_dots(Svg& svg, const Axes& axes, const std::vector<Segment>& segments,
               Property property) {
  const std::size_t step = thinning(size_of(segments), kMaxMarks);
  for (const Segment& segment : segments) {
    for (std::size_t i = 0; i < segment.size(); i += step) {
      add_circle(svg, place_in(axes, segment[i].time_s, property(segment[i])), 1.9,
                 styled("measured"));
    }
  }
}

void draw_truth(Svg& svg, const Axes& axes, const std::vector<Segment>& segments) {
  const std::size_t step = thinning(size_of(segments), kMaxMarks);
  for (const Segment& segment : segments) {
    std::vector<Place> places;
    for (std::size_t i = 0; i < segment.size(); i += step) {
      const PhasePoint& point = segment[i];
      if (point.true_m) places.push_back(place_in(axes, point.time_s, *point.true_m));
    }
    add_polyline(svg, places, styled("true-line"));
  }
}

/// Draws measured minus true, below the main axes.
void draw_residuals(Svg& svg, const Scale& time, const std::vector<Segment>& segments) {
  const auto [low, high] = range_of(segments, residual_mm);
  Axes axes{time, round_scale(low, high, 4)};
  axes.y.to = svg.height + 30.0;
  axes.y.from = axes.y.to + 110.0;
  draw_axes(svg, axes, "time since the first read [s]", "measured − true [mm]");
  draw_starts(svg, axes, segments);
  draw_dots(svg, axes, segments, residual_mm);
  svg.height = axes.y.from + 48.0;
}

void draw_segments(Svg& svg, const std::vector<Segment>& segments, bool truth_known) {
  const auto measured = [](const PhasePoint& point) { return point.measured_m; };
  const auto [low, high] = range_of(segments, measured);
  Axes axes{time_scale(segments), round_scale(low, high, 6)};
  axes.y.to = kPhaseTop;
  axes.y.from = kPhaseTop + 250.0;
  std::vector<LegendEntry> legend = {{Symbol::kDot, "measured", "unwrapped phase distance"}};
  if (truth_known) legend.push_back({Symbol::kLine, "true-line", "true change of distance"});
  draw_legend(svg, legend);
  draw_axes(svg, axes, truth_known ? "" : "time since the first read [s]", "distance [m]");
  draw_starts(svg, axes, segments);
  draw_dots(svg, axes, segments, measured);
  if (truth_known) draw_truth(svg, axes, segments);
  svg.height = axes.y.from + (truth_known ? 26.0 : 48.0);
  if (truth_known) draw_residuals(svg, axes.x, segments);
}

/// Removes segments with few reads, unless there are no others; returns their number.
std::size_t leave_out_short(std::vector<Segment>& segments) {
  const auto is_short = [](const Segment& segment) { return segment.size() < kFewReads; };
  if (std::all_of(segments.begin(), segments.end(), is_short)) return 0;
  const std::size_t all = segments.size();
  segments.erase(std::remove_if(segments.begin(), segments.end(), is_short), segments.end());
  return all - segments.size();
}

std::string caption_of(const std::vector<Segment>& segments, std::size_t left_out,
                       const std::string& tag, const std::string& antenna, bool truth_known) {
  std::string text = fmt::format(
      "Change of the distance between {} and {}, by the phase without its jumps of 2π (eq. 9). It"
      " is the tag with the most reads there.",
      antenna, tag);
  if (segments.size() > 1) {
    text += fmt::format(" The phase could be followed in {} segments, each counted from 0 on.",
                        segments.size());
  }
  if (left_out > 0) {
    text += fmt::format(" {} of fewer than {} reads, as at the edge of the range, {} not drawn.",
                        counted(left_out, "more segment"), kFewReads, left_out == 1 ? "is" : "are");
  }
  if (truth_known)
    text +=
        " The true change is shifted to agree with each segment on average; the difference between "
        "the two is shown below.";
  const std::size_t step = thinning(size_of(segments), kMaxMarks);
  if (step > 1) text += fmt::format(" One read in {} is drawn.", step);
  return text;
}

}  // namespace

Figure phase_figure(const RunFiles& run) {
  Figure figure{"fig12_phase_distance", "Fig. 12", "Unwrapped phase distance", "", {}, ""};
  const AntennaTrack* track = busiest_track(run, true);
  const std::string tag = track == nullptr ? "" : busiest_tag(*track);
  if (tag.empty()) {
    figure.missing = track == nullptr ? "no antenna moves." : "the moving antenna read no tag.";
    return figure;
  }
  std::vector<Segment> segments = drawn_segments(run, *track, tag);
  const std::size_t left_out = leave_out_short(segments);
  if (segments.empty()) {
    figure.missing = "no read of the moving antenna is at a time when its pose is known.";
    return figure;
  }
  const bool truth_known = segments.front().front().true_m.has_value();
  figure.title += " of " + shortened(tag, 24);
  draw_segments(figure.svg, segments, truth_known);
  figure.data = "segment,time_s,distance_m,true_m\n";
  const std::size_t step = thinning(size_of(segments), kMaxMarks);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    for (std::size_t i = 0; i < segments[k].size(); i += step) {
      const PhasePoint& point = segments[k][i];
      add_data(figure.data, k + 1, point.time_s, point.measured_m, point.true_m);
    }
  }
  figure.caption = caption_of(segments, left_out, shortened(tag, 32), shortened(track->antenna, 32),
                              truth_known);
  return figure;
}

}  // namespace tagfield
