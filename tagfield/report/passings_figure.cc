// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/passings_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "tagfield/report/axes.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/tables.h"
#include "tagfield/report/style_sheet.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

constexpr double kPassingNames = 122.0;
constexpr std::size_t kMaxGates = kSeriesColors;

/// From the first read to the last.
using ReadSpan = std::pair<Time, Time>;

std::map<std::string, ReadSpan> spans_of(const std::vector<TagRead>& reads) {
  std::map<std::string, ReadSpan> spans;
  for (const TagRead& read : reads) {
    const auto [span, is_new] = spans.try_emplace(read.tag, read.stamp, read.stamp);
    span->second.first = std::min(span->second.first, read.stamp);
    span->second.second = std::max(span->second.second, read.stamp);
  }
  return spans;
}

/// Tags in the first passing order, then those that are only in others.
std::vector<std::string> tags_in_order(const std::vector<PassingOrder>& orders) {
  std::vector<std::string> tags;
  std::set<std::string> known;
  for (const PassingOrder& order : orders) {
    for (const Passing& passing : order.passings) {
      if (known.insert(passing.tag).second) tags.push_back(passing.tag);
    }
  }
  return tags;
}

const Passing* passing_of_tag(const PassingOrder& order, const std::string& tag) {
  const auto found = std::find_if(order.passings.begin(), order.passings.end(),
                                  [&](const Passing& passing) { return passing.tag == tag; });
  return found == order.passings.end() ? nullptr : &*found;
}

std::string spoken_gate(const PassingOrder& order) {
  return order.name == "line" ? "the line" : shortened(order.name, 22);
}

void draw_passing(Svg& svg, const Axes& axes, const PassingOrder& order, const Passing& passing,
                  std::size_t number, double y) {
  const double time = to_seconds(passing.stamp);
  add_circle(svg, {place_on(axes.x, time), y}, 5.0, styled(fmt::format("dot{}", number)),
             fmt::format("{} passed {} at {:.3f} s, ±{:.0f} ms", clean_text(passing.tag),
                         spoken_gate(order), time, 1e3 * passing.sigma_s));
}

Axes passing_axes(const std::map<std::string, ReadSpan>& spans,
                  const std::vector<std::string>& tags, std::size_t shown, double top) {
  Time first = Time::max();
  Time last = Time::min();
  for (std::size_t i = 0; i < shown; ++i) {
    const auto span = spans.find(tags[i]);
    if (span == spans.end()) continue;
    first = std::min(first, span->second.first);
    last = std::max(last, span->second.second);
  }
  const double from = first < last ? to_seconds(first) : 0.0;
  const double to = first < last ? to_seconds(last) : 1.0;
  Axes axes{tight_scale(from, to, 6), {}};
  axes.x.from = kPassingNames;
  axes.x.to = kDrawingWidth - 20.0;
  axes.y.to = top;
  axes.y.from = top + row_height(shown) * static_cast<double>(shown) + 4.0;
  return axes;
}

void draw_span(Svg& svg, const Axes& axes, const std::string& tag, const ReadSpan& span, double y) {
  const double from = place_on(axes.x, to_seconds(span.first));
  const double to = place_on(axes.x, to_seconds(span.second));
  add_rectangle(svg, {from, y - 5.0}, {std::max(to - from, 1.0), 10.0}, styled("band"),
                fmt::format("{}: read from {:.2f} to {:.2f} s", clean_text(tag),
                            to_seconds(span.first), to_seconds(span.second)));
}

std::string data_of_passings(const std::vector<PassingOrder>& orders,
                             const std::map<std::string, ReadSpan>& spans) {
  std::string csv = "tag,passed,time_s,sigma_s,first_read_s,last_read_s\n";
  for (const PassingOrder& order : orders) {
    for (const Passing& passing : order.passings) {
      const auto span = spans.find(passing.tag);
      const bool known = span != spans.end();
      add_data(csv, passing.tag, order.name, format_stamp(passing.stamp), passing.sigma_s,
               known ? format_stamp(span->second.first) : "",
               known ? format_stamp(span->second.second) : "");
    }
  }
  return csv;
}

std::string head_of_passings(const std::vector<PassingOrder>& orders) {
  std::string html = "<thead><tr><th scope=\"col\">Tag</th>";
  for (const PassingOrder& order : orders) {
    html +=
        "<th scope=\"col\">Passed " + escaped(spoken_gate(order)) +
        "<br>[s]</th><th scope=\"col\">±<br>[ms]</th><th scope=\"col\">Before the<br>next [%]</th>";
  }
  return html + "</tr></thead>\n<tbody>\n";
}

