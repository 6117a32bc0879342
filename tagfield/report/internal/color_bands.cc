// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/color_bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tagfield/report/internal/color_map.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxBands = 12;

std::string label_of(double value) {
  return value < 0.0 ? fmt::format("−{:g}", -value) : fmt::format("{:g}", value);
}

void label_edges(ColorBands& bands) {
  for (const double edge : bands.edges) bands.labels.push_back(label_of(edge));
}

}  // namespace

std::size_t band_of(const ColorBands& bands, double value) {
  const auto above = std::upper_bound(bands.edges.begin(), bands.edges.end(), value);
  return static_cast<std::size_t>(above - bands.edges.begin());
}

std::string words_of_band(const ColorBands& bands, std::size_t band) {
  if (bands.edges.empty()) return bands.title;
  if (band == 0) return fmt::format("{}: below {}", bands.title, bands.labels.front());
  if (band == bands.edges.size()) {
    return fmt::format("{}: {} or more", bands.title, bands.labels.back());
  }
  return fmt::format("{}: {} to {}", bands.title, bands.labels[band - 1], bands.labels[band]);
}

Look band_look(const std::string& color, const std::string& words) {
  Look look = filled(color, 1.0);
  look.attributes += fmt::format(" fill-rule=\"evenodd\" data-cell=\"{}\"", escaped(words));
  return look;
}

ColorBands power_bands(const std::string& title, std::vector<double> values) {
  ColorBands bands;
  bands.title = title;
  if (values.empty()) values = {0.0};
  const auto [low, high] = color_range(values);
  double step = 5.0;
  while ((high - low) / step > static_cast<double>(kMaxBands - 2)) step *= 2.0;
  const double first = std::floor(low / step) * step;
  const double last = std::max(std::ceil(high / step) * step, first + step);
  for (double edge = first; edge < last + 0.5 * step; edge += step) bands.edges.push_back(edge);
  for (std::size_t i = 0; i <= bands.edges.size(); ++i) {
    const double strength = static_cast<double>(i) / static_cast<double>(bands.edges.size());
    bands.colors.push_back(hex_color(strength_color(strength)));
  }
  label_edges(bands);
  return bands;
}

ColorBands margin_bands() {
  ColorBands bands;
  bands.title = "margin [dB]";
  bands.edges = {-30, -20, -10, -3, 0, 3, 10, 20, 30};
  bands.colors = {"#482475", "#443983", "#3b518b", "#31688e", "#2a788e",
                  "#22a884", "#44bf70", "#7ad151", "#bddf26", "#fde725"};
  label_edges(bands);
  return bands;
}

ColorBands probability_bands() {
  ColorBands bands;
  bands.title = "read [%]";
  bands.edges = {0.01, 0.25, 0.5, 0.75, 0.95, 0.9999};
  bands.colors = {"", "#46327e", "#365c8d", "#277f8e", "#2fb47c", "#8fd744", "#e3dc2c"};
  bands.labels = {"1", "25", "50", "75", "95", "100"};
  return bands;
}

ColorBands agreement_bands(double most) {
  ColorBands bands;
  bands.title = "agreement";
  const double tenths = std::max(std::ceil(10.0 * most), 1.0);
  for (int i = 1; i < 10; ++i) bands.edges.push_back(0.01 * tenths * i);
  bands.colors = {"#440154", "#482878", "#3e4989", "#31688e", "#26828e",
                  "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"};
  for (const double edge : bands.edges) bands.labels.push_back(fmt::format("{:g}", edge));
  return bands;
}

void draw_band_bar(Svg& svg, double y, const ColorBands& bands) {
  constexpr double kTitleWidth = 118.0;
  const double width =
      (kDrawingWidth - kTitleWidth - 14.0) / static_cast<double>(bands.colors.size());
  add_text(svg, {2.0, y + 12.0}, bands.title, Anchor::kStart);
  for (std::size_t i = 0; i < bands.colors.size(); ++i) {
    const double x = kTitleWidth + static_cast<double>(i) * width;
    if (bands.colors[i].empty()) {
      add_rectangle(svg, {x, y}, {width, 15.0}, styled("frame"));
    } else {
      add_rectangle(svg, {x, y}, {width + 0.3, 15.0}, filled(bands.colors[i], 1.0));
    }
    if (i == 0) continue;
    add_line(svg, {x, y + 15.0}, {x, y + 20.0}, styled("axis"));
    add_text(svg, {x, y + 36.0}, bands.labels[i - 1], Anchor::kMiddle, "faint");
  }
}

const std::string& color_of_kind(std::size_t number) {
  // The second round is the first mixed with 55 % white, the third with 45 % black.
  static const std::array<std::string, 24> kColors = {
      "#3c8ec9", "#e08a1e", "#2fa36b", "#c8539b", "#8c6bd1", "#b3a125", "#4fb8c4", "#d1564a",
      "#a7cce7", "#f1ca9a", "#a1d6bc", "#e6b2d2", "#cbbcea", "#ddd59d", "#b0dfe4", "#eab3ae",
      "#214e6f", "#7b4c10", "#1a5a3b", "#6e2e55", "#4d3b73", "#625914", "#2b656c", "#732f29"};
  return kColors[number % kColors.size()];
}

}  // namespace tagfield
