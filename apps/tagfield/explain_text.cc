// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/explain_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/units.h"
#include "tagfield/planning/link_verdict.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxPaths = 12;

std::string place(const Eigen::Vector3d& p) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) m", p.x(), p.y(), p.z());
}

std::string without_unit(double db) {
  const std::string text = signed_db(db);
  return text == "nothing" ? text : text.substr(0, text.size() - 3);
}

/// Right-aligned text; the minus sign has three bytes but is one column wide.
std::string right(const std::string& text, std::size_t width) {
  const bool has_sign = text.find("−") != std::string::npos;
  const std::size_t columns = text.size() - (has_sign ? 2 : 0);
  return std::string(width - std::min(width, columns), ' ') + text;
}

std::string row(const std::string& what, const std::string& number, const std::string& unit) {
  const std::size_t columns =
      what.size() - 2 * static_cast<std::size_t>(std::count(what.begin(), what.end(), '\xe2'));
  const std::string gap(columns < 52 ? 52 - columns : 1, ' ');
  return "  " + what + gap + right(number, 8) + (number == "nothing" ? "" : " " + unit) + "\n";
}

std::string budget(const std::string& title, const std::vector<BudgetLine>& lines,
                   const std::string& result, double power_dbm, const std::string& needs,
                   double sensitivity_dbm) {
  std::string text = "\n" + title + "\n";
  for (const BudgetLine& line : lines) {
    const bool is_power = &line == &lines.front();
    text += row(line.what, without_unit(line.db), is_power ? "dBm" : "dB");
  }
  text += row("= " + result, without_unit(power_dbm), "dBm");
  text += row(needs, without_unit(sensitivity_dbm), "dBm");
  return text + row("margin", without_unit(power_dbm - sensitivity_dbm), "dB");
}

std::string receiver(const PhysicalLink& link) {
  std::string text = "\nat the reader\n";
  if (link.arrives) {
    text += fmt::format("  signal to noise {}, phase {:.3f} rad ± {:.3f} rad (one sigma)\n",
                        signed_db(link.snr_db), link.phase_rad, link.phase_sigma_rad);
  }
  text +=
      fmt::format("  carrier {:.3f} MHz, channel {}\n", link.frequency_hz * 1e-6, link.channel + 1);
  if (link.takes_inventory) {
    text += link.turn ? fmt::format("  Gen2: the antenna's turn begins at {:.3f} s",
                                    to_seconds(*link.turn))
                      : std::string("  Gen2: the antenna has no turn");
    text += !link.heard() ? "\n"
                          : fmt::format("; {:.1f} % of undisturbed replies come through\n",
                                        100.0 * link.decode_probability.value_or(0.0));
  }
  return text;
}

std::string interference_text(const PhysicalLink& link) {
  if (!link.interference) return "";
  const LinkInterference& all = *link.interference;
  if (all.by.empty()) return "\nother readers\n  none transmits at this moment\n";
  std::string text = "\nother readers\n";
  for (const InterferingReader& one : all.by) {
    text += fmt::format("  {} ({}), carrier {:+.3f} MHz off", one.reader, one.antenna,
                        one.offset_hz * 1e-6);
    if (one.time_share < 1.0) text += fmt::format(", {:.0f} % of its time", 100.0 * one.time_share);
    text += "\n";
    text += row("  at the reader", without_unit(one.received_dbm), "dBm");
    text += row("  of it with the reply", without_unit(one.in_replies_dbm), "dBm");
    text += row("  at the chip", without_unit(one.at_tag_dbm), "dBm");
  }
  text += row("receiver's noise", without_unit(all.noise_dbm), "dBm");
  text += row("noise and interference", without_unit(all.total_dbm), "dBm");
  text += row("signal to both (SINR)", without_unit(all.sinr_db), "dB");
  text += row("the reader needs", without_unit(all.required_sinr_db), "dB");
  text += row("own carrier over others at the chip", without_unit(all.capture_db), "dB");
  return text + row("the chip needs", without_unit(all.required_capture_db), "dB");
}

std::string near_tags_text(const PhysicalLink& link) {
  if (link.near_tags.empty()) return "";
  std::string text = "\ntags nearby, and the effect of each alone\n";
  for (const NearTag& near : link.near_tags) {
    text += row(fmt::format("{}, {:.3f} m", near.id, near.distance_m), without_unit(near.alone_db),
                "dB");
  }
  return text;
}