/// The probability in per cent, never shown as 100.
std::string spoken_sureness(double probability) {
  if (probability > 0.9995) return "> 99.9";
  return fmt::format("{:.1f}", 100.0 * probability);
}

std::string passing_cells(const PassingOrder& order, const std::string& tag) {
  const Passing* const passing = passing_of_tag(order, tag);
  if (passing == nullptr) return "<td>–</td><td>–</td><td>–</td>";
  const auto next = static_cast<std::size_t>(passing - order.passings.data()) + 1;
  return fmt::format("<td>{:.3f}</td><td>{:.0f}</td><td>{}</td>", to_seconds(passing->stamp),
                     1e3 * passing->sigma_s,
                     next < order.passings.size()
                         ? spoken_sureness(probability_before(*passing, order.passings[next]))
                         : "–");
}

}  // namespace

Figure passings_figure(const std::vector<TagRead>& reads, const std::vector<PassingOrder>& orders) {
  Figure figure{"passings", "", "When tags passed", "", {}, ""};
  const std::vector<std::string> tags = tags_in_order(orders);
  if (tags.empty()) {
    figure.missing = "no tag was tracked past an antenna at rest or the line.";
    return figure;
  }
  const std::size_t gates = std::min(orders.size(), kMaxGates);
  const std::size_t shown = std::min(tags.size(), kMaxRows);
  const std::map<std::string, ReadSpan> spans = spans_of(reads);
  std::vector<LegendEntry> legend = {{Symbol::kSquare, "band", "read"}};
  for (std::size_t i = 0; i < gates; ++i) {
    legend.push_back({Symbol::kRing, fmt::format("dot{}", i), "passed " + spoken_gate(orders[i])});
  }
  const double top = draw_legend(figure.svg, legend) + 4.0;
  const Axes axes = passing_axes(spans, tags, shown, top);
  figure.svg.height = axes.y.from + 48.0;
  draw_x_axis(figure.svg, axes, "time [s]");
  for (std::size_t i = 0; i < shown; ++i) {
    const double y = top + row_height(shown) * (static_cast<double>(i) + 0.5) + 2.0;
    add_text(figure.svg, {kPassingNames - 10.0, y + 5.0}, shortened(tags[i], 12), Anchor::kEnd);
    const auto span = spans.find(tags[i]);
    if (span != spans.end()) draw_span(figure.svg, axes, tags[i], span->second, y);
    for (std::size_t k = 0; k < gates; ++k) {
      const Passing* const passing = passing_of_tag(orders[k], tags[i]);
      if (passing != nullptr) draw_passing(figure.svg, axes, orders[k], *passing, k, y);
    }
  }
  figure.caption = fmt::format(
      "One row per tag, in the order in which they passed {}: from its first read to its last, and "
      "when its track passed each antenna at rest, where it was nearest, or crossed the line.",
      spoken_gate(orders.front()));
  if (shown < tags.size()) {
    figure.caption += fmt::format(" The first {} of {} tags.", shown, grouped(tags.size()));
  }
  figure.data = data_of_passings(orders, spans);
  return figure;
}

std::string passings_table(const std::vector<PassingOrder>& orders) {
  const std::vector<std::string> tags = tags_in_order(orders);
  if (tags.empty()) return "";
  std::string html =
      "<h2>Order</h2>\n<div class=\"table\" role=\"region\" aria-label=\"Order\" "
      "tabindex=\"0\"><table>\n" +
      head_of_passings(orders);
  const std::size_t shown = std::min(tags.size(), kMaxTableRows);
  for (std::size_t i = 0; i < shown; ++i) {
    html += "<tr><th scope=\"row\" title=\"" + escaped(tags[i]) + "\"><bdi>" +
            escaped(shortened(tags[i], 28)) + "</bdi></th>";
    for (const PassingOrder& order : orders) html += passing_cells(order, tags[i]);
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  if (shown < tags.size()) {
    html += fmt::format("<p class=\"muted\">The first {} of {} tags; order.csv holds all.</p>\n",
                        shown, grouped(tags.size()));
  }
  return html +
         "<p class=\"muted\">±: standard deviation by the track’s covariance. Before the next: "
         "the probability that the tag passed before the one that follows it there.</p>\n";
}

}  // namespace tagfield
