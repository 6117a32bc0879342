// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/report/figures.h"
#include "tagfield/report/internal/color_map.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/fixed_rssi.h"
#include "tagfield/report/internal/map_view.h"

namespace tagfield {
namespace {

constexpr double kColorBar = 50.0;

Extent content_of(const Eigen::Vector3d& antenna, const std::vector<TagStrength>& strengths) {
  Extent content(Eigen::Vector2d(antenna.head<2>()));
  for (const TagStrength& strength : strengths) {
    if (strength.p_WT) content.extend(strength.p_WT->head<2>());
  }
  return content;
}

std::string spoken_strength(const TagStrength& strength) {
  return fmt::format("{}: mean {:.1f} dBm over {}", clean_text(strength.tag), strength.mean_dbm,
                     counted(strength.rssi_dbm.size(), "read"));
}

void draw_links(Svg& svg, MapView& map, const Place& antenna,
                const std::vector<TagStrength>& strengths) {
  const auto [low, high] = color_range(all_values(strengths));
  const std::size_t step = thinning(strengths.size(), kMaxMarks / 2);
  for (std::size_t i = 0; i < strengths.size(); i += step) {
    if (!strengths[i].p_WT) continue;
    const double strength = strength_of(strengths[i].mean_dbm, low, high);
    const std::string color = hex_color(strength_color(strength));
    const Place place = on_map(map, *strengths[i].p_WT);
    add_line(svg, antenna, place, stroked(color, strength_opacity(strength), 3.5),
             spoken_strength(strengths[i]));
    add_circle(svg, place, 7.0, filled(color, 1.0), spoken_strength(strengths[i]));
    take_place(map, place, 7.0);
  }
}

void draw_names(Svg& svg, MapView& map, const std::vector<TagStrength>& strengths) {
  if (strengths.size() > kMaxRows) return;
  for (const TagStrength& strength : strengths) {
    if (strength.p_WT) {
      draw_label(svg, map, on_map(map, *strength.p_WT), shortened(strength.tag, 12));
    }
  }
}

std::size_t count_without_place(const std::vector<TagStrength>& strengths) {
  return static_cast<std::size_t>(
      std::count_if(strengths.begin(), strengths.end(),
                    [](const TagStrength& strength) { return !strength.p_WT; }));
}

std::string caption_of(const std::vector<TagStrength>& strengths, const std::string& antenna) {
  std::string text = fmt::format(
      "A line from {} (the square) to each of the {} that it read, in the colour of the mean "
      "RSSI:"
      " low dark blue, middle green, high yellow, the weaker the more transparent.",
      antenna, counted(strengths.size(), "tag"));
  const std::size_t lost = count_without_place(strengths);
  if (lost > 0) text += fmt::format(" {} of unknown position left out.", counted(lost, "tag"));
  const std::size_t step = thinning(strengths.size(), kMaxMarks / 2);
  if (step > 1) text += fmt::format(" One tag in {} is drawn.", step);
  return text;
}

}  // namespace

Figure fixed_rssi_figure(const RunFiles& run) {
  Figure figure{"fig14_rssi_fixed", "Fig. 14", "RSSI at the fixed antenna", "", {}, ""};
  const AntennaTrack* track = fixed_track(run, figure.missing);
  if (track == nullptr) return figure;
  const std::vector<TagStrength> strengths = strengths_at(run, *track);
  if (count_without_place(strengths) == strengths.size()) {
    figure.missing = "no tag that it read has a single position, as when all of them move.";
    return figure;
  }
  const Eigen::Vector3d p_WA = track->best().front().X_WB.translation;
  MapView map = make_map(figure.name, content_of(p_WA, strengths), run.top_view, kColorBar);
  const Place antenna = on_map(map, p_WA);
  const auto [low, high] = color_range(all_values(strengths));
  figure.svg.height = map_bottom(map);
  draw_color_bar(figure.svg, 2.0, low, high);
  draw_map(figure.svg, map, run.top_view);
  draw_links(figure.svg, map, antenna, strengths);
  add_rectangle(figure.svg, antenna - Place(7, 6), {14, 12}, styled("ink"),
                clean_text(track->antenna));
  take_place(map, antenna, 8.0);
  draw_label(figure.svg, map, antenna, shortened(track->antenna, 18));
  draw_names(figure.svg, map, strengths);
  figure.data = "tag,x_m,y_m,reads,mean_rssi_dbm\n";
  for (const TagStrength& strength : strengths) {
    if (!strength.p_WT) continue;
    add_data(figure.data, strength.tag, strength.p_WT->x(), strength.p_WT->y(),
             strength.rssi_dbm.size(), strength.mean_dbm);
  }
  figure.caption = caption_of(strengths, shortened(track->antenna, 32));
  return figure;
}

}  // namespace tagfield
