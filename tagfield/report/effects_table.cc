// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tagfield/report/internal/tables.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

/// "10 of 10, 8.6 mm (p95 16 mm)".
std::string outcome(const EffectCost& cost) {
  std::string located = fmt::format("{} of {}", cost.located, cost.tags);
  if (!cost.error_m) return located;
  return fmt::format("{}, {} (95 % below {})", located, spoken_length(cost.error_m->mean),
                     spoken_length(cost.error_m->p95));
}

const EffectCost* find(const Summary& summary, EffectSet set, const std::string& effect) {
  for (const EffectCost& cost : summary.effects) {
    if (cost.set == set && cost.effect == effect) return &cost;
  }
  return nullptr;
}

std::string cell(const EffectCost* cost) {
  return fmt::format("<td class=\"words\">{}</td><td>{}</td>",
                     cost == nullptr ? "–" : escaped(outcome(*cost)),
                     cost == nullptr ? "–" : grouped(cost->reads));
}

std::string row(const std::string& name, const EffectCost* left, const EffectCost* right) {
  return fmt::format("<tr><th scope=\"row\">{}</th>{}{}</tr>\n", escaped(name), cell(left),
                     cell(right));
}

}  // namespace

std::string effects_table(const Summary& summary) {
  if (summary.effects.empty()) return "";
  std::string html =
      "<h2>Cost of each effect</h2>\n"
      "<p>The same experiment with each effect by itself, and with all but that one: tags located, "
      "their mean error, and reads.</p>\n"
      "<div class=\"table\"><table>\n<thead><tr><th scope=\"col\">Effect</th>"
      "<th scope=\"col\" class=\"words\">Alone</th><th scope=\"col\">Reads</th>"
      "<th scope=\"col\" class=\"words\">All but this</th><th scope=\"col\">Reads</th></tr></thead>"
      "\n<tbody>\n";
  html += row("none (all for comparison)", find(summary, EffectSet::kNone, ""),
              find(summary, EffectSet::kAll, ""));
  for (const EffectCost& cost : summary.effects) {
    if (cost.set != EffectSet::kAlone) continue;
    html += row(cost.effect, &cost, find(summary, EffectSet::kAllButThis, cost.effect));
  }
  return html + "</tbody>\n</table></div>\n";
}

}  // namespace tagfield
