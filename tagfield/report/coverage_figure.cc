// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/coverage_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "tagfield/report/internal/color_bands.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/map_outline.h"
#include "tagfield/report/internal/map_view.h"
#include "tagfield/report/internal/short_names.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr double kBarHeight = 46.0;
constexpr std::int8_t kNotDrawn = -1;

Extent extent_of(const CoverageGrid& grid) {
  const Eigen::Vector2d size(static_cast<double>(grid.columns), static_cast<double>(grid.rows));
  return {grid.corner_m, Eigen::Vector2d(grid.corner_m + grid.step_m * size)};
}

/// The layer as a grid of colour indices.
OccupancyGrid numbered(const CoverageGrid& grid, const CoverageLayer& layer,
                       const std::function<std::int8_t(const CoverageCell&)>& number) {
  OccupancyGrid cells;
  cells.resolution_m = grid.step_m;
  cells.width = static_cast<int>(grid.columns);
  cells.height = static_cast<int>(grid.rows);
  cells.origin = grid.corner_m;
  cells.cells.reserve(layer.cells.size());
  for (const CoverageCell& cell : layer.cells) cells.cells.push_back(number(cell));
  return cells;
}

/// Draws the cells; `words` are the texts of the colours.
void draw_cells(Svg& svg, const MapView& map, const OccupancyGrid& cells,
                const std::vector<std::string>& colors, const std::vector<std::string>& words) {
  const Place corner = place_in(map.axes, cells.origin.x(), cells.origin.y());
  const double size = map.scale * cells.resolution_m;
  begin_group(svg, fmt::format("shape-rendering=\"crispEdges\" "
                               "transform=\"matrix({:.5f} 0 0 {:.5f} {:.3f} {:.3f})\"",
                               size, -size, corner.x(), corner.y()));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (colors[i].empty()) continue;
    const std::string data =
        cell_outline(cells, [&](std::int8_t cell) { return cell == static_cast<int>(i); });
    if (!data.empty()) add_path(svg, data, band_look(colors[i], words[i]));
  }
  end_group(svg);
}

void draw_antenna_marks(Svg& svg, MapView& map, const Coverage& coverage) {
  for (const CoverageAntenna& antenna : coverage.antennas) {
    if (antenna.places_W.empty()) continue;
    const Place first = on_map(map, antenna.places_W.front());
    if (antenna.places_W.size() > 1) {
      std::vector<Place> places;
      for (const Eigen::Vector3d& p_W : antenna.places_W) places.push_back(on_map(map, p_W));
      add_polyline(svg, places, styled("drive-rim"));
      add_polyline(svg, places, styled("drive"));
      add_circle(svg, first, 6.0, styled("start"), clean_text(antenna.name) + ", moves");
    } else {
      add_rectangle(svg, first - Place(7, 6), {14, 12}, styled("antenna"),
                    clean_text(antenna.name));
    }
    take_place(map, first, 8.0);
  }
}

void draw_antenna_names(Svg& svg, MapView& map, const Coverage& coverage) {
  for (const CoverageAntenna& antenna : coverage.antennas) {
    if (antenna.places_W.empty()) continue;
    draw_label(svg, map, on_map(map, antenna.places_W.front()), shortened(antenna.name, 18));
  }
}

/// All marks come before the first name, so that no name covers another antenna.
void draw_antennas(Svg& svg, MapView& map, const Coverage& coverage) {
  draw_antenna_marks(svg, map, coverage);
  draw_antenna_names(svg, map, coverage);
}

/// The background of all maps.
MapView begin_map(Figure& figure, const Coverage& coverage, double top) {
  MapView map = make_map(figure.name, extent_of(coverage.grid), {}, top);
  figure.svg.height = map_bottom(map);
  draw_axes(figure.svg, map.axes, "x [m]", "y [m]");
  begin_clip(figure.svg, map.id + "-map", {map.axes.x.from, map.axes.y.to},
             {map.axes.x.to - map.axes.x.from, map.axes.y.from - map.axes.y.to});
  return map;
}

void end_map(Figure& figure, const MapView& map, const std::vector<Silhouette>& top_view) {
  draw_outlines(figure.svg, map, top_view);
  end_clip(figure.svg);
  add_rectangle(figure.svg, {map.axes.x.from, map.axes.y.to},
                {map.axes.x.to - map.axes.x.from, map.axes.y.from - map.axes.y.to},
                styled("frame"));
}

std::vector<double> powers_of(const CoverageLayer& layer) {
  std::vector<double> powers;
  for (const CoverageCell& cell : layer.cells) {
    if (cell.power_dbm >= kMinPower_db) powers.push_back(cell.power_dbm);
  }
  return powers;
}

