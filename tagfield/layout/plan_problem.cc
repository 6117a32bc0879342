// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan_problem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tagfield/layout/internal/link_reads.h"
#include "tagfield/planning/local_link.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

constexpr double kSure = 1e-6;  ///< Miss probabilities below this count as zero.

/// Probability that none of `looks` tries on different carriers hears a tag that is heard on the
/// fraction `share` of `carriers`.
double miss_of(double share, double looks, std::size_t carriers) {
  if (looks < 1.0) return 1.0 - looks * share;
  const auto all = static_cast<double>(carriers);
  double miss = 1.0;
  for (double look = 0.0; look < std::min(std::floor(looks), all); look += 1.0) {
    miss *= std::max(0.0, 1.0 - share * all / (all - look));
  }
  return miss;
}

/// Number of ports that take turns if all ports of a reader are in use.
std::size_t ports_in_turn(const PlanSpec& plan) {
  return std::min(plan.limits.ports, plan.limits.antennas);
}

/// Turns of an antenna per second.
double looks_a_second(const PlanSpec& plan, const RadioModel& model) {
  return 1.0 / (port_dwell_s(model) * static_cast<double>(ports_in_turn(plan)));
}

/// Standard deviation of the positions along one axis [m]; more than the target error.
double spread_of(const PlanSpec& plan) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double squares = 0.0;
  double count = 0.0;
  for (const PlanTags& group : plan.tags) {
    for (const Eigen::Vector3d& place : group.places) {
      sum += place.head<2>();
      squares += place.head<2>().squaredNorm();
      count += 1.0;
    }
  }
  const double variance = squares / count - (sum / count).squaredNorm();
  return std::max(std::sqrt(std::max(variance, 0.0) / 2.0), 2.0 * *plan.aim.position_error_m);
}

class Builder {
 public:
  Builder(const PlanSpec& plan, const LinkMatrix& matrix)
      : plan_(plan),
        matrix_(matrix),
        elements_(elements_of(matrix)),
        reads_a_turn_(ports_in_turn(plan)) {}

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
        // Here the cautious choice is to use links without the margin.
        if (plan_.limits.cross) option.crossings = misses(column, most - power, true);
        if (plan_.aim.dwell_reads || plan_.aim.position_error_m) {
          add_reads(column, most - power + plan_.margin_db, option);
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
    for (const LinkElement& element : elements_) {
      const PlanTags& group = plan_.tags[matrix_.rows[element.first_row].group];
      const auto ways = static_cast<double>(group.places.size() * group.orientations.size());
      SelectionElement one;
      one.weight =
          static_cast<double>(group.count) / ways / (tags * static_cast<double>(kFadingPositions));
      if (!group.zone.empty()) one.zone = zone_number(group.zone, problem);
      for (std::size_t place = 0; place < kFadingPositions; ++place) {
        problem.selection.elements.push_back(one);
      }
    }
  }

