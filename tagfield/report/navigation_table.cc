#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/units.h"
#include "tagfield/report/tables.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

std::string row(const std::string& name, const std::string& value, const std::string& meaning) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"words\">{}</td></tr>\n",
                     escaped(name), escaped(value), escaped(meaning));
}

/// Never 100 % where anything is missing, nor 0 % where anything is there.
std::string percent(double share) {
  double value = 100.0 * share;
  if (share < 1.0) value = std::min(value, 99.9);
  if (share > 0.0) value = std::max(value, 0.1);
  return share == 0.0 || share == 1.0 ? fmt::format("{:.0f} %", value)
                                      : fmt::format("{:.1f} %", value);
}

std::string degrees_of(double angle_rad) {
  return fmt::format("{:.2f}°", angle_rad * (180.0 / kPi));
}

std::string map_rows(const NavigationSummary& navigation) {
  return row("Walls found", percent(navigation.walls_found),
             "of the walls that its laser can see, mapped to within one cell") +
         row("False walls", percent(navigation.walls_false),
             "of the walls on the map: nothing stands within two cells of them") +
         row("Double walls", percent(navigation.walls_double),
             "of the walls are on the map twice, side by side") +
         row("Floor known", percent(navigation.floor_known),
             "of the floor that can be reached is free on the map");
}

std::string mapping_row(const NavigationSummary& navigation) {
  if (navigation.mapping_path_m == 0.0) return row("Mapping", "none", "the map was given");
  return row(
      "Mapping", fmt::format("{:.1f} m", navigation.mapping_path_m),
      fmt::format("driven for the map, in {:.0f} s of simulated time", navigation.mapping_s));
}

std::string pose_rows(const NavigationSummary& navigation) {
  std::string rows;
  if (const auto& error = navigation.position_error_m) {
    rows += row("Position off by", spoken_length(error->mean),
                fmt::format("in the mean, 95 % of the time by less than {}, {} at most",
                            spoken_length(error->p95), spoken_length(error->max)));
  }
  if (const auto& error = navigation.yaw_error_rad) {
    rows += row("Heading off by", degrees_of(error->mean),
                fmt::format("in the mean, 95 % of the time by less than {}, {} at most",
                            degrees_of(error->p95), degrees_of(error->max)));
  }
  return rows;
}

std::string driving_rows(const NavigationSummary& navigation) {
  return row("Goals reached",
             fmt::format("{} of {}", grouped(navigation.goals_reached), grouped(navigation.goals)),
             "places that it was sent to") +
         row("Least distance", spoken_length(std::max(navigation.closest_m, 0.0)),
             "between its rim and anything else") +
         row("Times lost", grouped(navigation.times_lost), "times it no longer knew where it was");
}

}  // namespace

std::string navigation_table(const Summary& summary) {
  if (!summary.navigation) return "";
  const NavigationSummary& navigation = *summary.navigation;
  std::string html =
      "<h2>Navigation</h2>\n<p>How the robot found its way by laser, wheels and its map.</p>\n";
  html += "<div class=\"table told\"><table>\n<tbody>\n" + map_rows(navigation) +
          mapping_row(navigation) + pose_rows(navigation) + driving_rows(navigation) +
          "</tbody></table></div>\n";
  if (summary.seeds.size() > 1) {
    html += fmt::format(
        "<p class=\"muted\">Of {} seeds: the map and the least distance are the worst, mapping is"
        " the first, poses, goals and losses are of all.</p>\n",
        summary.seeds.size());
  }
  return html;
}

}  // namespace tagfield