struct Drawn {
  const char* name;
  const char* title;
  std::string caption;
};

Drawn words_of(const Coverage& coverage, const CoverageLayer& layer, CoverageQuantity quantity) {
  const bool paper = is_by_paper(coverage);
  switch (quantity) {
    case CoverageQuantity::kProbability:
      return {"probability", "Read probability",
              fmt::format(
                  "How likely a tag there is readable at one moment, over the fading; in {:.0f} "
                  "% of the area with {:.0f} % or more. Left blank below 1 %.",
                  100.0 * share_read(layer), 100.0 * kReadProbability)};
    case CoverageQuantity::kMargin:
      return {"margin", "Margin",
              paper
                  ? "RSSI beyond that at the end of the range: green to yellow is within it."
                  : "What tag and reader have beyond what they need, the lesser of both: green to "
                    "yellow is enough. Left blank where nothing arrives."};
    case CoverageQuantity::kPower:
      return {"power", paper ? "RSSI" : "Power at the chip",
              paper ? "By eq. (5) of the paper, without noise."
                    : "Local mean over the fading, from the antenna position with the greatest "
                      "margin. Left blank where nothing arrives."};
    case CoverageQuantity::kAntenna:
      return {"antenna", "Best antenna",
              "The one with the greatest margin, where a tag is read at all."};
  }
  return {"", "", ""};
}

double value_of(const CoverageCell& cell, CoverageQuantity quantity) {
  if (quantity == CoverageQuantity::kProbability) return cell.probability;
  return quantity == CoverageQuantity::kMargin ? cell.margin_db : cell.power_dbm;
}

ColorBands bands_of(const Coverage& coverage, const CoverageLayer& layer,
                    CoverageQuantity quantity) {
  if (quantity == CoverageQuantity::kProbability) return probability_bands();
  if (quantity == CoverageQuantity::kMargin) return margin_bands();
  return power_bands(is_by_paper(coverage) ? "RSSI [dBm]" : "power [dBm]", powers_of(layer));
}

void draw_quantity(Figure& figure, const Coverage& coverage, const CoverageLayer& layer,
                   CoverageQuantity quantity, const std::vector<Silhouette>& top_view) {
  const ColorBands bands = bands_of(coverage, layer, quantity);
  draw_band_bar(figure.svg, 2.0, bands);
  MapView map = begin_map(figure, coverage, kBarHeight);
  const OccupancyGrid cells = numbered(coverage.grid, layer, [&](const CoverageCell& cell) {
    if (quantity != CoverageQuantity::kProbability && cell.antenna < 0) return kNotDrawn;
    return static_cast<std::int8_t>(band_of(bands, value_of(cell, quantity)));
  });
  std::vector<std::string> words;
  for (std::size_t i = 0; i < bands.colors.size(); ++i) words.push_back(words_of_band(bands, i));
  draw_cells(figure.svg, map, cells, bands.colors, words);
  end_map(figure, map, top_view);
  draw_antennas(figure.svg, map, coverage);
}

/// Of more antennas, the others share colours.
constexpr std::size_t kMaxKinds = 100;

/// "12: " if so many antennas need numbers beside their colours.
std::string number_of_kind(std::size_t antenna, std::size_t count) {
  return count > kPlainKinds ? fmt::format("{}: ", antenna + 1) : "";
}

/// Draws the antennas' colours and names; returns the height.
double draw_kinds(Svg& svg, const std::vector<std::string>& names) {
  const std::vector<std::string> shown = distinct_names(names, 18);
  double x = 2.0;
  double y = 2.0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string number = number_of_kind(i, names.size());
    const double width = 40.0 + text_width(number + shown[i]);
    if (x > 2.0 && x + width > kDrawingWidth) {
      x = 2.0;
      y += 22.0;
    }
    add_rectangle(svg, {x, y}, {15.0, 15.0}, filled(color_of_kind(i), 1.0));
    add_short_name(svg, {x + 21.0, y + 12.0}, number + shown[i], number + names[i], Anchor::kStart);
    x += width;
  }
  return y + 24.0;
}