std::string met(const PathExplanation& path) {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  for (const SurfaceOnPath& at : path.bounces) {
    add(fmt::format("off {} ({}, {})", at.object, at.material, signed_db(at.gain_db)));
  }
  for (const SurfaceOnPath& at : path.crossings) {
    const std::string thick =
        at.thickness_m > 0.0 ? fmt::format(", {:.2f} m", at.thickness_m) : std::string();
    add(fmt::format("through {} ({}{}, {})", at.object, at.material, thick,
                    at.opaque ? "blocks" : signed_db(at.gain_db)));
  }
  if (path.edge) {
    add(fmt::format("around {} ({}, {})", path.edge->object, path.edge->material,
                    signed_db(path.edge->gain_db)));
    return text;
  }
  constexpr double kNoticed_db = 0.05;
  if (path.bodies_db && std::abs(*path.bodies_db) > kNoticed_db) {
    add(fmt::format("past moving bodies ({})", signed_db(*path.bodies_db)));
  }
  if (text.empty()) text = "free";
  return (path.order == 0 ? "direct: " : "") + text;
}

std::string paths_text(const std::vector<PathExplanation>& paths) {
  const auto is_shown = [](const PathExplanation& path) {
    return !path.blocked || path.order == 0;
  };
  const auto blocked = static_cast<std::size_t>(
      std::count_if(paths.begin(), paths.end(), [](const auto& path) { return path.blocked; }));
  std::string text = fmt::format("\npaths: {}, and {} blocked\n", paths.size() - blocked, blocked);
  text += "  bounces   length    excess  strength  via\n";
  std::size_t shown = 0;
  std::size_t left = 0;
  for (const PathExplanation& path : paths) {
    if (!is_shown(path)) continue;
    if (shown == kMaxPaths) {
      ++left;
      continue;
    }
    ++shown;
    const std::string strength = path.blocked       ? "blocked"
                                 : path.relative_db ? signed_db(*path.relative_db)
                                                    : "nothing";
    text += fmt::format("  {:7} {:7.2f} m {:7.2f} m {}  {}\n", path.order, path.length_m,
                        path.excess_m, right(strength, 9), met(path));
  }
  if (left > 0) text += fmt::format("  … and {} weaker ones (--json has all)\n", left);
  return text + "  (strength: relative to the unobstructed direct path)\n";
}

std::string materials_text(const PhysicalLink& link) {
  if (link.materials.empty()) return "";
  std::string text = fmt::format("\nmaterials at {:.3f} MHz\n", link.frequency_hz * 1e-6);
  for (const MaterialOnLink& material : link.materials) {
    text += fmt::format("  {}: permittivity {:.3g}, conductivity {:.3g} S/m", material.name,
                        material.permittivity, material.conductivity_s_m);
    text += material.is_measured_here
                ? "\n"
                : fmt::format(" (extrapolated: given from {:g} to {:g} GHz)\n", material.min_ghz,
                              material.max_ghz);
  }
  return text;
}

std::string paper_text(const PaperLink& link) {
  return "\nby the paper's model, which knows neither obstacles nor antenna patterns\n" +
         fmt::format("  range {:.3f} m, {:.3f} m in the update at {:.3f} s\n", link.range_m,
                     link.perturbed_range_m, to_seconds(link.update)) +
         fmt::format("  read in {:.1f} % of all updates at this distance\n",
                     100.0 * link.read_probability) +
         fmt::format("  phase {:.3f} rad (eq. 4), RSSI {:.0f} dBm (eq. 5), both without noise\n",
                     link.phase_rad, link.rssi_dbm);
}

}  // namespace

std::string to_text(const LinkExplanation& link) {
  std::string text = link.verdict + "\n\n";
  text += fmt::format("antenna {} at {}\ntag {} at {}, {:.3f} m away\nat {:g} s\n", link.antenna,
                      place(link.X_WA.translation), link.tag, place(link.X_WT.translation),
                      link.distance_m, to_seconds(link.time));
  if (link.antennas_compared > 1) {
    text += fmt::format("(of {} antennas the one with the best link; --antenna names another)\n",
                        link.antennas_compared);
  }
  if (link.paper) return text + paper_text(*link.paper);
  const PhysicalLink& physical = *link.physical;
  text += budget("to the tag", physical.to_tag, "power at the chip", physical.tag_dbm,
                 "the chip needs", physical.tag_sensitivity_dbm);
  text += budget("back to the reader", physical.to_reader, "power at the reader",
                 physical.reply_dbm, "the reader needs", physical.reader_sensitivity_dbm);
  text += receiver(physical) + interference_text(physical) + near_tags_text(physical);
  return text + paths_text(physical.paths) + materials_text(physical);
}

}  // namespace tagfield
