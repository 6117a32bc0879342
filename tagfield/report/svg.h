// SPDX-License-Identifier: Apache-2.0
/// @file
/// A small SVG writer. Lengths are in units of the drawing, x to the right, y down.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/report/text.h"

namespace tagfield {

inline constexpr double kDrawingWidth = 560.0;  ///< Of all figures: scaled by 2/3 on a phone.
inline constexpr double kFontSize = 15.0;       ///< Of all text: 9.6 px on a phone.

/// A drawing under construction: a list of elements.
struct Svg {
  double height = 0.0;
  std::string body;
};

using Place = Eigen::Vector2d;

/// The look of an element, as attributes: a class of the style sheet, or a colour of its own.
struct Look {
  std::string attributes;
};
Look styled(const std::string& css_class);
/// `color` as "#rrggbb"; opacity in [0, 1].
Look filled(const std::string& color, double opacity);
Look stroked(const std::string& color, double opacity, double width);

/// A number with at most two decimals: "12.5".
std::string compact(double number);

// Each adds one element. `tooltip` is plain text, escaped here; "" for none.
void add_line(Svg& svg, const Place& from, const Place& to, const Look& look,
              const std::string& tooltip = "");
void add_polyline(Svg& svg, const std::vector<Place>& places, const Look& look);
void add_circle(Svg& svg, const Place& center, double radius, const Look& look,
                const std::string& tooltip = "");
void add_rectangle(Svg& svg, const Place& corner, const Place& size, const Look& look,
                   const std::string& tooltip = "");
/// `data` as in SVG's d attribute.
void add_path(Svg& svg, const std::string& data, const Look& look, const std::string& tooltip = "");

enum class Anchor { kStart, kMiddle, kEnd };
/// `place` is on the baseline. `text` is escaped here.
void add_text(Svg& svg, const Place& place, const std::string& text, Anchor anchor,
              const std::string& css_class = "");
/// Text that is readable over other elements, with a rim in the background colour.
void add_rimmed_text(Svg& svg, const Place& place, const std::string& text, Anchor anchor);
/// Approximate width of a text, from its number of characters.
double text_width(const std::string& text);

void add_diamond(Svg& svg, const Place& center, double radius, const Look& look,
                 const std::string& tooltip = "");
void add_cross(Svg& svg, const Place& center, double radius, const Look& look,
               const std::string& tooltip = "");

/// Everything added between these two calls is clipped to a rectangle; `id` must be unique on the
/// page.
void begin_clip(Svg& svg, const std::string& id, const Place& corner, const Place& size);
void end_clip(Svg& svg);

/// Everything added between these two calls is in one group with `attributes`.
void begin_group(Svg& svg, const std::string& attributes);
void end_group(Svg& svg);

/// The drawing as a part of an HTML page, with its style sheet; `label` describes it for screen
/// readers.
std::string inline_svg(const Svg& svg, const std::string& label);

/// The drawing as a standalone file, with its own style (light, no background).
std::string standalone_svg(const Svg& svg, const std::string& title,
                           const std::string& description);

}  // namespace tagfield
