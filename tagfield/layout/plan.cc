// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tagfield/base/random.h"
#include "tagfield/layout/internal/hard_link.h"
#include "tagfield/layout/internal/layout_forecast.h"
#include "tagfield/layout/internal/layout_places.h"
#include "tagfield/planning/local_link.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxHard = 20;
constexpr double kHard = 0.9;  ///< From this probability on, a position is not hard to read.
constexpr double kLessPower_db = 2.0;
constexpr double kDetuning_db = 3.0;

const char* key_of(Limit limit) {
  switch (limit) {
    case Limit::kNone:
    case Limit::kSite:
      return "";
    case Limit::kAntennas:
      return "limits.antennas";
    case Limit::kReaders:
      return "limits.readers and limits.ports";
    case Limit::kCost:
      return "limits.cost";
    case Limit::kCross:
      return "limits.cross_reads";
  }
  return "";
}

/// The limit that excludes most of the options that would improve the choice; "" for none.
std::string holding_limit(const SelectionProblem& problem, const OptionSet& choice) {
  const double score = score_of(problem, choice);
  std::map<Limit, std::size_t> kept_out;
  for (std::size_t option = 0; option < problem.options.size(); ++option) {
    if (std::binary_search(choice.begin(), choice.end(), option)) continue;
    OptionSet more = choice;
    more.insert(std::upper_bound(more.begin(), more.end(), option), option);
    const Limit limit = broken_limit(problem, more);
    if (limit == Limit::kNone || limit == Limit::kSite) continue;
    if (score_of(problem, more) > score + 1e-6) ++kept_out[limit];
  }
  std::string key;
  std::size_t most = 0;
  for (const auto& [limit, count] : kept_out) {
    if (count > most) key = key_of(limit);
    most = std::max(most, count);
  }
  return key;
}

[[noreturn]] void fail_without_layout(const ScenarioToPlan& to_plan,
                                      const SelectionProblem& problem) {
  const std::string limit = holding_limit(problem, {});
  const Location location = to_plan.plan.mounts.front().location;
  if (limit.empty()) {
    fail(location,
         "plan: no mount reaches any tag: closer mounts, more power or other tags are needed");
  }
  fail(location, fmt::format("plan: no layout is feasible: plan.{} allows no antenna", limit));
}

/// The best choice found of at most `count` antennas.
OptionSet layout_of(SelectionProblem of_count, const std::vector<std::vector<std::size_t>>& orders,
                    std::size_t count) {
  of_count.limits.antennas = count;
  OptionSet best;
  double most = -1.0;
  for (const std::vector<std::size_t>& order : orders) {
    OptionSet choice(order.begin(),
                     order.begin() + static_cast<std::ptrdiff_t>(std::min(count, order.size())));
    std::sort(choice.begin(), choice.end());
    choice = exchanged(of_count, choice, 4 * static_cast<int>(count));
    const double score = score_of(of_count, choice);
    if (score <= most) continue;
    most = score;
    best = choice;
  }
  return best;
}

PlannedAim planned_aim(const PlanAim& aim) {
  using Kind = PlannedAim::Kind;
  PlannedAim planned{Kind::kReadProbability, aim.read_probability, aim.share};
  if (aim.dwell_reads) planned = {Kind::kReads, *aim.dwell_reads, aim.share};
  if (aim.position_error_m) planned = {Kind::kPosition, *aim.position_error_m, aim.share};
  planned.is_for_least_cost = aim.minimize == PlanAim::Minimize::kCost;
  return planned;
}

}  // namespace

