// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/report/axes.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/color_map.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/fixed_rssi.h"

namespace tagfield {
namespace {

constexpr double kStripNameWidth = 122.0;
constexpr double kStripTop = 12.0;

/// The strongest ones, in their original order.
std::vector<TagStrength> strongest(std::vector<TagStrength> strengths, std::size_t most) {
  if (strengths.size() <= most) return strengths;
  std::stable_sort(
      strengths.begin(), strengths.end(),
      [](const TagStrength& a, const TagStrength& b) { return a.mean_dbm > b.mean_dbm; });
  strengths.resize(most);
  std::stable_sort(
      strengths.begin(), strengths.end(),
      [](const TagStrength& a, const TagStrength& b) { return natural_less(a.tag, b.tag); });
  return strengths;
}

/// Equal values of a tag are drawn as one spot, which is larger the more there are.
void draw_strip(Svg& svg, const Axes& axes, const TagStrength& strength, double y,
                const std::pair<double, double>& colors, std::size_t most) {
  std::map<double, std::size_t> counts;
  for (const double value : strength.rssi_dbm) ++counts[value];
  const std::size_t step = thinning(counts.size(), most);
  std::size_t index = 0;
  for (const auto& [value, count] : counts) {
    if (index++ % step != 0) continue;
    const double level = strength_of(value, colors.first, colors.second);
    const double share = static_cast<double>(count) / static_cast<double>(strength.rssi_dbm.size());
    add_circle(svg, {place_on(axes.x, value), y}, 3.0 + 5.0 * share,
               filled(hex_color(strength_color(level)), strength_opacity(level)),
               fmt::format("{:.1f} dBm: {}", value, counted(count, "read")));
  }
}

Axes strip_axes(const std::vector<TagStrength>& strengths) {
  const auto [low, high] = range_of(strengths);
  Axes axes{round_scale(low, high, 4), {}};
  axes.x.from = kStripNameWidth;
  axes.x.to = kDrawingWidth - 26.0;
  axes.y.to = kStripTop;
  axes.y.from =
      kStripTop + row_height(strengths.size()) * static_cast<double>(strengths.size()) + 4.0;
  return axes;
}

}  // namespace

Figure fixed_strip_figure(const RunFiles& run) {
  Figure figure{"fig14_rssi_values", "with Fig. 14", "All RSSI values there", "", {}, ""};
  const AntennaTrack* track = fixed_track(run, figure.missing);
  if (track == nullptr) return figure;
  const std::vector<TagStrength> all = strengths_at(run, *track);
  const std::vector<TagStrength> shown = strongest(all, kMaxRows);
  const Axes axes = strip_axes(shown);
  const auto colors = color_range(all_values(shown));
  figure.svg.height = axes.y.from + 48.0;
  draw_x_axis(figure.svg, axes, "RSSI [dBm]");
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double y = kStripTop + row_height(shown.size()) * (static_cast<double>(i) + 0.5) + 2.0;
    add_text(figure.svg, {kStripNameWidth - 10.0, y + 5.0}, shortened(shown[i].tag, 10),
             Anchor::kEnd);
    draw_strip(figure.svg, axes, shown[i], y, colors, kMaxMarks / shown.size());
  }
  figure.caption =
      "Every value received from each tag: a spot for each that occurs, the larger "
      "the greater its share.";
  figure.data = "tag,rssi_dbm,reads\n";
  for (const TagStrength& strength : shown) {
    std::map<double, std::size_t> counts;
    for (const double value : strength.rssi_dbm) ++counts[value];
    const std::size_t step = thinning(counts.size(), kMaxMarks / shown.size());
    std::size_t index = 0;
    for (const auto& [value, count] : counts) {
      if (index++ % step == 0) add_data(figure.data, strength.tag, value, count);
    }
  }
  if (shown.size() < all.size()) {
    figure.caption +=
        fmt::format(" The {} strongest of {} tags.", shown.size(), grouped(all.size()));
  }
  return figure;
}

}  // namespace tagfield
