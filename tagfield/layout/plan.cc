// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "tagfield/base/parallel.h"
#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/layout/internal/layout_forecast.h"
#include "tagfield/planning/local_link.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

/// Where a port's dwell is not told [s], as Gen2Reader has it.
constexpr double kDwell_s = 0.2;
constexpr double kSure = 1e-6;  ///< Misses that are less likely are none.
constexpr std::size_t kMostHard = 20;
constexpr double kHard = 0.9;  ///< From this probability on a place is not hard.
constexpr double kLessPower_db = 2.0;
constexpr double kDetuning_db = 3.0;

/// All rows of one place and orientation, one a stop.
struct Element {
  std::size_t first_row = 0;
  std::size_t stops = 1;
};

/// In the order of the rows.
std::vector<Element> elements_of(const LinkMatrix& matrix) {
  std::vector<Element> elements;
  for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
    if (matrix.rows[row].stop == 0) {
      elements.push_back({row, 1});
    } else {
      ++elements.back().stops;
    }
  }
  return elements;
}

/// Probability that none of `looks` looks on different carriers hears a tag that is heard on
/// `share` of `carriers`.
double miss_of(double share, double looks, std::size_t carriers) {
  if (looks < 1.0) return 1.0 - looks * share;
  const auto all = static_cast<double>(carriers);
  double miss = 1.0;
  for (double look = 0.0; look < std::min(std::floor(looks), all); look += 1.0) {
    miss *= std::max(0.0, 1.0 - share * all / (all - look));
  }
  return miss;
}

/// How often an antenna has its turn in a second.
double looks_a_second(const PlanSpec& plan, const RadioModel& model) {
  const double dwell_s = model.gen2 ? model.gen2->port_dwell_s : kDwell_s;
  return 1.0 / (dwell_s * static_cast<double>(std::min(plan.limits.ports, plan.limits.antennas)));
}

class Builder {
 public:
  Builder(const PlanSpec& plan, const LinkMatrix& matrix)
      : plan_(plan), matrix_(matrix), elements_(elements_of(matrix)) {}

  PlanProblem build() {
    PlanProblem problem;
    add_elements(problem);
    for (std::size_t column = 0; column < matrix_.columns.size(); ++column) {
      const PlanMount& mount = plan_.mounts[matrix_.columns[column].mount];
      const double most = *std::max_element(mount.power_dbm.begin(), mount.power_dbm.end());
      for (const double power : mount.power_dbm) {
        problem.options.push_back({column, power, most - power});
        SelectionOption option;
        option.site = matrix_.columns[column].mount;
        option.zone = mount.zone.empty() ? kNoZone : zone_number(mount.zone, problem);
        option.cost = mount.cost;
        const auto all = [](std::size_t /*zone*/) { return true; };
        const auto foreign = [&](std::size_t zone) {
          return zone != kNoZone && option.zone != kNoZone && zone != option.zone;
        };
        option.misses = misses(column, most - power + plan_.margin_db, problem.selection, all);
        // Being cautious here is to take links for as good as they are.
        if (plan_.limits.cross) {
          option.crossings = misses(column, most - power, problem.selection, foreign);
        }
        problem.selection.options.push_back(std::move(option));
      }
    }
    problem.selection.zones = problem.zones.size();
    set_limits(problem.selection);
    return problem;
  }

 private:
  static std::size_t zone_number(const std::string& name, PlanProblem& problem) {
    const auto known = std::find(problem.zones.begin(), problem.zones.end(), name);
    const auto number = static_cast<std::size_t>(known - problem.zones.begin());
    if (known == problem.zones.end()) problem.zones.push_back(name);
    return number;
  }

