// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/inventory_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/text.h"

namespace tagfield {
namespace {

std::string lead_number(const std::string& name, const std::string& value, bool lead = false) {
  return fmt::format("<div{}><dt>{}</dt><dd>{}</dd></div>\n", lead ? " class=\"lead\"" : "",
                     escaped(name), escaped(value));
}

std::string seconds_or_never(const std::optional<double>& time_s) {
  return time_s ? fmt::format("{:.2f} s", *time_s) : "not reached";
}

std::string inventory_head(const std::vector<std::string>& columns, const char* label) {
  std::string html = fmt::format(
      "<div class=\"table told\" role=\"region\" aria-label=\"{}\" tabindex=\"0\">"
      "<table>\n<thead><tr>",
      label);
  for (const std::string& column : columns) html += "<th scope=\"col\">" + column + "</th>";
  return html + "</tr></thead>\n<tbody>\n";
}

std::string inventory_row(const std::string& name, const std::vector<std::string>& cells,
                          const std::string& words = "") {
  std::string html = "<tr><th scope=\"row\"><bdi>" + escaped(name) + "</bdi></th>";
  for (const std::string& cell : cells) html += "<td>" + escaped(cell) + "</td>";
  if (!words.empty()) html += "<td class=\"words\">" + escaped(words) + "</td>";
  return html + "</tr>\n";
}

constexpr const char* kInventoryEnd = "</tbody></table></div>\n";

/// False for the tags outside all zones. A zone without readers is meant for none.
bool is_in_zone(const ZoneInventory& zone) { return !zone.readers.empty() || !zone.cross.empty(); }

std::string cross_words(const ZoneInventory& zone) {
  std::string words;
  for (const CrossRead& cross : zone.cross) {
    if (cross.tags == 0.0) continue;
    words += fmt::format("{}{}: {} ({})", words.empty() ? "" : ", ", cross.reader,
                         counted(static_cast<std::size_t>(std::lround(cross.tags)), "tag"),
                         counted(static_cast<std::size_t>(std::lround(cross.reads)), "read"));
  }
  if (!words.empty()) return words;
  return is_in_zone(zone) ? "none" : "in no zone";
}

std::string zones_table(const InventorySummary& inventory) {
  if (inventory.zones.empty()) return "";
  std::string html =
      "<h2>By zone</h2>\n" + inventory_head({"Zone", "Tags", "Read", "Share", "By its reader",
                                             "Read by others", "Cross reads by"},
                                            "Zones");
  for (const ZoneInventory& zone : inventory.zones) {
    const auto all = static_cast<double>(zone.tags);
    html += inventory_row(zone.zone,
                          {grouped(zone.tags), tally(zone.read), percent_of(zone.read, all),
                           zone.readers.empty() ? "–" : percent_of(zone.read_by_own, all),
                           is_in_zone(zone) ? percent_of(zone.crossed, all) : "–"},
                          cross_words(zone));
  }
  return html + kInventoryEnd;
}

std::string levels_table(const InventorySummary& inventory) {
  if (inventory.levels.size() < 2) return "";
  std::string html = "<h2>By height</h2>\n" +
                     inventory_head({"Level", "Tags", "Read", "Share", "Missed"}, "Levels");
  for (auto level = inventory.levels.rbegin(); level != inventory.levels.rend(); ++level) {
    const bool is_one = level->high_m - level->low_m < 0.005;
    const std::string name =
        is_one ? fmt::format("{:.2f} m", level->low_m + 0.0)
               : fmt::format("{:.2f} to {:.2f} m", level->low_m + 0.0, level->high_m + 0.0);
    const auto all = static_cast<double>(level->tags);
    html += inventory_row(name, {grouped(level->tags), tally(level->read),
                                 percent_of(level->read, all), tally(all - level->read)});
  }
  return html + kInventoryEnd;
}

std::string share_row(const InventoryShare& share, const InventorySummary& inventory,
                      bool is_antenna) {
  const auto all = static_cast<double>(inventory.tags);
  std::vector<std::string> cells = {tally(share.tags), percent_of(share.tags, all),
                                    tally(share.only), tally(share.reads)};
  cells.push_back(
      inventory.duration_s > 0.0 ? fmt::format("{:.1f}", share.reads / inventory.duration_s) : "–");
  if (is_antenna) cells.insert(cells.begin(), clean_text(share.reader));
  return inventory_row(share.name, cells);
}

std::string shares_table(const InventorySummary& inventory, bool is_antenna) {
  std::vector<std::string> columns = {"Reader",     "Tags read", "Share",
                                      "Only by it", "Reads",     "Reads per second"};
  if (is_antenna) columns.insert(columns.begin(), "Antenna");
  std::string html = is_antenna ? "<h2>By antenna</h2>\n" : "<h2>By reader</h2>\n";
  html += inventory_head(columns, is_antenna ? "Antennas" : "Readers");
  for (const InventoryShare& share : is_antenna ? inventory.antennas : inventory.readers) {
    html += share_row(share, inventory, is_antenna);
  }
  return html + kInventoryEnd;
}

std::string without_table(const InventorySummary& inventory) {
  if (inventory.without.empty()) return "";
  std::string html =
      "<h2>Without one antenna</h2>\n" +
      inventory_head({"Without", "Tags read", "Share", "Lost"}, "Without one antenna");
  const auto all = static_cast<double>(inventory.tags);
  for (const InventoryWithout& without : inventory.without) {
    html += inventory_row(without.antenna,
                          {tally(without.read), percent_of(without.read, all),
                           fmt::format("{:.1f}", inventory.read - without.read + 0.0)});
  }
  return html + kInventoryEnd;
}

double crossed(const InventorySummary& inventory) {
  double tags = 0.0;
  for (const ZoneInventory& zone : inventory.zones) tags += zone.crossed;
  return tags;
}

}  // namespace

bool is_inventory_alone(const Summary& summary) {
  return summary.inventory && summary.method == "none";
}

std::string inventory_sentence(const InventorySummary& inventory, std::size_t seeds) {
  std::string text = fmt::format("{} of {} read in {:.1f} s ({}), {} missed", tally(inventory.read),
                                 counted(inventory.tags, "tag"), inventory.duration_s,
                                 percent_of(inventory.read, static_cast<double>(inventory.tags)),
                                 tally(static_cast<double>(inventory.tags) - inventory.read));
  if (seeds > 1) {
    text += fmt::format("; the mean of {} runs, of which the worst read {} and the best {}", seeds,
                        tally(inventory.min_read), tally(inventory.max_read));
  }
  return text + ".";
}

std::string inventory_numbers(const InventorySummary& inventory) {
  const auto all = static_cast<double>(inventory.tags);
  std::string html = "<dl class=\"numbers\">\n";
  html += lead_number("Tags read", percent_of(inventory.read, all), true);
  html += lead_number("Missed", tally(all - inventory.read));
  for (const ReachedShare& reached : inventory.reached) {
    html += lead_number(fmt::format("{:.0f} % read after", 100.0 * reached.share),
                        seconds_or_never(reached.time_s));
  }
  if (inventory.median_reads) {
    html += lead_number("Reads per tag (median)", tally(*inventory.median_reads));
  }
  if (inventory.duration_s > 0.0) {
    html += lead_number("Reads per second",
                        fmt::format("{:.0f}", inventory.reads / inventory.duration_s));
  }
  if (inventory.readers.size() > 1) {
    html += lead_number("Tags cross-read", tally(crossed(inventory)));
  }
  return html + "</dl>\n";
}

std::string inventory_tables(const Summary& summary) {
  if (!summary.inventory) return "";
  const InventorySummary& inventory = *summary.inventory;
  return zones_table(inventory) + levels_table(inventory) +
         (inventory.readers.size() > 1 ? shares_table(inventory, false) : "") +
         shares_table(inventory, true) + without_table(inventory);
}

}  // namespace tagfield
