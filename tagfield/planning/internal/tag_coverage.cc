// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/internal/tag_coverage.h"

#include <algorithm>

#include "tagfield/base/parallel.h"
#include "tagfield/base/units.h"
#include "tagfield/planning/forecast.h"
#include "tagfield/planning/internal/antenna_place.h"
#include "tagfield/planning/moment.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

/// A link that is valid from one sample on.
struct TimedLink {
  Time begin;
  LinkStates states;
  double update_probability = 0.0;
};

/// Results for one tag at one antenna.
struct Seen {
  CoverageCell cell;
  double nearest_m = -1.0;
  std::vector<TimedLink> links;  ///< In chronological order.
};

class TagRun {
 public:
  TagRun(const Scenario& scenario, const std::vector<DriveSample>& samples,
         const CoverageRequest& request)
      : scenario_(scenario),
        samples_(samples),
        request_(request),
        world_(radio_world_of(scenario)) {
    for (std::size_t tag = 0; tag < scenario.tags.size(); ++tag) {
      moving_.push_back(moves_in(samples, tag) ? 1 : 0);
    }
  }

  /// Evaluates all tags at the request's antenna `number`.
  std::vector<Seen> look(std::size_t number) const {
    const std::size_t antenna = request_.antennas[number];
    std::vector<Seen> seen(scenario_.tags.size());
    const std::vector<std::size_t> places = places_of(samples_, antenna);
    std::size_t next = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      throw_if_stopped(request_);
      const bool is_place = next < places.size() && places[next] == i;
      if (is_place) ++next;
      look_at(i, antenna, static_cast<int>(number), is_place, places.size() > 1, seen);
    }
    return seen;
  }

 private:
  /// Evaluates the moving tags, and, at a new pose of the antenna, also those at rest.
  void look_at(std::size_t sample, std::size_t antenna, int number, bool is_place,
               bool antenna_moves, std::vector<Seen>& seen) const {
    std::vector<std::size_t> due;
    for (std::size_t tag = 0; tag < seen.size(); ++tag) {
      if (moving_[tag] == 0 && !is_place) continue;
      // With both at rest, time does not matter.
      const bool any_time = !antenna_moves && moving_[tag] == 0;
      const bool is_there = absence_of(scenario_.tags[tag], samples_[sample].stamp).empty();
      if (any_time || is_there) due.push_back(tag);
    }
    if (due.empty()) return;
    const RigidTransform& X_WA = samples_[sample].X_WA[antenna];
    const AntennaAtPose place(scenario_, scenario_.antennas[antenna], *world_, X_WA,
                              request_.bodies, request_.seed);
    parallel_for(due.size(), request_.threads, [&](std::size_t i) {
      look_at_tag(place, X_WA, sample, due[i], number, seen[due[i]]);
    });
  }

  void look_at_tag(const AntennaAtPose& place, const RigidTransform& X_WA, std::size_t sample,
                   std::size_t tag, int number, Seen& seen) const {
    thread_local std::vector<RadioPath> paths;
    const RigidTransform& X_WT = samples_[sample].X_WT[tag];
    const auto kind = scenario_.tags[tag].model ? scenario_.tags[tag].model : default_tag_model();
    const double distance_m = (X_WT.translation - X_WA.translation).norm();
    if (seen.nearest_m < 0.0 || distance_m < seen.nearest_m) seen.nearest_m = distance_m;
    const TagEnd end{*kind, X_WT, stream_key(scenario_.tags[tag].id)};
    const CoverageCell cell = place.look(end, {{X_WT.rotation}, false}, paths);
    merge(cell, number, seen.cell);
    seen.links.push_back({samples_[sample].stamp, place.states(end, paths), cell.probability});
  }

  const Scenario& scenario_;
  const std::vector<DriveSample>& samples_;
  const CoverageRequest& request_;
  std::shared_ptr<const RadioWorld> world_;
  std::vector<char> moving_;
};