  void add_elements(PlanProblem& problem) {
    double tags = 0.0;
    for (const PlanTags& group : plan_.tags) tags += static_cast<double>(group.count);
    for (const Element& element : elements_) {
      const PlanTags& group = plan_.tags[matrix_.rows[element.first_row].group];
      const auto ways = static_cast<double>(group.places.size() * group.orientations.size());
      SelectionElement one;
      one.weight =
          static_cast<double>(group.count) / ways / (tags * static_cast<double>(kFadingPlaces));
      if (!group.zone.empty()) one.zone = zone_number(group.zone, problem);
      for (std::size_t place = 0; place < kFadingPlaces; ++place) {
        problem.selection.elements.push_back(one);
      }
    }
  }

  /// Of elements in zones for which `counts` holds.
  [[nodiscard]] std::vector<Miss> misses(std::size_t column, double less_db,
                                         const SelectionProblem& selection,
                                         const std::function<bool(std::size_t)>& counts) const {
    const PlanMount& mount = plan_.mounts[matrix_.columns[column].mount];
    const RadioModel& model = *physical(mount.antenna);
    const double looks = looks_a_second(plan_, model);
    std::vector<Miss> all;
    for (std::size_t number = 0; number < elements_.size(); ++number) {
      if (!counts(selection.elements[number * kFadingPlaces].zone)) continue;
      std::array<double, kFadingPlaces> miss{};
      miss.fill(1.0);
      const Element& element = elements_[number];
      const PlanTags& group = plan_.tags[matrix_.rows[element.first_row].group];
      const std::vector<PlanStop>& stops =
          stops_.try_emplace(&group, stops_of(group, plan_.dwell_s)).first->second;
      for (std::size_t stop = 0; stop < element.stops; ++stop) {
        const LinkStates states = matrix_.states(column, element.first_row + stop);
        if (states.is_empty()) continue;
        const double time_s = stops[stop].end_s - stops[stop].begin_s;
        for (std::size_t place = 0; place < kFadingPlaces; ++place) {
          miss[place] *=
              miss_of(states.share_heard(place, less_db), looks * time_s, hopped_channels(model));
        }
      }
      for (std::size_t place = 0; place < kFadingPlaces; ++place) {
        if (miss[place] > 1.0 - kSure) continue;
        all.push_back({static_cast<std::uint32_t>(number * kFadingPlaces + place),
                       static_cast<float>(miss[place] < kSure ? 0.0 : miss[place])});
      }
    }
    return all;
  }

  void set_limits(SelectionProblem& selection) const {
    const PlanLimits& limits = plan_.limits;
    selection.limits.antennas = std::min(limits.antennas, plan_.mounts.size());
    selection.limits.readers = limits.readers;
    selection.limits.ports = limits.ports;
    selection.limits.reader_cost = limits.reader_cost;
    if (limits.cost) selection.limits.cost = *limits.cost;
    if (limits.cross) selection.limits.cross = *limits.cross;
    selection.cap = plan_.aim.read_probability;
  }

  const PlanSpec& plan_;
  const LinkMatrix& matrix_;
  std::vector<Element> elements_;
  mutable std::map<const PlanTags*, std::vector<PlanStop>> stops_;
};

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

/// The limit that keeps most of the options out that would add something to the choice; "" for
/// none.
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
         "plan: no mount reaches any tag: nearer mounts, more power or other tags are needed");
  }
  fail(location, fmt::format("plan: no layout is feasible: plan.{} lets no antenna in", limit));
}

