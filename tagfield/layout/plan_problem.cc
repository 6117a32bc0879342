// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan_problem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tagfield/planning/local_link.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

/// Where a port's dwell is not told [s], as Gen2Reader has it.
constexpr double kDwell_s = 0.2;
constexpr double kSure = 1e-6;  ///< Misses that are less likely are none.

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
        option.misses = misses(column, most - power + plan_.margin_db, false);
        // Being cautious here is to take links for as good as they are.
        if (plan_.limits.cross) option.crossings = misses(column, most - power, true);
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
    for (const LinkElement& element : elements_) {
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

  /// Of all elements, or only of those of other zones than the mount's.
  [[nodiscard]] std::vector<Miss> misses(std::size_t column, double less_db,
                                         bool only_crossings) const {
    const PlanMount& mount = plan_.mounts[matrix_.columns[column].mount];
    const RadioModel& model = *physical(mount.antenna);
    const double looks = looks_a_second(plan_, model);
    std::vector<Miss> all;
    for (std::size_t number = 0; number < elements_.size(); ++number) {
      const LinkElement& element = elements_[number];
      const PlanTags& group = plan_.tags[matrix_.rows[element.first_row].group];
      if (only_crossings && !is_crossing(mount.zone, group.zone)) continue;
      std::array<double, kFadingPlaces> miss{};
      miss.fill(1.0);
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
  std::vector<LinkElement> elements_;
  mutable std::map<const PlanTags*, std::vector<PlanStop>> stops_;
};

}  // namespace

bool is_crossing(const std::string& readers, const std::string& tags) {
  return !readers.empty() && !tags.empty() && readers != tags;
}

PlanProblem problem_of(const PlanSpec& plan, const LinkMatrix& matrix) {
  return Builder(plan, matrix).build();
}

}  // namespace tagfield
