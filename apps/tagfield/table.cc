// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "tagfield/report/text.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxRows = 60;

double millimetres(double metres) { return 1e3 * metres; }

/// Formats an error; 0 means that a third-party table does not state it.
std::string stated(double error_m, int width) {
  return error_m > 0.0 ? fmt::format("{:{}.1f}", millimetres(error_m), width)
                       : fmt::format("{:>{}}", "-", width);
}

std::string place_columns(const Eigen::Vector3d& p) {
  return fmt::format("{:8.3f} {:8.3f} {:7.3f}", p.x(), p.y(), p.z());
}

std::size_t name_width(const Summary& summary) {
  std::size_t width = 3;
  for (const TagOutcome& tag : summary.tags) width = std::max(width, tag.estimate.tag.size());
  return width;
}

std::string row_of(const TagOutcome& tag, std::size_t width) {
  const TagEstimate& estimate = tag.estimate;
  if (estimate.verdict == Verdict::kNotLocated) {
    return fmt::format("{:<{}}  {} ({} reads)\n", estimate.tag, width, estimate.reason, tag.reads);
  }
  if (estimate.verdict == Verdict::kAmbiguous) {
    std::string text = fmt::format("{:<{}}  ambiguous ({} reads): {}\n", estimate.tag, width,
                                   tag.reads, estimate.reason);
    for (const Candidate& candidate : estimate.candidates) {
      text += fmt::format("{:<{}}  {}  candidate\n", "", width, place_columns(candidate.p_WT));
    }
    return text;
  }
  const Candidate& best = estimate.candidates.front();
  if (tag.reference) {
    return fmt::format("{:<{}}  {} a reference tag\n", estimate.tag, width,
                       place_columns(best.p_WT));
  }
  const auto error = error_of(tag);
  const std::string error_text =
      error ? fmt::format("{:9.1f}", millimetres(*error)) : fmt::format("{:>9}", "-");
  return fmt::format("{:<{}}  {} {} {} {} {:7}\n", estimate.tag, width, place_columns(best.p_WT),
                     error_text, stated(best.rms_m, 8), stated(best.expected_error_m, 11),
                     tag.reads);
}

std::string rows_of_one_seed(const Summary& summary) {
  const std::size_t width = name_width(summary);
  std::string text =
      fmt::format("{:<{}}  {:>8} {:>8} {:>7} {:>9} {:>8} {:>11} {:>7}\n", "tag", width, "x [m]",
                  "y [m]", "z [m]", "err [mm]", "E [mm]", "expect [mm]", "reads");
  for (std::size_t i = 0; i < std::min(summary.tags.size(), kMaxRows); ++i) {
    text += row_of(summary.tags[i], width);
  }
  if (summary.tags.size() > kMaxRows) {
    text += fmt::format("… and {} more (estimates.csv has all)\n", summary.tags.size() - kMaxRows);
  }
  return text;
}

using Outcomes = std::vector<const TagOutcome*>;

std::size_t count_of(const Outcomes& outcomes, Verdict verdict) {
  return static_cast<std::size_t>(std::count_if(
      outcomes.begin(), outcomes.end(),
      [&](const TagOutcome* outcome) { return outcome->estimate.verdict == verdict; }));
}

/// Why a tag, by its outcomes in all seeds, has no errors.
std::string why_no_errors(const Outcomes& outcomes) {
  if (outcomes.front()->reference) return "a reference tag";
  const std::size_t located = count_of(outcomes, Verdict::kLocated);
  if (located > 0) {
    const bool moved = std::any_of(outcomes.begin(), outcomes.end(),
                                   [](const TagOutcome* outcome) { return outcome->moved; });
    return fmt::format("located in {} of {} seeds, but {}", located, outcomes.size(),
                       moved ? "it moved, so there is no error" : "its true position is unknown");
  }
  const std::size_t ambiguous = count_of(outcomes, Verdict::kAmbiguous);
  if (ambiguous == 0) return "not located in any seed";
  return fmt::format("not located in any seed, ambiguous in {} of {}", ambiguous, outcomes.size());
}