/// The best found of `count` antennas at most.
OptionSet layout_of(const PlanProblem& problem, const std::vector<std::vector<std::size_t>>& orders,
                    std::size_t count) {
  SelectionProblem of_count = problem.selection;
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

std::vector<double> place_probabilities(const PlanSpec& plan, const LinkMatrix& matrix,
                                        const PlanProblem& problem, const OptionSet& choice) {
  std::vector<double> miss(problem.selection.elements.size(), 1.0);
  for (const std::size_t option : choice) {
    for (const Miss& one : problem.selection.options[option].misses) {
      miss[one.element] *= static_cast<double>(one.probability);
    }
  }
  std::vector<std::size_t> first_place(plan.tags.size(), 0);
  std::size_t places = 0;
  for (std::size_t group = 0; group < plan.tags.size(); ++group) {
    first_place[group] = places;
    places += plan.tags[group].places.size();
  }
  std::vector<double> probability(places, 0.0);
  const std::vector<Element> elements = elements_of(matrix);
  for (std::size_t number = 0; number < elements.size(); ++number) {
    const LinkRow& row = matrix.rows[elements[number].first_row];
    const auto ways = static_cast<double>(plan.tags[row.group].orientations.size() * kFadingPlaces);
    for (std::size_t fade = 0; fade < kFadingPlaces; ++fade) {
      probability[first_place[row.group] + row.place] +=
          (1.0 - miss[number * kFadingPlaces + fade]) / ways;
    }
  }
  return probability;
}

/// Margins of the best link of a place, by antenna, over orientations and fading.
struct BestLink {
  std::string antenna;
  double distance_m = 0.0;
  double median_db = -400.0;
  double worst_turn_db = 0.0;  ///< The median in the worst orientation,
  double best_turn_db = 0.0;   ///< and in the best.
  bool arrives = false;
};

double median_margin_of(std::vector<double> values) {
  if (values.empty()) return kNothing_db;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

BestLink best_link(const PlanSpec& plan, const LinkMatrix& matrix, const PlanProblem& problem,
                   const OptionSet& choice, std::size_t group, std::size_t place) {
  BestLink best;
  for (const std::size_t number : choice) {
    const PlanOption& option = problem.options[number];
    const LinkColumn& column = matrix.columns[option.column];
    std::vector<double> all;
    std::map<std::size_t, std::vector<double>> by_turn;
    double nearest_m = 1e9;
    for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
      const LinkRow& of_row = matrix.rows[row];
      if (of_row.group != group || of_row.place != place) continue;
      const RigidTransform& X_WA = plan.mounts[column.mount].X_WA[column.look];
      nearest_m = std::min(nearest_m, (of_row.X_WT.translation - X_WA.translation).norm());
      const LinkStates states = matrix.states(option.column, row);
      for (std::size_t fade = 0; fade < kFadingPlaces; ++fade) {
        for (std::size_t carrier = 0; carrier < std::max<std::size_t>(states.carriers(), 1);
             ++carrier) {
          const double margin =
              states.is_empty() ? -32.0
                                : states.margin_db(fade, carrier) - option.less_db - plan.margin_db;
          all.push_back(std::max(margin, -32.0));
          by_turn[of_row.orientation].push_back(all.back());
        }
      }
    }
    const double median = median_margin_of(all);
    if (median <= best.median_db) continue;
    best = {plan.mounts[column.mount].name, nearest_m, median, 100.0, -100.0, median > -32.0};
    for (auto& [turn, margins] : by_turn) {
      const double of_turn = median_margin_of(margins);
      best.worst_turn_db = std::min(best.worst_turn_db, of_turn);
      best.best_turn_db = std::max(best.best_turn_db, of_turn);
    }
  }
  return best;
}

std::string why_hard(const BestLink& link) {
  if (!link.arrives) {
    return "nothing of any antenna arrives there: something opaque stands between";
  }
  if (link.worst_turn_db < 0.0 && link.best_turn_db >= 0.0) {
    return fmt::format("turned away: {:+.0f} dB as it lies best, {:+.0f} dB as it lies worst",
                       link.best_turn_db, link.worst_turn_db);
  }
  if (link.median_db < 0.0) {
    return fmt::format("too weak by {:.1f} dB in the median", -link.median_db);
  }
  return fmt::format("fading: {:.1f} dB to spare in the median, which notches take",
                     link.median_db);
}

}  // namespace