void add(const Seen& seen, int antenna, TagCoverage& tag) {
  if (seen.nearest_m >= 0.0 && (tag.nearest < 0 || seen.nearest_m < tag.nearest_m)) {
    tag.nearest = antenna;
    tag.nearest_m = seen.nearest_m;
  }
  merge(seen.cell, antenna, tag.best);
}

/// All links of the tags and the ports that may read them, as input of the forecast.
class RunForecast {
 public:
  RunForecast(const Scenario& scenario, const std::vector<DriveSample>& samples,
              const CoverageRequest& request)
      : scenario_(scenario),
        groups_(reader_groups(scenario)),
        best_db_(scenario.tags.size(), kNothing_db) {
    for (const std::size_t antenna : request.antennas) {
      request_.ports.push_back({scenario.antennas[antenna].parameters, groups_[antenna]});
      groups_of_ports_.push_back(groups_[antenna]);
    }
    const double last_s = to_seconds(samples.back().stamp);
    request_.duration_s = std::max(scenario.duration_s.value_or(last_s), 1e-3);
    request_.seed = request.seed;
    request_.threads = request.threads;
    request_.tags.resize(scenario.tags.size());
  }

  /// Keeps pointers into `seen` until run().
  void add(std::size_t port, const std::vector<Seen>& seen) {
    for (std::size_t tag = 0; tag < seen.size(); ++tag) {
      const std::vector<TimedLink>& links = seen[tag].links;
      for (std::size_t i = 0; i < links.size(); ++i) {
        best_db_[tag] = std::max(best_db_[tag], links[i].states.best_db());
        add_link(port, links, i, scenario_.tags[tag], request_.tags[tag]);
      }
    }
  }

  void run(Coverage& coverage) const {
    const Forecast made = forecast(request_);
    coverage.run_s = request_.duration_s;
    coverage.expected_read = {made.tags_read.mean, made.tags_read.low, made.tags_read.high};
    for (std::size_t tag = 0; tag < coverage.tags.size(); ++tag) {
      TagCoverage& of_tag = coverage.tags[tag];
      of_tag.probability = made.probability[tag];
      const ZoneSpec* const zone = zone_of(of_tag);
      of_tag.meant_for = meant_for(of_tag, zone);
      add_readers(made, tag, zone != nullptr, of_tag);
      of_tag.verdict = verdict_of(of_tag, best_db_[tag]);
    }
  }

 private:
  void add_link(std::size_t port, const std::vector<TimedLink>& links, std::size_t i,
                const TagSpec& spec, ForecastTag& tag) const {
    const TimedLink& link = links[i];
    const bool is_paper = physical(request_.ports[port].antenna) == nullptr;
    ForecastLink forecast_link;
    forecast_link.port = port;
    // Before the first sample and after the last, the poses of that sample hold.
    forecast_link.begin_s = i == 0 ? 0.0 : to_seconds(link.begin);
    if (i + 1 < links.size()) forecast_link.end_s = to_seconds(links[i + 1].begin);
    forecast_link.begin_s = std::max(forecast_link.begin_s, to_seconds(spec.appears));
    if (spec.disappears) {
      forecast_link.end_s = std::min(forecast_link.end_s, to_seconds(*spec.disappears));
    }
    if (is_paper) {
      forecast_link.update_probability = link.update_probability;
      if (link.update_probability > 0.0) tag.links.push_back(forecast_link);
    } else if (!link.states.is_empty()) {
      forecast_link.states = &link.states;
      tag.links.push_back(forecast_link);
    }
  }

  /// Null outside all zones.
  [[nodiscard]] const ZoneSpec* zone_of(const TagCoverage& tag) const {
    const std::size_t zone = zone_at(scenario_.zones, tag.p_WT);
    return zone < scenario_.zones.size() ? &scenario_.zones[zone] : nullptr;
  }

