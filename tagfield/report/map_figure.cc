// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tagfield/report/figures.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/map_view.h"

namespace tagfield {
namespace {

using Outcomes = std::vector<const TagOutcome*>;

constexpr double kSeenPoseError = 0.005;  ///< [m] Two paths closer than this are drawn as one.
constexpr std::size_t kMaxCandidates = 4;
constexpr std::size_t kMaxWaypoints = 300;  ///< Of one moving tag.

void extend(Extent& extent, const Trajectory& trajectory) {
  for (const StampedPose& pose : trajectory) extent.extend(pose.X_WB.translation.head<2>());
}

/// The true path of a tag that moved; empty for others.
const std::vector<TagPosition>& way_of(const RunFiles& run, const TagOutcome& outcome) {
  static const std::vector<TagPosition> none;
  const auto found = run.true_positions.find(outcome.estimate.tag);
  return outcome.moved && found != run.true_positions.end() ? found->second : none;
}

/// Extent of what must be on the map: antennas, true tag positions, and paths of tags that moved.
Extent certain_extent(const RunFiles& run, const Outcomes& outcomes) {
  Extent extent;
  for (const AntennaTrack& track : run.tracks) extend(extent, track.best());
  for (const TagOutcome* outcome : outcomes) {
    if (outcome->truth_m) extent.extend(outcome->truth_m->head<2>());
    for (const TagPosition& position : way_of(run, *outcome)) {
      extent.extend(position.p_WT.head<2>());
    }
  }
  return extent;
}

/// The same including the estimates, except those that are far off.
Extent content_extent(const RunFiles& run, const Outcomes& outcomes) {
  const Extent certain = certain_extent(run, outcomes);
  Extent extent = certain;
  const double reach = certain.isEmpty() ? 1e9 : std::max(certain.sizes().maxCoeff(), 8.0);
  for (const TagOutcome* outcome : outcomes) {
    for (const Candidate& candidate : outcome->estimate.candidates) {
      const Eigen::Vector2d place = candidate.p_WT.head<2>();
      if (certain.isEmpty() || certain.exteriorDistance(place) < reach) extent.extend(place);
    }
  }
  return extent;
}

bool is_shown(const MapView& map, const Eigen::Vector3d& p_W) {
  return p_W.x() >= map.axes.x.low && p_W.x() <= map.axes.x.high && p_W.y() >= map.axes.y.low &&
         p_W.y() <= map.axes.y.high;
}

bool beliefs_differ(const AntennaTrack& track) {
  if (track.truth.empty()) return false;
  for (const StampedPose& pose : track.believed) {
    const RigidTransform truth = held_pose_at(track.truth, pose.stamp);
    if ((pose.X_WB.translation - truth.translation).norm() > kSeenPoseError) return true;
  }
  return false;
}

std::string spoken_place(const Eigen::Vector3d& p) {
  return fmt::format("x {:.3f}, y {:.3f}, z {:.3f} m", p.x(), p.y(), p.z());
}

/// What was drawn, for legend and caption.
struct Findings {
  bool beliefs = false;
  bool moving = false;
  bool fixed = false;
  bool truth = false;
  bool moved = false;
  bool estimates = false;
  bool pairs = false;
  std::size_t outside = 0;
};

void draw_paths(Svg& svg, MapView& map, const RunFiles& run) {
  for (const AntennaTrack& track : run.tracks) {
    if (!track.moving) continue;
    draw_path(svg, map, track.best(), "path");
    if (beliefs_differ(track)) draw_path(svg, map, track.believed, "believed");
  }
}

Place fixed_place(const MapView& map, const AntennaTrack& track) {
  return on_map(map, track.best().front().X_WB.translation);
}

/// All marks come before the first name, so that no name covers another antenna.
void draw_antennas(Svg& svg, MapView& map, const RunFiles& run, bool labelled) {
  for (const AntennaTrack& track : run.tracks) {
    if (track.moving) {
      draw_direction(svg, map, track.best());
      continue;
    }
    const Place place = fixed_place(map, track);
    add_rectangle(svg, place - Place(7, 6), {14, 12}, styled("ink"),
                  clean_text(track.antenna) + ", fixed antenna");
    take_place(map, place, 8.0);
  }
  if (!labelled) return;
  for (const AntennaTrack& track : run.tracks) {
    if (!track.moving) draw_label(svg, map, fixed_place(map, track), shortened(track.antenna, 18));
  }
}

void draw_moved_tag(Svg& svg, const MapView& map, const RunFiles& run, const TagOutcome& outcome) {
  const std::vector<TagPosition>& way = way_of(run, outcome);
  const std::size_t step = thinning(way.size(), kMaxWaypoints);
  std::vector<Place> places;
  for (std::size_t i = 0; i < way.size(); i += step) {
    places.push_back(on_map(map, way[i].p_WT));
  }
  if (places.empty()) return;
  add_polyline(svg, places, styled("true-line"));
}

void draw_truth(Svg& svg, const MapView& map, const TagOutcome& outcome) {
  if (!outcome.truth_m) return;
  add_diamond(
      svg, on_map(map, *outcome.truth_m), 10.0, styled("truth"),
      clean_text(outcome.estimate.tag) + ", true position: " + spoken_place(*outcome.truth_m));
}

void draw_candidates(Svg& svg, const MapView& map, const TagEstimate& estimate) {
  const std::size_t shown = std::min(estimate.candidates.size(), kMaxCandidates);
  for (std::size_t i = 0; i < shown; ++i) {
    const Candidate& candidate = estimate.candidates[i];
    if (!is_shown(map, candidate.p_WT)) continue;
    if (i > 0) {
      add_line(svg, on_map(map, estimate.candidates.front().p_WT), on_map(map, candidate.p_WT),
               styled("pair"));
    }
    add_cross(svg, on_map(map, candidate.p_WT), 6.5, styled("halo"));
    add_cross(svg, on_map(map, candidate.p_WT), 6.0, styled("estimate"),
              fmt::format("{}, {}: {}", clean_text(estimate.tag),
                          shown > 1 ? "one of its candidates" : "estimate",
                          spoken_place(candidate.p_WT)));
  }
}

/// Position for the label of a tag: for one that moved, its last position.
std::optional<Eigen::Vector3d> label_place(const RunFiles& run, const TagOutcome& outcome) {
  if (outcome.truth_m) return outcome.truth_m;
  if (!way_of(run, outcome).empty()) return way_of(run, outcome).back().p_WT;
  if (outcome.estimate.candidates.empty()) return std::nullopt;
  return outcome.estimate.candidates.front().p_WT;
}

void draw_tags(Svg& svg, MapView& map, const RunFiles& run, const Outcomes& outcomes) {
  begin_clip(svg, map.id + "-tags", {map.axes.x.from, map.axes.y.to},
             {map.axes.x.to - map.axes.x.from, map.axes.y.from - map.axes.y.to});
  const std::size_t step = thinning(outcomes.size(), kMaxMarks / 2);
  for (std::size_t i = 0; i < outcomes.size(); i += step) {
    draw_moved_tag(svg, map, run, *outcomes[i]);
    draw_truth(svg, map, *outcomes[i]);
    draw_candidates(svg, map, outcomes[i]->estimate);
    for (const Candidate& candidate : outcomes[i]->estimate.candidates) {
      take_place(map, on_map(map, candidate.p_WT), 7.0);
    }
    if (outcomes[i]->truth_m) take_place(map, on_map(map, *outcomes[i]->truth_m), 7.0);
  }
  end_clip(svg);
}

void draw_names(Svg& svg, MapView& map, const RunFiles& run, const Outcomes& outcomes) {
  if (outcomes.size() > kMaxRows) return;
  for (const TagOutcome* outcome : outcomes) {
    const auto place = label_place(run, *outcome);
    if (place && is_shown(map, *place)) {
      draw_label(svg, map, on_map(map, *place), shortened(outcome->estimate.tag, 12));
    }
  }
}

Findings findings_of(const RunFiles& run, const Outcomes& outcomes, const MapView& map) {
  Findings found;
  for (const AntennaTrack& track : run.tracks) {
    (track.moving ? found.moving : found.fixed) = true;
    found.beliefs = found.beliefs || (track.moving && beliefs_differ(track));
  }
  for (const TagOutcome* outcome : outcomes) {
    const auto& candidates = outcome->estimate.candidates;
    found.truth = found.truth || outcome->truth_m;
    found.moved = found.moved || !way_of(run, *outcome).empty();
    found.estimates = found.estimates || !candidates.empty();
    found.pairs = found.pairs || candidates.size() > 1;
    if (!candidates.empty() && !is_shown(map, candidates.front().p_WT)) ++found.outside;
  }
  return found;
}

std::vector<LegendEntry> legend_of(const Findings& found) {
  std::vector<LegendEntry> entries;
  if (found.moving) entries.push_back({Symbol::kLine, "path", "path of the antenna"});
  if (found.beliefs) entries.push_back({Symbol::kLine, "believed", "as the robot believed"});
  if (found.fixed) entries.push_back({Symbol::kSquare, "ink", "fixed antenna"});
  if (found.truth) entries.push_back({Symbol::kDiamond, "truth", "tag, true"});
  if (found.moved) entries.push_back({Symbol::kLine, "true-line", "path of a tag"});
  if (found.estimates) entries.push_back({Symbol::kCross, "estimate", "tag, estimated"});
  return entries;
}

std::string caption_of(const RunFiles& run, const Outcomes& outcomes, const Findings& found) {
  std::string text = run.top_view.empty() ? "From above; the world's geometry is not known."
                                          : "The world from above, with everything in it in grey.";
  if (found.truth && found.estimates) {
    text +=
        " An estimate within its diamond is off by less than the map can show; the errors "
        "themselves are in the next figure and the table.";
  }
  if (found.pairs) text += " A dashed blue line joins positions that the data can't distinguish.";
  if (found.outside > 0) {
    text += fmt::format(
        " {} beyond the edge of the map.",
        found.outside == 1 ? "1 estimate lies" : grouped(found.outside) + " estimates lie");
  }
  if (run.summary.seeds.size() > 1) {
    text += fmt::format(" Shown is the first of {} seeds.", run.summary.seeds.size());
  }
  const std::size_t step = thinning(outcomes.size(), kMaxMarks / 2);
  if (step > 1) text += fmt::format(" One tag in {} is drawn.", step);
  return text;
}

std::string data_of(const RunFiles& run, const Outcomes& outcomes) {
  std::string csv = "what,name,time_s,x_m,y_m,z_m\n";
  for (const AntennaTrack& track : run.tracks) {
    const Trajectory& path = track.best();
    const std::size_t step = track.moving ? thinning(path.size(), kMaxMarks) : path.size();
    for (std::size_t i = 0; i < path.size(); i += step) {
      const Eigen::Vector3d& p = path[i].X_WB.translation;
      add_data(csv, "antenna", track.antenna, to_seconds(path[i].stamp), p.x(), p.y(), p.z());
    }
  }
  const std::size_t step = thinning(outcomes.size(), kMaxMarks / 2);
  for (std::size_t i = 0; i < outcomes.size(); i += step) {
    const TagEstimate& estimate = outcomes[i]->estimate;
    if (const auto& p = outcomes[i]->truth_m) {
      add_data(csv, "true place", estimate.tag, std::nullopt, p->x(), p->y(), p->z());
    }
    for (const Candidate& candidate : estimate.candidates) {
      const Eigen::Vector3d& p = candidate.p_WT;
      add_data(csv, "estimate", estimate.tag, std::nullopt, p.x(), p.y(), p.z());
    }
  }
  return csv;
}

}  // namespace

Figure map_figure(const RunFiles& run) {
  Figure figure{"fig09_map", "Fig. 9", "Path, tags and estimates", "", {}, ""};
  const Outcomes outcomes = first_outcomes(run.summary);
  const Extent content = content_extent(run, outcomes);
  if (content.isEmpty()) {
    figure.missing = "there is neither an antenna pose nor a tag with a known position.";
    return figure;
  }
  MapView map = make_map(figure.name, content, run.top_view, 0.0);
  const Findings found = findings_of(run, outcomes, map);
  const double legend = draw_legend(figure.svg, legend_of(found));
  map = make_map(figure.name, content, run.top_view, legend);
  figure.svg.height = map_bottom(map);
  draw_map(figure.svg, map, run.top_view);
  draw_paths(figure.svg, map, run);
  draw_tags(figure.svg, map, run, outcomes);
  draw_antennas(figure.svg, map, run, outcomes.size() <= kMaxRows);
  draw_names(figure.svg, map, run, outcomes);
  figure.caption = caption_of(run, outcomes, found);
  figure.data = data_of(run, outcomes);
  return figure;
}

}  // namespace tagfield