PlanProblem problem_of(const PlanSpec& plan, const LinkMatrix& matrix) {
  return Builder(plan, matrix).build();
}

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
      // Fewer tags than places are anywhere, one in each of as many equal parts of the places.
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
    plan.aim = to_plan_.plan.aim.read_probability;
    plan.aim_share = to_plan_.plan.aim.share;
    plan.cross_limit = to_plan_.plan.limits.cross;
    plan.guaranteed = guaranteed_share(selection);
    for (const PlanTags& tags : to_plan_.plan.tags) {
      plan.tags += tags.count;
      for (const Eigen::Vector3d& p : tags.places) {
        plan.places.push_back({tags.name, tags.zone, middle_of(tags) + p});
      }
    }
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

  void told(double share) const {
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
      const OptionSet choice = layout_of(problem_, orders, count);
      if (!choices_.empty() && choice.size() <= choices_.back().size()) continue;
      add_layout(choice, plan);
      told(0.7 * static_cast<double>(count) / static_cast<double>(most));
    }
  }

  void add_layout(const OptionSet& choice, AntennaPlan& plan) {
    PlannedLayout layout;
    SelectionProblem of_count = problem_.selection;
    of_count.limits.antennas = choice.size();
    layout.antennas = antennas_of(to_plan_.plan, matrix_, problem_, choice);
    layout.readers = readers_of(of_count, choice);
    layout.cost = cost_of(of_count, choice);
    layout.score = score_of(of_count, choice);
    layout.bound = upper_bound(of_count, choice);
    forecast_.fill(choice, layout);
    layout.places = place_probabilities(to_plan_.plan, matrix_, problem_, choice);
    choices_.push_back(choice);
    plan.layouts.push_back(std::move(layout));
  }

  /// The smallest that is enough, or the best.
  void choose(AntennaPlan& plan) {
    plan.chosen = plan.layouts.size() - 1;
    const auto& share = to_plan_.plan.aim.share;
    for (std::size_t i = 0; share && i < plan.layouts.size(); ++i) {
      if (plan.layouts[i].score < *share) continue;
      plan.chosen = i;
      break;
    }
    if (request_.exact_s > 0.0) solve_exactly(plan);
    plan.reaches_aim = !share || plan.layouts[plan.chosen].score >= *share;
    SelectionProblem of_all = problem_.selection;
    plan.stopped_by = holding_limit(of_all, choices_[plan.chosen]);
  }

  void solve_exactly(AntennaPlan& plan) {
    SelectionProblem of_count = problem_.selection;
    of_count.limits.antennas = choices_[plan.chosen].size();
    const ExactChoice exact = best_exactly(of_count, choices_[plan.chosen], request_.exact_s);
    const double bound = std::min(exact.bound, plan.layouts[plan.chosen].bound);
    if (exact.choice != choices_[plan.chosen]) {
      AntennaPlan scratch;
      std::vector<OptionSet> before = std::move(choices_);
      choices_.clear();
      add_layout(exact.choice, scratch);
      before[plan.chosen] = exact.choice;
      choices_ = std::move(before);
      plan.layouts[plan.chosen] = std::move(scratch.layouts.front());
    }
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
    if (order.size() > kMostHard) order.resize(kMostHard);
    for (const std::size_t place : order) {
      std::size_t group = 0;
      std::size_t within = place;
      while (within >= to_plan_.plan.tags[group].places.size()) {
        within -= to_plan_.plan.tags[group++].places.size();
      }
      const BestLink link =
          best_link(to_plan_.plan, matrix_, problem_, choices_[plan.chosen], group, within);
      plan.hard.push_back({place, layout.places[place], link.antenna, link.distance_m,
                           link.median_db, why_hard(link)});
    }
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
      told(0.7 + 0.3 * static_cast<double>(i + 1) / static_cast<double>(choice.size()));
    }
  }

  const ScenarioToPlan& to_plan_;
  const LinkMatrix& matrix_;
  const PlanRequest& request_;
  PlanProblem problem_;
  LayoutForecast forecast_;
  std::vector<OptionSet> choices_;  ///< Of the layouts.
};

}  // namespace

AntennaPlan make_plan(const ScenarioToPlan& to_plan, const LinkMatrix& matrix,
                      const PlanRequest& request) {
  return Planner(to_plan, matrix, request).make();
}

}  // namespace tagfield