std::vector<PlannedAntenna> antennas_of(const PlanSpec& plan, const LinkMatrix& matrix,
                                        const PlanProblem& problem, const OptionSet& choice) {
  std::map<std::string, std::size_t> of_zone;
  std::vector<PlannedAntenna> antennas;
  for (const std::size_t number : choice) {
    const PlanOption& option = problem.options[number];
    const LinkColumn& column = matrix.columns[option.column];
    const PlanMount& mount = plan.mounts[column.mount];
    PlannedAntenna antenna;
    antenna.name = antenna.mount = mount.name;
    antenna.zone = mount.zone;
    const std::size_t before = of_zone[mount.zone]++;
    antenna.reader = fmt::format("{}_{}", mount.zone.empty() ? "reader" : mount.zone,
                                 before / plan.limits.ports + 1);
    antenna.p_W = mount.X_WA[column.look].translation;
    antenna.boresight_W = mount.X_WA[column.look].rotation * Eigen::Vector3d::UnitX();
    antenna.power_dbm = option.power_dbm;
    antenna.cost = mount.cost;
    antennas.push_back(std::move(antenna));
  }
  return antennas;
}

std::vector<PlanTag> tags_of_sample(const PlanSpec& plan, std::uint64_t seed, std::size_t number) {
  std::vector<PlanTag> tags;
  for (std::size_t group = 0; group < plan.tags.size(); ++group) {
    const PlanTags& of_group = plan.tags[group];
    RandomStream stream(seed, Purpose::kForecast, number, stream_key(of_group.name), group);
    const std::size_t places = of_group.places.size();
    const bool has_all = of_group.count >= places;
    for (std::size_t i = 0; i < of_group.count; ++i) {
      const double drawn = uniform(stream);
      const double turn = uniform(stream);
      PlanTag tag;
      tag.group = group;
      // If there are fewer tags than positions, stratify: divide the positions into equal parts,
      // one for each tag.
      const double at = (static_cast<double>(i) + drawn) * static_cast<double>(places) /
                        static_cast<double>(of_group.count);
      tag.place = has_all ? i % places : std::min(places - 1, static_cast<std::size_t>(at));
      tag.orientation = std::min(
          of_group.orientations.size() - 1,
          static_cast<std::size_t>(turn * static_cast<double>(of_group.orientations.size())));
      tags.push_back(tag);
    }
  }
  return tags;
}

namespace {

class Planner {
 public:
  Planner(const ScenarioToPlan& to_plan, const LinkMatrix& matrix, const PlanRequest& request)
      : to_plan_(to_plan),
        matrix_(matrix),
        request_(request),
        problem_(problem_of(to_plan.plan, matrix)),
        forecast_(to_plan.plan, matrix, problem_, request) {}

  AntennaPlan make() {
    AntennaPlan plan;
    const SelectionProblem& selection = problem_.selection;
    plan.scenario = to_plan_.loaded.scenario.name;
    plan.description = to_plan_.loaded.scenario.description;
    plan.dwell_s = to_plan_.plan.dwell_s;
    plan.options = problem_.options.size();
    plan.aim = planned_aim(to_plan_.plan.aim);
    plan.cross_limit = to_plan_.plan.limits.cross;
    plan.guaranteed = guaranteed_share(selection);
    for (const PlanTags& tags : to_plan_.plan.tags) {
      tags_ += tags.count;
      for (const Eigen::Vector3d& p : tags.places) {
        plan.places.push_back({tags.name, tags.zone, middle_of(tags) + p});
      }
    }
    plan.tags = tags_;
    add_layouts(plan);
    choose(plan);
    add_hard(plan);
    add_sensitivity(plan);
    return plan;
  }

 private:
  static Eigen::Vector3d middle_of(const PlanTags& tags) {
    const std::vector<PlanStop> stops = stops_of(tags, 1.0);
    return stops[stops.size() / 2].p_W;
  }

  void report(double share) const {
    if (request_.stop != nullptr && *request_.stop) throw Error("plan: interrupted");
    if (request_.on_progress) request_.on_progress(share);
  }

  void add_layouts(AntennaPlan& plan) {
    const SelectionProblem& selection = problem_.selection;
    std::vector<std::vector<std::size_t>> orders = {greedy_order(selection)};
    if (std::isfinite(selection.limits.cost)) orders.push_back(greedy_order(selection, true));
    std::size_t most = 0;
    for (const auto& order : orders) most = std::max(most, order.size());
    if (most == 0) fail_without_layout(to_plan_, selection);
    for (std::size_t count = 1; count <= most; ++count) {
      const OptionSet choice = layout_of(selection, orders, count);
      if (!choices_.empty() && choice.size() <= choices_.back().size()) continue;
      choices_.push_back(choice);
      plan.layouts.push_back(layout_with(choice));
      report(0.7 * static_cast<double>(count) / static_cast<double>(most));
    }
  }