std::string row_of(const std::string& tag, const Outcomes& outcomes, std::size_t width) {
  std::vector<double> errors;
  for (const TagOutcome* outcome : outcomes) {
    if (const auto error = error_of(*outcome)) errors.push_back(*error);
  }
  const auto of_tag = statistics(errors);
  if (!of_tag) return fmt::format("{:<{}}  {}\n", tag, width, why_no_errors(outcomes));
  return fmt::format("{:<{}}  {:7} {:10.1f} {:12.1f} {:9.1f} {:9.1f}\n", tag, width, of_tag->count,
                     millimetres(of_tag->mean), millimetres(of_tag->median),
                     millimetres(of_tag->p95), millimetres(of_tag->max));
}

std::string rows_of_many_seeds(const Summary& summary) {
  std::vector<std::string> order;
  std::map<std::string, Outcomes> of_tags;
  for (const TagOutcome& outcome : summary.tags) {
    const auto [entry, is_new] = of_tags.try_emplace(outcome.estimate.tag);
    if (is_new) order.push_back(outcome.estimate.tag);
    entry->second.push_back(&outcome);
  }
  const std::size_t width = name_width(summary);
  std::string text = fmt::format("{:<{}}  {:>7} {:>10} {:>12} {:>9} {:>9}\n", "tag", width, "seeds",
                                 "mean [mm]", "median [mm]", "p95 [mm]", "max [mm]");
  for (std::size_t i = 0; i < std::min(order.size(), kMaxRows); ++i) {
    text += row_of(order[i], of_tags[order[i]], width);
  }
  if (order.size() > kMaxRows) {
    text += fmt::format("… and {} more (summary.json has all)\n", order.size() - kMaxRows);
  }
  return text;
}

std::string statistics_line(const Summary& summary) {
  const auto all = error_statistics(summary);
  if (!all) return "";
  return fmt::format(
      "error: mean {:.1f} mm, median {:.1f}, p95 {:.1f}, max {:.1f}, min {:.1f}; {} over 0.3 m\n",
      millimetres(all->mean), millimetres(all->median), millimetres(all->p95),
      millimetres(all->max), millimetres(all->min), count_over(summary, 0.3));
}

std::string pose_line(const Summary& summary) {
  if (!summary.pose_error) return "";
  std::string text = fmt::format("pose: believed {:.1f} mm (rms) off the true antenna position",
                                 millimetres(summary.pose_error->position_rms_m));
  if (const auto& truth = summary.pose_error->error_with_true_pose_m) {
    text += fmt::format("; with the true pose the same reads give a mean error of {:.1f} mm",
                        millimetres(truth->mean));
  }
  return text + '\n';
}

std::string compared_pose_line(const Summary& summary) {
  if (!summary.compared_pose) return "";
  const ComparedPose& other = *summary.compared_pose;
  std::string text =
      fmt::format("pose: {}; with {}, {:.1f} mm (rms) off it: {} located", summary.pose, other.pose,
                  millimetres(other.position_rms_m), other.located);
  if (other.error_m) {
    text += fmt::format(", error mean {:.1f} mm, max {:.1f}", millimetres(other.error_m->mean),
                        millimetres(other.error_m->max));
  }
  return text + '\n';
}

std::string finding_line(const std::string& name, const std::optional<FindingSummary>& finding) {
  if (!finding) return "";
  std::string text = fmt::format("{}: {} of {} found, {} wrong", name, finding->found,
                                 finding->count, finding->wrong);
  if (finding->seconds && finding->driven_m) {
    text += fmt::format("; after {:.1f} m, {:.1f} s (mean), {:.1f} m, {:.1f} s (most)",
                        finding->driven_m->mean, finding->seconds->mean, finding->driven_m->max,
                        finding->seconds->max);
  }
  return text + '\n';
}