  /// Misses of all elements, or only of those in zones other than the mount's.
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
      std::array<double, kFadingPositions> miss{};
      miss.fill(1.0);
      const std::vector<PlanStop>& stops = stops_at(group);
      for (std::size_t stop = 0; stop < element.stops; ++stop) {
        const LinkStates states = matrix_.states(column, element.first_row + stop);
        if (states.is_empty()) continue;
        const double time_s = stops[stop].end_s - stops[stop].begin_s;
        for (std::size_t place = 0; place < kFadingPositions; ++place) {
          miss[place] *=
              miss_of(states.share_heard(place, less_db), looks * time_s, hopped_channels(model));
        }
      }
      for (std::size_t place = 0; place < kFadingPositions; ++place) {
        if (miss[place] > 1.0 - kSure) continue;
        all.push_back({static_cast<std::uint32_t>(number * kFadingPositions + place),
                       static_cast<float>(miss[place] < kSure ? 0.0 : miss[place])});
      }
    }
    return all;
  }

  /// Mean number of tags heard at a time.
  [[nodiscard]] double tags_heard(std::size_t column, double less_db) const {
    double heard = 0.0;
    for (const LinkElement& element : elements_) {
      const PlanTags& group = plan_.tags[matrix_.rows[element.first_row].group];
      const auto ways = static_cast<double>(group.places.size() * group.orientations.size());
      double share = 0.0;
      for (std::size_t stop = 0; stop < element.stops; ++stop) {
        share =
            std::max(share, matrix_.states(column, element.first_row + stop).share_heard(less_db));
      }
      heard += share * static_cast<double>(group.count) / ways;
    }
    return heard;
  }

  /// Adds the reads, or their information about the position, by element and fading position.
  void add_reads(std::size_t column, double less_db, SelectionOption& option) {
    const LinkColumn& of_column = matrix_.columns[column];
    const PlanMount& mount = plan_.mounts[of_column.mount];
    const RadioModel& model = *physical(mount.antenna);
    const double looks = looks_a_second(plan_, model);
    const double a_second =
        looks * reads_a_turn_.of(model, mount.antenna.rate_hz, tags_heard(column, less_db));
    // The lesser of the number of its turns and the number of hops in that time.
    const double visited =
        std::min(looks * plan_.dwell_s, std::floor(plan_.dwell_s / model.plan.dwell_s) + 1.0);
    for (std::size_t number = 0; number < elements_.size(); ++number) {
      const LinkElement& element = elements_[number];
      const std::vector<PlanStop>& stops =
          stops_at(plan_.tags[matrix_.rows[element.first_row].group]);
      std::array<double, kFadingPositions> reads{};
      for (std::size_t stop = 0; stop < element.stops; ++stop) {
        const LinkStates states = matrix_.states(column, element.first_row + stop);
        if (states.is_empty()) continue;
        const double time_s = stops[stop].end_s - stops[stop].begin_s;
        for (std::size_t place = 0; place < kFadingPositions; ++place) {
          reads[place] += a_second * time_s * states.share_heard(place, less_db);
        }
      }
      const Eigen::Vector3d p_WA = mount.X_WA[of_column.look].translation;
      const Eigen::Vector3d p_WT = matrix_.rows[element.first_row].X_WT.translation;
      const RangeInformation range =
          plan_.aim.position_error_m
              ? range_information(model, matrix_.states(column, element.first_row), less_db,
                                  (p_WT - p_WA).norm())
              : RangeInformation{};
      for (std::size_t place = 0; place < kFadingPositions; ++place) {
        if (reads[place] < kSure) continue;
        const auto at = static_cast<std::uint32_t>(number * kFadingPositions + place);
        if (plan_.aim.dwell_reads) {
          option.reads.push_back({at, static_cast<float>(reads[place])});
        } else {
          const double spread = expected_spread(model, reads[place], visited);
          option.information.push_back(
              position_information(range, reads[place], spread, p_WA, p_WT));
          option.information.back().element = at;
        }
      }
    }
  }

  const std::vector<PlanStop>& stops_at(const PlanTags& group) const {
    return stops_.try_emplace(&group, stops_of(group, plan_.dwell_s)).first->second;
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
    if (plan_.aim.dwell_reads) {
      selection.worth = Worth::kReads;
      selection.cap = *plan_.aim.dwell_reads;
    } else if (plan_.aim.position_error_m) {
      selection.worth = Worth::kPlace;
      selection.error_m = *plan_.aim.position_error_m;
      selection.spread_m = spread_of(plan_);
    }
  }

  const PlanSpec& plan_;
  const LinkMatrix& matrix_;
  std::vector<LinkElement> elements_;
  mutable std::map<const PlanTags*, std::vector<PlanStop>> stops_;
  ReadsATurn reads_a_turn_;
};

}  // namespace

bool is_crossing(const std::string& readers, const std::string& tags) {
  return !readers.empty() && !tags.empty() && readers != tags;
}

PlanProblem problem_of(const PlanSpec& plan, const LinkMatrix& matrix) {
  return Builder(plan, matrix).build();
}

}  // namespace tagfield