  [[nodiscard]] std::vector<std::string> meant_for(const TagCoverage& tag,
                                                   const ZoneSpec* zone) const {
    if (zone != nullptr) return zone->readers;
    if (!scenario_.zones.empty() || tag.nearest < 0) return {};
    return {groups_of_ports_[static_cast<std::size_t>(tag.nearest)]};
  }

  /// A tag in a zone without readers is meant for none, one outside all zones for any.
  static void add_readers(const Forecast& made, std::size_t tag, bool is_in_zone,
                          TagCoverage& of_tag) {
    for (std::size_t group = 0; group < made.groups.size(); ++group) {
      double read = 0.0;
      for (const auto& sample : made.read_by_group) read += sample[group][tag] != 0 ? 1.0 : 0.0;
      if (read == 0.0) continue;
      const std::string& name = made.groups[group];
      const auto& meant = of_tag.meant_for;
      const bool is_meant = (meant.empty() && !is_in_zone) ||
                            std::find(meant.begin(), meant.end(), name) != meant.end();
      of_tag.readers.push_back(
          {name, read / static_cast<double>(made.read_by_group.size()), is_meant});
    }
    std::stable_sort(
        of_tag.readers.begin(), of_tag.readers.end(),
        [](const ReaderChance& a, const ReaderChance& b) { return a.probability > b.probability; });
  }

  const Scenario& scenario_;
  std::vector<std::string> groups_;
  std::vector<std::string> groups_of_ports_;
  std::vector<double> best_db_;
  ForecastRequest request_;
};

}  // namespace

TagVerdict verdict_of(const TagCoverage& tag, double best_db) {
  if (tag.probability == 0.0 && tag.best.probability == 0.0 && best_db < kNeverMargin_db) {
    return TagVerdict::kNever;
  }
  if (tag.probability < kReadProbability) return TagVerdict::kSeldom;
  double own = 0.0;
  bool is_crossed = false;
  for (const ReaderChance& chance : tag.readers) {
    if (chance.is_meant) own = std::max(own, chance.probability);
    is_crossed = is_crossed || (!chance.is_meant && chance.probability >= kCrossProbability);
  }
  if (own < kReadProbability) return TagVerdict::kWrong;
  return is_crossed ? TagVerdict::kAlsoOther : TagVerdict::kIntended;
}

/// Where tag `number` is when it appears, or at the first sample if that is later. For a tag on a
/// robot or moved in steps, to the distance between samples.
Eigen::Vector3d first_position(const std::vector<DriveSample>& samples, const TagSpec& tag,
                               std::size_t number) {
  if (tag.appears > samples.front().stamp && tag.on.empty() && !tag.in_steps) {
    return held_position_at(tag.motion, tag.appears);
  }
  const auto after =
      std::find_if(samples.begin() + 1, samples.end(),
                   [&](const DriveSample& sample) { return sample.stamp > tag.appears; });
  return (after - 1)->X_WT[number].translation;
}

void cover_tags(const Scenario& scenario, const std::vector<DriveSample>& samples,
                const CoverageRequest& request, Coverage& coverage,
                const std::function<void(double share)>& on_progress) {
  const TagRun run(scenario, samples, request);
  coverage.tags.resize(scenario.tags.size());
  for (std::size_t i = 0; i < scenario.tags.size(); ++i) {
    coverage.tags[i].id = scenario.tags[i].id;
    coverage.tags[i].p_WT = first_position(samples, scenario.tags[i], i);
  }
  RunForecast of_run(scenario, samples, request);
  std::vector<std::vector<Seen>> all;
  all.reserve(request.antennas.size());
  for (std::size_t number = 0; number < request.antennas.size(); ++number) {
    const std::vector<Seen>& seen = all.emplace_back(run.look(number));
    of_run.add(number, seen);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      add(seen[i], static_cast<int>(number), coverage.tags[i]);
    }
    on_progress(static_cast<double>(number + 1) / static_cast<double>(request.antennas.size()));
  }
  of_run.run(coverage);
}

}  // namespace tagfield