std::string navigation_lines(const Summary& summary) {
  if (!summary.navigation) return "";
  const NavigationSummary& navigation = *summary.navigation;
  std::string text = fmt::format(
      "goals: {} of {} reached, {} collisions, minimum distance to anything {:.0f} mm\n",
      navigation.goals_reached, navigation.goals, navigation.collisions,
      millimetres(navigation.closest_m));
  const auto& unreached = navigation.goals_unreached;
  for (std::size_t i = 0; i < std::min(unreached.size(), kMaxRows); ++i) {
    text += fmt::format("  seed {}, ({:.2f}, {:.2f}) m: {}\n", unreached[i].seed,
                        unreached[i].goal.x(), unreached[i].goal.y(), unreached[i].reason);
  }
  if (unreached.size() > kMaxRows) {
    text += fmt::format("  … and {} more (summary.json has all)\n", unreached.size() - kMaxRows);
  }
  return text + finding_line("unknown starts", navigation.unknown_starts) +
         finding_line("kidnapped", navigation.kidnapped) + finding_line("lost", navigation.lost);
}

/// The method used, if it was not requested by name.
std::string method_line(const Summary& summary) {
  if (summary.method_why.empty()) return "";
  if (summary.method == kNoLocalization)
    return fmt::format("no positions: {}\n", summary.method_why);
  return fmt::format("method: {}, chosen by {}: {}\n", summary.method, summary.method_asked,
                     summary.method_why);
}

std::string error_columns(const std::optional<ErrorStatistics>& errors) {
  if (!errors) return fmt::format(" {:>8} {:>8} {:>8} {:>8}", "-", "-", "-", "-");
  return fmt::format(" {:8.1f} {:8.1f} {:8.1f} {:8.1f}", millimetres(errors->mean),
                     millimetres(errors->median), millimetres(errors->p95),
                     millimetres(errors->max));
}

/// The compared methods; in two lines each if the pose is not the true one.
std::string method_lines(const Summary& summary) {
  if (summary.compared_methods.empty()) return "";
  std::string text = fmt::format("{:<24} {:>12} {:>8} {:>8} {:>8} {:>8}  [mm]\n",
                                 "methods:", "located", "mean", "median", "p95", "max");
  for (const MethodSummary& row : summary.compared_methods) {
    const std::size_t all = row.located + row.ambiguous + row.not_located;
    text += fmt::format("  {:<22} {:>12}{}\n", row.method,
                        fmt::format("{} of {}", row.located, all), error_columns(row.error_m));
    if (!row.aligned_error_m) continue;
    text += fmt::format("    {:<33}{}\n", "after the best rigid alignment",
                        error_columns(row.aligned_error_m));
  }
  return text;
}

std::string effect_line(const std::string& name, const EffectCost& cost) {
  const std::string error = cost.error_m
                                ? fmt::format("{:8.1f} {:8.1f}", millimetres(cost.error_m->mean),
                                              millimetres(cost.error_m->max))
                                : fmt::format("{:>8} {:>8}", "-", "-");
  return fmt::format("  {:<46} {:>4} of {:<4} {} {:>8}\n", name, cost.located, cost.tags, error,
                     cost.reads);
}

std::string effect_name(const EffectCost& cost) {
  switch (cost.set) {
    case EffectSet::kNone:
      return "none";
    case EffectSet::kAlone:
      return cost.effect + " alone";
    case EffectSet::kAllButThis:
      return "all but " + cost.effect;
    case EffectSet::kAll:
      return "all";
  }
  return "";
}

std::string effect_lines(const Summary& summary) {
  if (summary.effects.empty()) return "";
  std::string text = fmt::format("effects: {:<38} located    mean [mm] max [mm]  reads\n", "");
  for (const EffectCost& cost : summary.effects) text += effect_line(effect_name(cost), cost);
  return text;
}

std::string inventory_head(const InventorySummary& inventory) {
  const auto all = static_cast<double>(inventory.tags);
  std::string text = fmt::format(
      "inventory: {:.6g} of {} tags read in {:.1f} s ({}), {:.6g} missed\n", inventory.read,
      inventory.tags, inventory.duration_s, percent_of(inventory.read, all), all - inventory.read);
  text += "read after:";
  for (const ReachedShare& reached : inventory.reached) {
    text += fmt::format("  {:.0f} % {}", 100.0 * reached.share,
                        reached.time_s ? fmt::format("{:.2f} s", *reached.time_s) : "not reached");
  }
  if (inventory.median_reads) text += fmt::format("; reads per tag: {:g}", *inventory.median_reads);
  return text + '\n';
}