  [[nodiscard]] PlannedLayout layout_with(const OptionSet& choice) const {
    PlannedLayout layout;
    SelectionProblem of_count = problem_.selection;
    of_count.limits.antennas = choice.size();
    layout.antennas = antennas_of(to_plan_.plan, matrix_, problem_, choice);
    layout.readers = readers_of(of_count, choice);
    layout.cost = cost_of(of_count, choice);
    layout.score = score_of(of_count, choice);
    layout.bound = upper_bound(of_count, choice);
    forecast_.fill(choice, layout);
    layout.share = of_count.worth == Worth::kProbability
                       ? layout.score
                       : layout.read.mean / static_cast<double>(tags_);
    layout.places = met_by_place(to_plan_.plan, matrix_, problem_, choice);
    if (of_count.worth == Worth::kPlace) {
      layout.errors_m = errors_by_place(to_plan_.plan, matrix_, problem_, choice);
    }
    return layout;
  }

  /// Chooses the smallest layout that is sufficient, or the best. More antennas can be worse, as
  /// the ports of a reader take turns: not by the score, which ignores contention, but by the
  /// forecast.
  void choose(AntennaPlan& plan) {
    plan.chosen = plan.layouts.size() - 1;
    if (problem_.selection.worth != Worth::kProbability) {
      const auto best = std::max_element(
          plan.layouts.begin(), plan.layouts.end(),
          [](const PlannedLayout& a, const PlannedLayout& b) { return a.share < b.share; });
      plan.chosen = static_cast<std::size_t>(best - plan.layouts.begin());
    }
    const auto& share = to_plan_.plan.aim.share;
    for (std::size_t i = 0; share && i < plan.layouts.size(); ++i) {
      if (plan.layouts[i].share < *share) continue;
      plan.chosen = i;
      break;
    }
    const bool is_reached = share && plan.layouts[plan.chosen].share >= *share;
    if (is_reached && to_plan_.plan.aim.minimize == PlanAim::Minimize::kCost) choose_cheapest(plan);
    if (request_.exact_s > 0.0) solve_exactly(plan);
    plan.reaches_aim = !share || plan.layouts[plan.chosen].share >= *share;
    SelectionProblem of_all = problem_.selection;
    plan.stopped_by = holding_limit(of_all, choices_[plan.chosen]);
  }

  /// Chooses the cheapest sufficient layout found: first among the layouts, then with ever lower
  /// cost limits as long as the result is sufficient.
  void choose_cheapest(AntennaPlan& plan) {
    const double share = *to_plan_.plan.aim.share;
    for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
      const PlannedLayout& layout = plan.layouts[i];
      if (layout.share >= share && layout.cost < plan.layouts[plan.chosen].cost) plan.chosen = i;
    }
    constexpr int kMaxSteps = 200;
    constexpr double kLess = 1e-6;
    SelectionProblem cheaper = problem_.selection;
    for (int step = 0; step < kMaxSteps; ++step) {
      cheaper.limits.cost = plan.layouts[plan.chosen].cost * (1.0 - kLess);
      const OptionSet choice = layout_of(
          cheaper, {greedy_order(cheaper), greedy_order(cheaper, true)}, cheaper.limits.antennas);
      if (choice.empty()) return;
      const PlannedLayout layout = layout_with(choice);
      if (layout.share < share || layout.cost >= plan.layouts[plan.chosen].cost) return;
      take(choice, layout, plan);
      report(0.7);
    }
  }

  /// Chooses a layout; it replaces the one with the same number of antennas, or is inserted among
  /// the others.
  void take(const OptionSet& choice, const PlannedLayout& layout, AntennaPlan& plan) {
    const auto after = std::find_if(choices_.begin(), choices_.end(), [&](const OptionSet& other) {
      return other.size() >= choice.size();
    });
    plan.chosen = static_cast<std::size_t>(after - choices_.begin());
    const auto at = plan.layouts.begin() + (after - choices_.begin());
    if (after != choices_.end() && after->size() == choice.size()) {
      *after = choice;
      *at = layout;
      return;
    }
    choices_.insert(after, choice);
    plan.layouts.insert(at, layout);
  }

