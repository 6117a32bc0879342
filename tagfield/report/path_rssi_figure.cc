// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/report/figures.h"
#include "tagfield/report/internal/color_map.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/map_view.h"

namespace tagfield {
namespace {

constexpr double kPathColorBar = 50.0;
constexpr double kFarthestTag = 30.0;  ///< [m] Estimates farther from the path are not shown.

/// A read with the position of the antenna.
struct PlacedRead {
  const TagRead* read = nullptr;
  Eigen::Vector3d p_WA;
};

std::vector<PlacedRead> placed(const AntennaTrack& track, const std::string& tag) {
  std::vector<PlacedRead> list;
  for (const TagRead* read : reads_of(track, tag)) {
    list.push_back({read, held_position_at(track.best(), read->stamp)});
  }
  return list;
}

std::pair<double, double> rssi_range(const std::vector<PlacedRead>& reads) {
  std::vector<double> values;
  values.reserve(reads.size());
  for (const PlacedRead& placed_read : reads) values.push_back(placed_read.read->rssi_dbm);
  return color_range(std::move(values));
}

void draw_reads(Svg& svg, const MapView& map, const std::vector<PlacedRead>& reads) {
  const auto [low, high] = rssi_range(reads);
  const std::size_t step = thinning(reads.size(), kMaxMarks);
  for (std::size_t i = 0; i < reads.size(); i += step) {
    const TagRead& read = *reads[i].read;
    const double strength = strength_of(read.rssi_dbm, low, high);
    add_circle(svg, on_map(map, reads[i].p_WA), 5.0,
               filled(hex_color(strength_color(strength)), strength_opacity(strength)),
               fmt::format("{:.1f} dBm at {:.2f} s", read.rssi_dbm, to_seconds(read.stamp)));
  }
}

const TagOutcome* outcome_of(const RunFiles& run, const std::string& tag) {
  for (const TagOutcome& outcome : run.summary.tags) {
    if (outcome.estimate.tag == tag) return &outcome;
  }
  return nullptr;
}

void draw_tag(Svg& svg, MapView& map, const TagOutcome* outcome) {
  const auto place = outcome == nullptr ? std::nullopt : known_place(*outcome);
  if (!place) return;
  const Place center = on_map(map, *place);
  const bool shown = center.x() > map.axes.x.from && center.x() < map.axes.x.to &&
                     center.y() > map.axes.y.to && center.y() < map.axes.y.from;
  if (!shown) return;
  if (outcome->truth_m) {
    add_diamond(svg, center, 8.5, styled("truth"), clean_text(outcome->estimate.tag));
  } else {
    add_cross(svg, center, 6.0, styled("estimate"), clean_text(outcome->estimate.tag));
  }
  draw_label(svg, map, center, shortened(outcome->estimate.tag, 16));
}

Extent content_of(const AntennaTrack& track, const TagOutcome* outcome) {
  Extent content;
  for (const StampedPose& pose : track.best()) content.extend(pose.X_WB.translation.head<2>());
  const auto place = outcome == nullptr ? std::nullopt : known_place(*outcome);
  if (place && content.exteriorDistance(place->head<2>()) < kFarthestTag) {
    content.extend(place->head<2>());
  }
  return content;
}

}  // namespace

Figure path_rssi_figure(const RunFiles& run) {
  Figure figure{"fig13_rssi_path", "Fig. 13", "RSSI along the path", "", {}, ""};
  const AntennaTrack* track = busiest_track(run, true);
  const std::string tag = track == nullptr ? "" : busiest_tag(*track);
  if (tag.empty()) {
    figure.missing = track == nullptr ? "no antenna moves." : "the moving antenna read no tag.";
    return figure;
  }
  const TagOutcome* outcome = outcome_of(run, tag);
  const std::vector<PlacedRead> reads = placed(*track, tag);
  const auto [low, high] = rssi_range(reads);
  MapView map = make_map(figure.name, content_of(*track, outcome), run.top_view, kPathColorBar);
  figure.svg.height = map_bottom(map);
  draw_color_bar(figure.svg, 2.0, low, high);
  draw_map(figure.svg, map, run.top_view);
  draw_path(figure.svg, map, track->best(), "thin");
  draw_reads(figure.svg, map, reads);
  draw_tag(figure.svg, map, outcome);
  figure.data = "time_s,x_m,y_m,rssi_dbm\n";
  for (std::size_t i = 0; i < reads.size(); i += thinning(reads.size(), kMaxMarks)) {
    add_data(figure.data, to_seconds(reads[i].read->stamp), reads[i].p_WA.x(), reads[i].p_WA.y(),
             reads[i].read->rssi_dbm);
  }
  figure.title += fmt::format(", {}", shortened(tag, 24));
  figure.caption = fmt::format(
      "RSSI of {}'s replies where {} received them, over {}; the colours span the middle 90 % of "
      "the values. Where only the thin line is, it received none.",
      shortened(tag, 32), shortened(track->antenna, 32), counted(reads.size(), "read"));
  const std::size_t step = thinning(reads.size(), kMaxMarks);
  if (step > 1) figure.caption += fmt::format(" One read in {} is drawn.", step);
  return figure;
}

}  // namespace tagfield
