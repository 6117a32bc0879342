// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/svg.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/report/style_sheet.h"

namespace tagfield {
namespace {

/// Adds one element without content except its tooltip.
void add_element(Svg& svg, const std::string& opening, const Look& look,
                 const std::string& tooltip) {
  svg.body += fmt::format("<{} {}", opening, look.attributes);
  if (tooltip.empty()) {
    svg.body += "/>\n";
    return;
  }
  const std::string name = opening.substr(0, opening.find(' '));
  svg.body += fmt::format("><title>{}</title></{}>\n", escaped(tooltip), name);
}

std::string anchor_attribute(Anchor anchor) {
  if (anchor == Anchor::kStart) return "";
  return anchor == Anchor::kMiddle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
}

}  // namespace

Look styled(const std::string& css_class) { return {fmt::format("class=\"{}\"", css_class)}; }

Look filled(const std::string& color, double opacity) {
  return {fmt::format("fill=\"{}\" fill-opacity=\"{}\"", color, compact(opacity))};
}

Look stroked(const std::string& color, double opacity, double width) {
  return {fmt::format("stroke=\"{}\" stroke-opacity=\"{}\" stroke-width=\"{}\" fill=\"none\"",
                      color, compact(opacity), compact(width))};
}

std::string compact(double number) {
  if (!std::isfinite(number)) return "0";
  std::string text = fmt::format("{:.2f}", number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

void add_line(Svg& svg, const Place& from, const Place& to, const Look& look,
              const std::string& tooltip) {
  add_element(svg,
              fmt::format("line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"", compact(from.x()),
                          compact(from.y()), compact(to.x()), compact(to.y())),
              look, tooltip);
}

void add_polyline(Svg& svg, const std::vector<Place>& places, const Look& look) {
  std::string points;
  for (const Place& place : places) {
    points +=
        fmt::format("{}{},{}", points.empty() ? "" : " ", compact(place.x()), compact(place.y()));
  }
  add_element(svg, fmt::format("polyline points=\"{}\"", points), look, "");
}

void add_circle(Svg& svg, const Place& center, double radius, const Look& look,
                const std::string& tooltip) {
  add_element(svg,
              fmt::format("circle cx=\"{}\" cy=\"{}\" r=\"{}\"", compact(center.x()),
                          compact(center.y()), compact(radius)),
              look, tooltip);
}

void add_rectangle(Svg& svg, const Place& corner, const Place& size, const Look& look,
                   const std::string& tooltip) {
  add_element(svg,
              fmt::format("rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", compact(corner.x()),
                          compact(corner.y()), compact(size.x()), compact(size.y())),
              look, tooltip);
}

void add_path(Svg& svg, const std::string& data, const Look& look, const std::string& tooltip) {
  add_element(svg, fmt::format("path d=\"{}\"", data), look, tooltip);
}

void add_text(Svg& svg, const Place& place, const std::string& text, Anchor anchor,
              const std::string& css_class) {
  svg.body +=
      fmt::format("<text x=\"{}\" y=\"{}\"{}{}>{}</text>\n", compact(place.x()), compact(place.y()),
                  anchor_attribute(anchor),
                  css_class.empty() ? "" : fmt::format(" class=\"{}\"", css_class), escaped(text));
}

void add_rimmed_text(Svg& svg, const Place& place, const std::string& text, Anchor anchor) {
  // Two elements, since not every SVG viewer supports paint-order.
  add_text(svg, place, text, anchor, "rim");
  add_text(svg, place, text, anchor);
}

double text_width(const std::string& text) {
  return 0.56 * kFontSize * static_cast<double>(length_of(text));
}

void add_diamond(Svg& svg, const Place& center, double radius, const Look& look,
                 const std::string& tooltip) {
  const std::string r = compact(radius);
  add_path(svg,
           fmt::format("M{},{}l{},{}l-{},{}l-{},-{}z", compact(center.x()),
                       compact(center.y() - radius), r, r, r, r, r, r),
           look, tooltip);
}

void add_cross(Svg& svg, const Place& center, double radius, const Look& look,
               const std::string& tooltip) {
  const double r = radius;
  const std::string across = compact(2.0 * r);
  add_path(
      svg,
      fmt::format("M{},{}l{},{}M{},{}l{},-{}", compact(center.x() - r), compact(center.y() - r),
                  across, across, compact(center.x() - r), compact(center.y() + r), across, across),
      look, tooltip);
}

void begin_clip(Svg& svg, const std::string& id, const Place& corner, const Place& size) {
  svg.body += fmt::format(
      "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n"
      "<g clip-path=\"url(#{0})\">\n",
      id, compact(corner.x()), compact(corner.y()), compact(size.x()), compact(size.y()));
}

void end_clip(Svg& svg) { end_group(svg); }

void begin_group(Svg& svg, const std::string& attributes) {
  svg.body += fmt::format("<g {}>\n", attributes);
}

void end_group(Svg& svg) { svg.body += "</g>\n"; }

std::string inline_svg(const Svg& svg, const std::string& label) {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
                     compact(kDrawingWidth), compact(svg.height), escaped(label), svg.body);
}

std::string standalone_svg(const Svg& svg, const std::string& title,
                           const std::string& description) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\">\n"
      "<title>{2}</title>\n<desc>{3}</desc>\n<style>\n{4}</style>\n{5}</svg>\n",
      compact(kDrawingWidth), compact(svg.height), escaped(title), escaped(description),
      figure_style(light_palette()), svg.body);
}

}  // namespace tagfield
