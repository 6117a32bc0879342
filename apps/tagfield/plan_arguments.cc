// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/plan_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/layout/plan.h"
#include "tagfield/layout/plan_check.h"
#include "tagfield/planning/moment.h"

namespace tagfield {
namespace {

/// Progress callback for one stage, if requested.
std::function<void(double share)> stage_progress(const PlanQuestion& question, const char* stage) {
  if (!question.on_progress) return {};
  return [&question, stage](double share) { question.on_progress(stage, share); };
}

LinkMatrix links_of(const ScenarioToPlan& to_plan, const PlanQuestion& question,
                    Diagnostics& diagnostics) {
  LinkMatrixRequest request;
  request.seed = question.seed;
  request.threads = question.threads;
  request.folder = question.links;
  request.stop = question.stop;
  request.on_progress = stage_progress(question, "links");
  request.bodies = standing_bodies(to_plan.loaded.scenario, diagnostics);
  LinkMatrixCounts counts;
  LinkMatrix matrix = evaluate_links(to_plan, request, counts);
  if (counts.damaged > 0) {
    diagnostics.warn(fmt::format("{}: {} files of links were incomplete; they are computed again",
                                 request.folder, counts.damaged));
  }
  return matrix;
}

AntennaPlan layouts_of(const ScenarioToPlan& to_plan, const LinkMatrix& matrix,
                       const PlanQuestion& question) {
  PlanRequest request;
  request.seed = question.seed;
  request.samples = question.samples;
  request.threads = question.threads;
  request.exact_s = question.exact_s;
  request.stop = question.stop;
  request.on_progress = stage_progress(question, "layouts");
  return make_plan(to_plan, matrix, request);
}

std::string limits_text(const PlanSpec& plan) {
  const PlanLimits& limits = plan.limits;
  std::string text = fmt::format("{} antennas, {} readers of {} ports", limits.antennas,
                                 limits.readers, limits.ports);
  if (limits.cost) text += fmt::format(", cost {:g}", *limits.cost);
  if (limits.cross) {
    text += fmt::format(", at most {:g} % of a zone read by others", 100.0 * *limits.cross);
  }
  if (plan.margin_db > 0.0)
    text += fmt::format("; {:g} dB to spare where tags are to be read", plan.margin_db);
  return text;
}

void add_check(const ScenarioToPlan& to_plan, const PlanQuestion& question, AntennaPlan& plan) {
  if (question.check_seeds == 0) return;
  RunControl control;
  control.threads = question.threads;
  control.stop = question.stop;
  control.on_progress = stage_progress(question, "check");
  plan.check =
      check_plan(to_plan, plan.layouts[plan.chosen], question.seed, question.check_seeds, control);
}

/// Also where the aim is no share, or one of all zones together.
void warn_of_empty_zones(const AntennaPlan& plan, Diagnostics& diagnostics) {
  for (const PlannedZone& zone : plan.layouts[plan.chosen].zones) {
    if (zone.tags == 0 || zone.read.high >= 1.0) continue;
    diagnostics.warn(fmt::format("no tag of zone '{}' is read{}", zone.zone,
                                 plan.stopped_by.empty()
                                     ? std::string()
                                     : fmt::format("; plan.{} allows no more", plan.stopped_by)));
  }
}

void warn_of_shortfall(const AntennaPlan& plan, Diagnostics& diagnostics) {
  if (plan.reaches_aim) return;
  diagnostics.warn(fmt::format(
      "plan.aim.share {:g} is not reached: the best layout found has {:.4f}{}", *plan.aim.share,
      plan.layouts[plan.chosen].share,
      plan.stopped_by.empty() ? std::string()
                              : fmt::format("; plan.{} allows no more", plan.stopped_by)));
}

std::string layouts_text(const AntennaPlan& plan) {
  std::string text;
  if (plan.aim.kind != PlannedAim::Kind::kReadProbability) {
    text += fmt::format("tags counted are those {} in {:g} s\n", words_for(plan.aim), plan.dwell_s);
  }
  text +=
      fmt::format("{:>9} {:>8} {:>8} {:>10} {:>16} {:>8} {:>8}\n", "antennas", "readers", "cost",
                  plan.aim.kind == PlannedAim::Kind::kReadProbability ? "tags read" : "tags",
                  "95 % of runs", "score", "bound");
  for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
    const PlannedLayout& layout = plan.layouts[i];
    text += fmt::format(
        "{:>9} {:>8} {:>8g} {:>10.1f} {:>16} {:>8.4f} {:>8.4f}{}{}\n", layout.antennas.size(),
        layout.readers, layout.cost, layout.read.mean,
        fmt::format("{:.0f} to {:.0f}", std::ceil(layout.read.low), std::floor(layout.read.high)),
        layout.score, layout.bound, layout.is_exact ? " exact" : "",
        i == plan.chosen ? "  <- chosen" : "");
  }
  return text;
}

std::string chosen_text(const AntennaPlan& plan) {
  std::string text;
  const PlannedLayout& layout = plan.layouts[plan.chosen];
  for (const PlannedAntenna& antenna : layout.antennas) {
    text += fmt::format(
        "  {:<20} {:<14} at ({:.2f}, {:.2f}, {:.2f}) m, looks along ({:.2f}, {:.2f}, {:.2f}), "
        "{:g} dBm\n",
        antenna.name, antenna.reader, antenna.p_W.x() + 0.0, antenna.p_W.y() + 0.0,
        antenna.p_W.z() + 0.0, antenna.boresight_W.x() + 0.0, antenna.boresight_W.y() + 0.0,
        antenna.boresight_W.z() + 0.0, antenna.power_dbm);
  }
  for (const PlannedZone& zone : layout.zones) {
    text += fmt::format("  zone {}: {:.1f} of {} tags {}, {:.1f} read by others (up to {:.0f})\n",
                        zone.zone, zone.read.mean, zone.tags, words_for(plan.aim), zone.cross.mean,
                        std::floor(zone.cross.high));
  }
  const double gap = std::max(0.0, layout.bound - layout.score);
  text += fmt::format(
      "no layout of {} antennas within the limits scores {}{}\n", layout.antennas.size(),
      gap < 5e-5 ? "more" : fmt::format("over {:.4f}, this one {:.4f}", layout.bound, layout.score),
      plan.guaranteed ? fmt::format("; the greedy algorithm guarantees {:.0f} % of the best",
                                    std::floor(100.0 * *plan.guaranteed))
                      : std::string());
  return text;
}

}  // namespace

