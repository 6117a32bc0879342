// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/units.h"
#include "tagfield/report/internal/tables.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

std::string row(const std::string& name, const std::string& value, const std::string& meaning) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"words\">{}</td></tr>\n",
                     escaped(name), escaped(value), escaped(meaning));
}

/// Never 100 % if anything is missing, nor 0 % if there is anything.
std::string percent(double share) {
  double value = 100.0 * share;
  if (share < 1.0) value = std::min(value, 99.9);
  if (share > 0.0) value = std::max(value, 0.1);
  return share == 0.0 || share == 1.0 ? fmt::format("{:.0f} %", value)
                                      : fmt::format("{:.1f} %", value);
}

std::string degrees_of(double angle_rad) { return fmt::format("{:.2f}°", degrees(angle_rad)); }

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
                fmt::format("on average, 95 % of the time by less than {}, {} at most",
                            spoken_length(error->p95), spoken_length(error->max)));
  }
  if (const auto& error = navigation.yaw_error_rad) {
    rows += row("Heading off by", degrees_of(error->mean),
                fmt::format("on average, 95 % of the time by less than {}, {} at most",
                            degrees_of(error->p95), degrees_of(error->max)));
  }
  return rows;
}

/// Rows for the first few goals, each with its reason.
std::string unreached_rows(const NavigationSummary& navigation) {
  constexpr std::size_t kMaxRows = 10;
  const auto& goals = navigation.goals_unreached;
  std::string rows;
  for (std::size_t i = 0; i < std::min(goals.size(), kMaxRows); ++i) {
    rows +=
        row("Not reached", fmt::format("({:.2f}, {:.2f}) m", goals[i].goal.x(), goals[i].goal.y()),
            fmt::format("with seed {}: {}", goals[i].seed, goals[i].reason));
  }
  if (goals.size() <= kMaxRows) return rows;
  return rows + row("Not reached", fmt::format("{} more", grouped(goals.size() - kMaxRows)),
                    "in summary.json");
}

std::string finding_row(const std::string& name, const std::string& what,
                        const std::optional<FindingSummary>& finding) {
  if (!finding) return "";
  std::string words = what;
  if (finding->seconds && finding->driven_m) {
    words += fmt::format(", after {:.1f} m and {:.0f} s on average, {:.1f} m and {:.0f} s at most",
                         finding->driven_m->mean, finding->seconds->mean, finding->driven_m->max,
                         finding->seconds->max);
  }
  if (finding->wrong > 0) {
    words += fmt::format("; mistook another place for its own {}", counted(finding->wrong, "time"));
  }
  return row(name, fmt::format("{} of {}", grouped(finding->found), grouped(finding->count)),
             words);
}

std::string driving_rows(const NavigationSummary& navigation) {
  return row("Goals reached",
             fmt::format("{} of {}", grouped(navigation.goals_reached), grouped(navigation.goals)),
             "goals that it was sent to") +
         unreached_rows(navigation) +
         row("Minimum distance", spoken_length(std::max(navigation.closest_m, 0.0)),
             "between its outline and anything else") +
         row("Collisions", grouped(navigation.collisions), "times it touched anything") +
         finding_row("Unknown starts", "found out where it was", navigation.unknown_starts) +
         finding_row("Kidnapped", "found out where it was put", navigation.kidnapped) +
         row("Times lost", grouped(navigation.times_lost), "times it no longer knew where it was");
}

}  // namespace

std::string navigation_table(const Summary& summary) {
  if (!summary.navigation) return "";
  const NavigationSummary& navigation = *summary.navigation;
  std::string html =
      "<h2>Navigation</h2>\n<p>How the robot navigated by laser, wheels and its map.</p>\n";
  html += "<div class=\"table told\"><table>\n<tbody>\n" + map_rows(navigation) +
          mapping_row(navigation) + pose_rows(navigation) + driving_rows(navigation) +
          "</tbody></table></div>\n";
  if (summary.seeds.size() > 1) {
    html += fmt::format(
        "<p class=\"muted\">Of {} seeds: the map and the minimum distance are those of the worst, "
        "mapping that of the first, poses, goals and losses those of all.</p>\n",
        summary.seeds.size());
  }
  return html;
}

}  // namespace tagfield
