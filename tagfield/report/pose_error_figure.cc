// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/report/axes.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/figure_data.h"

namespace tagfield {
namespace {

constexpr double kPanelHeight = 150.0;
constexpr double kAboveAxes = 34.0;
constexpr double kBelowAxes = 48.0;

/// One error of one antenna over time.
struct Course {
  std::vector<double> times_s;
  std::vector<double> values;  ///< Same length as `times_s`.
};

/// One of the two panels: an error of all moving antennas.
struct Panel {
  std::string title;
  std::string unit;
  std::vector<Course> courses;
  ErrorStatistics numbers;  ///< In the unit.
};

double horizontal_error_mm(const RigidTransform& believed, const RigidTransform& truth) {
  return 1e3 * (believed.translation - truth.translation).head<2>().norm();
}

/// Angle of the rotation about z between the two, however the antenna is mounted.
double yaw_error_deg(const RigidTransform& believed, const RigidTransform& truth) {
  return degrees(std::abs(yaw_of(believed.rotation * truth.rotation.conjugate())));
}

template <typename Measure>
Course course_of(const AntennaTrack& track, double start_s, Measure measure) {
  Course course;
  for (const StampedPose& pose : track.believed) {
    const auto truth = pose_at(track.truth, pose.stamp);
    if (!truth) continue;
    course.times_s.push_back(to_seconds(pose.stamp) - start_s);
    course.values.push_back(measure(pose.X_WB, *truth));
  }
  return course;
}

template <typename Measure>
Panel panel_of(const RunFiles& run, const std::string& title, const std::string& unit,
               double start_s, Measure measure) {
  Panel panel{title, unit, {}, {}};
  std::vector<double> all;
  for (const AntennaTrack& track : run.tracks) {
    if (!track.moving || track.truth.empty()) continue;
    const Course course = course_of(track, start_s, measure);
    all.insert(all.end(), course.values.begin(), course.values.end());
    panel.courses.push_back(course);
  }
  panel.numbers = statistics(all).value_or(ErrorStatistics{});
  return panel;
}

double start_of(const RunFiles& run) {
  const AntennaTrack* track = busiest_track(run, true);
  return track == nullptr ? 0.0 : to_seconds(track->believed.front().stamp);
}

Axes panel_axes(const Panel& panel, double top) {
  double last = 1e-3;
  for (const Course& course : panel.courses) {
    if (!course.times_s.empty()) last = std::max(last, course.times_s.back());
  }
  Axes axes{tight_scale(0.0, last, 6), round_scale(0.0, std::max(panel.numbers.max, 1e-3), 4)};
  axes.x.from = 52.0;
  axes.x.to = kDrawingWidth - 18.0;
  axes.y.to = top + kAboveAxes;
  axes.y.from = axes.y.to + kPanelHeight;
  return axes;
}

/// Points of the curve. Of several successive values the largest is drawn, so that no peak is lost.
std::vector<Place> places_of(const Axes& axes, const Course& course) {
  std::vector<Place> places;
  const std::size_t step = thinning(course.values.size(), kMaxMarks);
  for (std::size_t i = 0; i < course.values.size(); i += step) {
    const auto begin = course.values.begin() + static_cast<std::ptrdiff_t>(i);
    const auto count = std::min(step, course.values.size() - i);
    const auto greatest = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(count));
    const auto at = static_cast<std::size_t>(greatest - course.values.begin());
    places.push_back(place_in(axes, course.times_s[at], *greatest));
  }
  return places;
}

std::string spoken(const Panel& panel, double value) {
  const int decimals = panel.unit == "°" ? 2 : value < 9.95 ? 1 : 0;
  return fmt::format("{:.{}f}{}{}", value, decimals, panel.unit == "°" ? "" : " ", panel.unit);
}

void draw_level(Svg& svg, const Axes& axes, const Panel& panel, const std::string& name,
                double value, Anchor anchor) {
  const double y = place_on(axes.y, value);
  const std::string text = name + " " + spoken(panel, value);
  add_line(svg, {axes.x.from, y}, {axes.x.to, y}, styled("rule"), text);
  const double x = anchor == Anchor::kStart ? axes.x.from + 6.0 : axes.x.to - 4.0;
  add_rimmed_text(svg, {x, y - 5.0}, text, anchor);
}

/// Draws a dot at the largest value, with its time.
void draw_greatest(Svg& svg, const Axes& axes, const Panel& panel) {
  for (const Course& course : panel.courses) {
    const auto greatest = std::max_element(course.values.begin(), course.values.end());
    if (greatest == course.values.end()) continue;
    const double time = course.times_s[static_cast<std::size_t>(greatest - course.values.begin())];
    add_circle(svg, place_in(axes, time, *greatest), 3.5, styled("peak"),
               fmt::format("maximum: {} at {:.1f} s", spoken(panel, *greatest), time));
  }
}

void draw_panel(Svg& svg, const Panel& panel) {
  const Axes axes = panel_axes(panel, svg.height);
  draw_axes(svg, axes, "time since the start [s]",
            fmt::format("{} [{}]", panel.title, panel.unit == "°" ? "deg" : panel.unit));
  for (const Course& course : panel.courses) {
    add_polyline(svg, places_of(axes, course), styled("trace"));
  }
  draw_greatest(svg, axes, panel);
  draw_level(svg, axes, panel, "mean", panel.numbers.mean, Anchor::kStart);
  draw_level(svg, axes, panel, "95 % within", panel.numbers.p95, Anchor::kEnd);
  svg.height = axes.y.from + kBelowAxes;
}

std::string caption_of(const RunFiles& run, const Panel& panel) {
  std::string text =
      panel.courses.size() > 1
          ? fmt::format("Error of the believed poses of {} moving antennas", panel.courses.size())
          : std::string("Error of the believed pose of the antenna");
  text += " while tags were read: horizontal, and in heading.";
  if (run.summary.seeds.size() > 1) {
    text += fmt::format(" Shown is the first of {} seeds.", run.summary.seeds.size());
  }
  std::size_t step = 1;
  for (const Course& course : panel.courses) {
    step = std::max(step, thinning(course.values.size(), kMaxMarks));
  }
  if (step > 1) text += fmt::format(" Of every {} poses the worst is drawn.", step);
  return text;
}

std::string data_of(const Panel& position, const Panel& yaw) {
  std::string csv = "antenna,time_s,horizontal_mm,heading_deg\n";
  for (std::size_t k = 0; k < position.courses.size(); ++k) {
    const Course& course = position.courses[k];
    const std::size_t step = thinning(course.values.size(), kMaxMarks);
    for (std::size_t i = 0; i < course.values.size(); i += step) {
      add_data(csv, k + 1, course.times_s[i], course.values[i], yaw.courses[k].values[i]);
    }
  }
  return csv;
}

}  // namespace

Figure pose_error_figure(const RunFiles& run) {
  Figure figure{"pose_error", "", "Error of the believed pose", "", {}, ""};
  const double start = start_of(run);
  const Panel position = panel_of(run, "horizontal error", "mm", start, horizontal_error_mm);
  const Panel yaw = panel_of(run, "error of the heading", "°", start, yaw_error_deg);
  if (position.numbers.count == 0) {
    figure.missing = "no antenna moves whose true path is known.";
    return figure;
  }
  draw_panel(figure.svg, position);
  draw_panel(figure.svg, yaw);
  figure.caption = caption_of(run, position);
  figure.data = data_of(position, yaw);
  return figure;
}

}  // namespace tagfield