/// Distance of each cell, in cells, from the nearest one of another kind, in the metric of the
/// greater of both coordinates.
std::vector<int> depths_of(const OccupancyGrid& cells) {
  std::vector<int> depths(cells.cells.size());
  const auto of_neighbour = [&](int x, int y, int dx, int dy) {
    const bool is_alike =
        cells.contains(x + dx, y + dy) && cells.at(x + dx, y + dy) == cells.at(x, y);
    return is_alike ? depths[cells.index(x + dx, y + dy)] : 0;
  };
  // One pass from each corner; `back` are the neighbours that it has met before.
  const auto visit = [&](int x, int y, int back) {
    return 1 + std::min({of_neighbour(x, y, back, 0), of_neighbour(x, y, -1, back),
                         of_neighbour(x, y, 0, back), of_neighbour(x, y, 1, back)});
  };
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) depths[cells.index(x, y)] = visit(x, y, -1);
  }
  for (int y = cells.height - 1; y >= 0; --y) {
    for (int x = cells.width - 1; x >= 0; --x) {
      int& depth = depths[cells.index(x, y)];
      depth = std::min(depth, visit(x, y, 1));
    }
  }
  return depths;
}

/// Writes each antenna's number where its area is widest.
void draw_numbers(Svg& svg, MapView& map, const OccupancyGrid& cells, std::size_t count) {
  if (count <= kPlainKinds) return;
  struct Widest {
    int depth = 0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
  };
  std::vector<Widest> widest(count);
  const std::vector<int> depths = depths_of(cells);
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      if (cells.at(x, y) == kNotDrawn) continue;
      Widest& best = widest[static_cast<std::size_t>(cells.at(x, y))];
      const int depth = depths[cells.index(x, y)];
      if (depth > best.depth) best = {depth, cells.centre_of(x, y)};
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (widest[i].depth == 0) continue;
    const Place place = place_in(map.axes, widest[i].place.x(), widest[i].place.y());
    add_rimmed_text(svg, place + Place(0.0, 5.0), fmt::format("{}", i + 1), Anchor::kMiddle);
    take_place(map, place, 9.0);
  }
}

void draw_best(Figure& figure, const Coverage& coverage, const CoverageLayer& layer,
               const std::vector<Silhouette>& top_view) {
  std::vector<std::string> names;
  std::vector<std::string> colors;
  for (std::size_t i = 0; i < std::min(coverage.antennas.size(), kMaxKinds); ++i) {
    names.push_back(clean_text(coverage.antennas[i].name));
    colors.push_back(color_of_kind(i));
  }
  MapView map = begin_map(figure, coverage, draw_kinds(figure.svg, names));
  const OccupancyGrid cells = numbered(coverage.grid, layer, [](const CoverageCell& cell) {
    const bool is_read = cell.antenna >= 0 && cell.probability >= kReadProbability;
    return is_read ? static_cast<std::int8_t>(cell.antenna % static_cast<int>(kMaxKinds))
                   : kNotDrawn;
  });
  draw_cells(figure.svg, map, cells, colors, names);
  end_map(figure, map, top_view);
  draw_antenna_marks(figure.svg, map, coverage);
  draw_numbers(figure.svg, map, cells, names.size());
  draw_antenna_names(figure.svg, map, coverage);
}

void draw_tag(Svg& svg, const Place& place, const TagCoverage& tag, const Coverage& coverage) {
  const std::string said = clean_text(tag.id) + ": " + spoken(coverage, tag);
  switch (tag.verdict) {
    case TagVerdict::kNever:
      return add_cross(svg, place, 6.0, styled("cover-never"), said);
    case TagVerdict::kIntended:
      return add_diamond(svg, place, 8.0, styled("cover-own"), said);
    case TagVerdict::kAlsoOther:
      return add_diamond(svg, place, 8.0, styled("cover-also"), said);
    case TagVerdict::kWrong:
      return add_rectangle(svg, place - Place(6, 6), {12, 12}, styled("cover-wrong"), said);
    case TagVerdict::kSeldom:
      return add_circle(svg, place, 5.0, styled("cover-never"), said);
  }
}

bool is_within(const MapView& map, const Eigen::Vector3d& p) {
  return p.x() >= map.axes.x.low && p.x() <= map.axes.x.high && p.y() >= map.axes.y.low &&
         p.y() <= map.axes.y.high;
}

void draw_tag_names(Svg& svg, MapView& map, const Coverage& coverage) {
  if (coverage.tags.size() > kMaxRows) return;
  for (const TagCoverage& tag : coverage.tags) {
    if (is_within(map, tag.p_WT)) {
      draw_label(svg, map, on_map(map, tag.p_WT), shortened(tag.id, 12));
    }
  }
}

constexpr std::size_t kMaxDataCells = 5000;  ///< Maximum embedded in a page as text.