void require_exact(const PlanQuestion& question, const PlanSpec& plan) {
  if (question.exact_s <= 0.0) return;
  require_exact_solver(plan.aim.position_error_m ? Worth::kPlace : Worth::kProbability);
}

AntennaPlan plan_antennas(const ScenarioToPlan& to_plan, const PlanQuestion& question,
                          Diagnostics& diagnostics) {
  const LinkMatrix matrix = links_of(to_plan, question, diagnostics);
  AntennaPlan plan = layouts_of(to_plan, matrix, question);
  plan.limits = limits_text(to_plan.plan);
  add_check(to_plan, question, plan);
  warn_of_shortfall(plan, diagnostics);
  warn_of_empty_zones(plan, diagnostics);
  plan.warnings = alike_as_one(diagnostics.warnings());
  return plan;
}

std::string plan_to_text(const AntennaPlan& plan) {
  std::string text = fmt::format("{}: {} tags at {} positions, {} ways to mount an antenna\n",
                                 plan.scenario, plan.tags, plan.places.size(), plan.options);
  text += layouts_text(plan) + chosen_text(plan);
  for (const PlanVariant& variant : plan.sensitivity) {
    text +=
        fmt::format("  {}: {:.1f} tags {}\n", variant.what, variant.read.mean, words_for(plan.aim));
  }
  if (plan.check) {
    text += fmt::format("checked: {} of {} full simulations within the stated range\n",
                        plan.check->inside, plan.check->read.size());
    if (!plan.check->cross.empty()) {
      text += fmt::format("cross reads: {} of {} within the stated range\n",
                          plan.check->cross_inside, plan.check->cross.size());
    }
  }
  return text;
}

}  // namespace tagfield