  void solve_exactly(AntennaPlan& plan) {
    SelectionProblem of_count = problem_.selection;
    of_count.limits.antennas = choices_[plan.chosen].size();
    if (to_plan_.plan.aim.minimize == PlanAim::Minimize::kCost) {
      of_count.limits.cost = plan.layouts[plan.chosen].cost;
    }
    const ExactChoice exact = best_exactly(of_count, choices_[plan.chosen], request_.exact_s);
    const double bound = std::min(exact.bound, plan.layouts[plan.chosen].bound);
    if (exact.choice != choices_[plan.chosen]) take(exact.choice, layout_with(exact.choice), plan);
    plan.layouts[plan.chosen].bound = std::max(bound, plan.layouts[plan.chosen].score);
    plan.layouts[plan.chosen].is_exact = true;
  }

  void add_hard(AntennaPlan& plan) const {
    const PlannedLayout& layout = plan.layouts[plan.chosen];
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < layout.places.size(); ++i) {
      if (layout.places[i] < kHard) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return layout.places[a] < layout.places[b];
    });
    if (order.size() > kMaxHard) order.resize(kMaxHard);
    for (const std::size_t place : order) {
      std::size_t group = 0;
      std::size_t within = place;
      while (within >= to_plan_.plan.tags[group].places.size()) {
        within -= to_plan_.plan.tags[group++].places.size();
      }
      const BestLink link =
          best_link(to_plan_.plan, matrix_, problem_, choices_[plan.chosen], group, within);
      plan.hard.push_back({place, layout.places[place], link.antenna, link.distance_m,
                           link.median_db, why(layout, place, link)});
    }
  }

  [[nodiscard]] std::string why(const PlannedLayout& layout, std::size_t place,
                                const BestLink& link) const {
    if (problem_.selection.worth == Worth::kProbability || link.median_db < 0.0) {
      return why_hard(link);
    }
    if (problem_.selection.worth == Worth::kReads) {
      return fmt::format("readable with {:.1f} dB to spare, but not often enough", link.median_db);
    }
    return std::isfinite(layout.errors_m[place])
               ? fmt::format("located to {:.2f} m at best by the antennas that read it",
                             layout.errors_m[place])
               : "readable by too few antennas, or from one direction";
  }

  void add_sensitivity(AntennaPlan& plan) const {
    const OptionSet& choice = choices_[plan.chosen];
    plan.sensitivity.push_back({"as planned", plan.layouts[plan.chosen].read});
    plan.sensitivity.push_back({fmt::format("{:g} dB less power at all antennas", kLessPower_db),
                                forecast_.read(choice, kLessPower_db)});
    plan.sensitivity.push_back({fmt::format("all tags detuned by {:g} dB", kDetuning_db),
                                forecast_.read(choice, kDetuning_db)});
    for (std::size_t i = 0; i < choice.size() && choice.size() > 1; ++i) {
      OptionSet rest = choice;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      plan.sensitivity.push_back(
          {fmt::format("{} fails", plan.layouts[plan.chosen].antennas[i].name),
           forecast_.read(rest, 0.0)});
      report(0.7 + 0.3 * static_cast<double>(i + 1) / static_cast<double>(choice.size()));
    }
  }

  const ScenarioToPlan& to_plan_;
  const LinkMatrix& matrix_;
  const PlanRequest& request_;
  PlanProblem problem_;
  LayoutForecast forecast_;
  std::vector<OptionSet> choices_;  ///< Of the layouts.
  std::size_t tags_ = 0;
};

}  // namespace

AntennaPlan make_plan(const ScenarioToPlan& to_plan, const LinkMatrix& matrix,
                      const PlanRequest& request) {
  return Planner(to_plan, matrix, request).make();
}

}  // namespace tagfield