std::string data_of_cells(const Coverage& coverage, const CoverageLayer& layer) {
  const CoverageGrid& grid = coverage.grid;
  std::string csv = "x_m,y_m,probability,margin_db,power_dbm\n";
  for (std::size_t i = 0; i < layer.cells.size(); ++i) {
    const CoverageCell& cell = layer.cells[i];
    const std::size_t rows_below = i / grid.columns;
    const auto column = static_cast<double>(i % grid.columns) + 0.5;
    const auto row = static_cast<double>(rows_below) + 0.5;
    const bool reached = cell.antenna >= 0;
    add_data(csv, grid.corner_m.x() + grid.step_m * column, grid.corner_m.y() + grid.step_m * row,
             cell.probability, reached ? std::optional(cell.margin_db) : std::nullopt,
             reached ? std::optional(cell.power_dbm) : std::nullopt);
  }
  return csv;
}

}  // namespace

std::string spoken(const Coverage& coverage, const TagCoverage& tag) {
  if (tag.verdict == TagVerdict::kNever) return "never read";
  std::string meant;
  for (const std::string& name : tag.meant_for) meant += (meant.empty() ? "" : ", ") + name;
  meant = clean_text(meant);
  std::string readers;
  for (const ReaderChance& chance : tag.readers) {
    if (chance.probability < kCrossProbability) continue;
    readers += fmt::format("{}{} ({:.0f} %)", readers.empty() ? "" : ", ",
                           clean_text(chance.reader), 100.0 * chance.probability);
  }
  if (tag.verdict == TagVerdict::kSeldom) {
    return fmt::format("seldom read ({:.0f} % in the run){}", 100.0 * tag.probability,
                       readers.empty() ? "" : ", by " + readers);
  }
  if (tag.verdict == TagVerdict::kIntended) {
    return coverage.antennas.size() > 1 ? "read only by " + readers : "read";
  }
  if (tag.verdict == TagVerdict::kAlsoOther) {
    return "read by " + readers + "; meant for " + meant + " alone";
  }
  if (meant.empty()) return "read by " + readers + "; meant for no reader";
  return "read by " + readers + ", not by " + meant;
}

Figure coverage_figure(const Coverage& coverage, const CoverageLayer& layer,
                       CoverageQuantity quantity, const std::vector<Silhouette>& top_view) {
  const Drawn words = words_of(coverage, layer, quantity);
  Figure figure;
  figure.name = fmt::format("{}_{:.2f}m", words.name, layer.height_m + 0.0);
  figure.title = fmt::format("{}, {:.2f} m above the floor", words.title, layer.height_m + 0.0);
  figure.caption = words.caption;
  if (quantity == CoverageQuantity::kAntenna) {
    draw_best(figure, coverage, layer, top_view);
  } else {
    draw_quantity(figure, coverage, layer, quantity, top_view);
  }
  if (layer.cells.size() <= kMaxDataCells) figure.data = data_of_cells(coverage, layer);
  return figure;
}

Figure coverage_tags_figure(const Coverage& coverage, const std::vector<Silhouette>& top_view) {
  Figure figure;
  figure.name = "tags";
  figure.title = "The scenario’s tags";
  figure.caption =
      "By the readers that read them in the run. A tag is meant for its zone’s readers or, without "
      "zones, for that of the antenna that comes nearest to it; all antennas of one robot are one "
      "reader.";
  const double top =
      draw_legend(figure.svg, {{Symbol::kDiamond, "cover-own", "read by its own reader only"},
                               {Symbol::kDiamond, "cover-also", "by others too"},
                               {Symbol::kSquare, "cover-wrong", "by others only"},
                               {Symbol::kRing, "cover-never", "seldom read"},
                               {Symbol::kCross, "cover-never", "never read"}});
  MapView map = begin_map(figure, coverage, top);
  end_map(figure, map, top_view);
  const std::size_t step = thinning(coverage.tags.size(), kMaxMarks);
  for (std::size_t i = 0; i < coverage.tags.size(); i += step) {
    const TagCoverage& tag = coverage.tags[i];
    if (!is_within(map, tag.p_WT)) continue;
    draw_tag(figure.svg, on_map(map, tag.p_WT), tag, coverage);
    take_place(map, on_map(map, tag.p_WT), 7.0);
  }
  draw_antennas(figure.svg, map, coverage);
  draw_tag_names(figure.svg, map, coverage);
  figure.data = "tag,x_m,y_m,z_m,probability,margin_db,who\n";
  for (std::size_t i = 0; i < coverage.tags.size(); i += step) {
    const TagCoverage& tag = coverage.tags[i];
    add_data(figure.data, tag.id, tag.p_WT.x(), tag.p_WT.y(), tag.p_WT.z(), tag.probability,
             tag.best.margin_db, spoken(coverage, tag));
  }
  if (step > 1) figure.caption += fmt::format(" One tag in {} is drawn.", step);
  return figure;
}

}  // namespace tagfield
