// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/inventory_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "tagfield/report/axes.h"
#include "tagfield/report/internal/color_bands.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/short_names.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr std::size_t kLongestName = 26;

/// Antennas grouped by reader, both in their own order.
std::vector<const InventoryShare*> by_reader(const InventorySummary& inventory) {
  std::vector<const InventoryShare*> rows;
  for (const InventoryShare& reader : inventory.readers) {
    for (const InventoryShare& antenna : inventory.antennas) {
      if (antenna.reader == reader.name) rows.push_back(&antenna);
    }
  }
  return rows;
}

std::size_t number_of_reader(const InventorySummary& inventory, const std::string& name) {
  std::size_t number = 0;
  while (number < inventory.readers.size() && inventory.readers[number].name != name) ++number;
  return number;
}

/// The antennas' names, short enough for the figure.
std::vector<std::string> names_of(const std::vector<const InventoryShare*>& rows) {
  std::vector<std::string> names;
  names.reserve(rows.size());
  for (const InventoryShare* const row : rows) names.push_back(row->name);
  return distinct_names(names, kLongestName);
}

/// Width of a name, at least, in a wide sans-serif such as DejaVu Sans: no letter may be cut off.
double room_for(const std::string& name) {
  double letters = 0.0;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) continue;  // Inside a character of several bytes.
    const bool is_widest = std::string_view("WMmw@%").find(c) != std::string_view::npos;
    const bool is_wide = byte >= 0x80U || (c >= 'A' && c <= 'Z');
    letters += is_widest ? 1.0 : is_wide ? 0.8 : 0.64;
  }
  return letters * kFontSize;
}

/// The room for names before the bars.
double names_width(const std::vector<std::string>& names) {
  double most = 0.0;
  for (const std::string& name : names) most = std::max(most, room_for(name));
  return std::max(most + 10.0, 60.0);
}

void draw_antenna(Svg& svg, const Axes& axes, const InventoryShare& antenna,
                  const std::string& name, double y, const std::string& color) {
  const double zero = place_on(axes.x, 0.0);
  const double all = place_on(axes.x, antenna.tags);
  const double own = place_on(axes.x, antenna.only);
  add_short_name(svg, {axes.x.from - 8.0, y + 5.0}, name, antenna.name, Anchor::kEnd);
  const std::string said = fmt::format("{} ({}): {:.0f} tags, {:.0f} by no other", antenna.name,
                                       antenna.reader, antenna.tags, antenna.only);
  add_rectangle(svg, {zero, y - 7.0}, {std::max(all - zero, 1.0), 14.0}, filled(color, 0.4),
                clean_text(said));
  add_rectangle(svg, {zero, y - 7.0}, {own - zero, 14.0}, filled(color, 1.0), clean_text(said));
}

}  // namespace

Figure inventory_curve_figure(const RunFiles& run) {
  Figure figure{"inventory_time", "", "Tags read over time", "", {}, ""};
  const InventorySummary& inventory = *run.summary.inventory;
  if (inventory.curve.empty()) {
    figure.missing = "no tag was read.";
    return figure;
  }
  Axes axes{tight_scale(0.0, std::max(inventory.duration_s, 1e-3), 6), tight_scale(0.0, 100.0, 5)};
  axes.x.from = 52.0;
  axes.x.to = kDrawingWidth - 24.0;
  axes.y.from = 300.0;
  axes.y.to = 34.0;
  figure.svg.height = 348.0;
  draw_axes(figure.svg, axes, "time [s]", "tags read at least once [%]");
  std::vector<Place> places = {place_in(axes, 0.0, 0.0)};
  for (const InventoryMoment& moment : inventory.curve) {
    places.emplace_back(place_on(axes.x, moment.time_s), places.back().y());
    places.push_back(place_in(axes, moment.time_s, 100.0 * moment.share));
  }
  places.emplace_back(place_on(axes.x, inventory.duration_s), places.back().y());
  add_polyline(figure.svg, places, styled("curve"));
  figure.data = "time_s,share\n";
  for (const InventoryMoment& moment : inventory.curve) {
    add_data(figure.data, moment.time_s, moment.share);
  }
  figure.caption = "The share of all tags that had been read at least once by then";
  figure.caption += run.summary.seeds.size() > 1 ? ", in the first run." : ".";
  return figure;
}

Figure inventory_antennas_figure(const RunFiles& run) {
  Figure figure{"inventory_antennas", "", "Tags by antenna", "", {}, ""};
  const InventorySummary& inventory = *run.summary.inventory;
  const std::vector<const InventoryShare*> rows = by_reader(inventory);
  double most = 1.0;
  for (const InventoryShare* const antenna : rows) most = std::max(most, antenna->tags);
  const std::size_t shown = std::min(rows.size(), kMaxRows);
  const double height = row_height(shown);
  Axes axes{round_scale(0.0, most, 5), {}};
  const std::vector<std::string> names = names_of(rows);
  axes.x.from = names_width(names);
  axes.x.to = kDrawingWidth - 24.0;
  axes.y.to = 8.0;
  axes.y.from = axes.y.to + height * static_cast<double>(shown);
  figure.svg.height = axes.y.from + 48.0;
  draw_x_axis(figure.svg, axes, "tags");
  for (std::size_t i = 0; i < shown; ++i) {
    draw_antenna(figure.svg, axes, *rows[i], names[i],
                 axes.y.to + height * (static_cast<double>(i) + 0.5),
                 color_of_kind(number_of_reader(inventory, rows[i]->reader)));
  }
  figure.data = "antenna,reader,tags,only_by_it,reads\n";
  for (const InventoryShare* const row : rows) {
    add_data(figure.data, row->name, row->reader, row->tags, row->only, row->reads);
  }
  figure.caption =
      "Tags that each antenna read at least once, one colour per reader; the full part is of tags "
      "that "
      "no other antenna read.";
  if (shown < rows.size()) {
    figure.caption += fmt::format(" The first {} of {}.", shown, rows.size());
  }
  return figure;
}

}  // namespace tagfield