std::string zone_lines(const InventorySummary& inventory) {
  if (inventory.zones.empty()) return "";
  std::string text = fmt::format("{:<24} {:>7} {:>8} {:>10} {:>10}\n", "zone", "tags", "read",
                                 "by its own", "by others");
  for (const ZoneInventory& zone : inventory.zones) {
    text += fmt::format("  {:<22} {:>7} {:>8.6g} {:>10.6g} {:>10.6g}\n", zone.zone, zone.tags,
                        zone.read, zone.read_by_own, zone.crossed);
  }
  return text;
}

std::string antenna_lines(const InventorySummary& inventory) {
  std::string text = fmt::format("{:<24} {:<14} {:>8} {:>10} {:>9} {:>9}\n", "antenna", "reader",
                                 "tags", "only by it", "reads", "reads/s");
  const std::size_t shown = std::min(inventory.antennas.size(), kMaxRows);
  for (std::size_t i = 0; i < shown; ++i) {
    const InventoryShare& antenna = inventory.antennas[i];
    text += fmt::format("  {:<22} {:<14} {:>8.6g} {:>10.6g} {:>9.6g} {:>9.1f}\n", antenna.name,
                        antenna.reader, antenna.tags, antenna.only, antenna.reads,
                        inventory.duration_s > 0.0 ? antenna.reads / inventory.duration_s : 0.0);
  }
  if (shown < inventory.antennas.size()) {
    text +=
        fmt::format("  … and {} more (summary.json has all)\n", inventory.antennas.size() - shown);
  }
  return text;
}

std::string without_lines(const InventorySummary& inventory) {
  if (inventory.without.empty()) return "";
  std::string text = fmt::format("{:<24} {:>8} {:>8}\n", "without", "tags", "lost");
  for (const InventoryWithout& without : inventory.without) {
    text += fmt::format("  {:<22} {:>8.6g} {:>8.1f}\n", without.antenna, without.read,
                        inventory.read - without.read + 0.0);
  }
  return text;
}

/// Which tags were read, if none is located.
std::string inventory_lines(const Summary& summary) {
  const std::string why = fmt::format("no positions: {}\n", summary.method_why);
  return inventory_head(*summary.inventory) + zone_lines(*summary.inventory) +
         antenna_lines(*summary.inventory) + without_lines(*summary.inventory) + why;
}

/// How many of the located tags can't be judged though others are; "" if there are none.
std::string unknown_positions(const Summary& summary) {
  const auto is_known = [](const TagOutcome& tag) { return tag.truth_m || tag.moved; };
  if (std::none_of(summary.tags.begin(), summary.tags.end(), is_known)) return "";
  const auto unknown =
      std::count_if(summary.tags.begin(), summary.tags.end(), [&](const TagOutcome& tag) {
        return tag.estimate.verdict == Verdict::kLocated && !tag.reference && !is_known(tag);
      });
  return unknown == 0 ? "" : fmt::format("; the true position of {} located is unknown", unknown);
}

}  // namespace

std::string table_of(const Summary& summary) {
  if (summary.inventory && summary.method == "none") {
    return inventory_lines(summary) + navigation_lines(summary) + effect_lines(summary);
  }
  std::string text = method_line(summary);
  text += summary.seeds.size() > 1 ? rows_of_many_seeds(summary) : rows_of_one_seed(summary);
  text += fmt::format("{} located, {} ambiguous, {} not located", count(summary, Verdict::kLocated),
                      count(summary, Verdict::kAmbiguous), count(summary, Verdict::kNotLocated));
  const std::size_t given = summary.tags.size() - count_to_locate(summary);
  if (given > 0) text += fmt::format(" ({} given)", counted(given, "reference tag"));
  return text + unknown_positions(summary) + '\n' + statistics_line(summary) + pose_line(summary) +
         compared_pose_line(summary) + method_lines(summary) + navigation_lines(summary) +
         effect_lines(summary);
}

}  // namespace tagfield
