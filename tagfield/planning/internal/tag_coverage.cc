#include "tagfield/planning/internal/tag_coverage.h"

#include <algorithm>

#include "tagfield/base/parallel.h"
#include "tagfield/planning/internal/antenna_place.h"
#include "tagfield/planning/moment.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

/// Of one tag at one antenna.
struct Seen {
  CoverageCell cell;
  double nearest_m = -1.0;
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

  /// All tags at the request's antenna `number`.
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
  /// Those that moved, and in a new place of the antenna those at rest too.
  void look_at(std::size_t sample, std::size_t antenna, int number, bool is_place,
               bool antenna_moves, std::vector<Seen>& seen) const {
    std::vector<std::size_t> due;
    for (std::size_t tag = 0; tag < seen.size(); ++tag) {
      if (moving_[tag] == 0 && !is_place) continue;
      // At rest both, it does not matter when.
      const bool any_time = !antenna_moves && moving_[tag] == 0;
      const bool is_there = absence_of(scenario_.tags[tag], samples_[sample].stamp).empty();
      if (any_time || is_there) due.push_back(tag);
    }
    if (due.empty()) return;
    const RigidTransform& X_WA = samples_[sample].X_WA[antenna];
    const AntennaPlace place(scenario_, scenario_.antennas[antenna], *world_, X_WA, request_.seed);
    parallel_for(due.size(), request_.threads, [&](std::size_t i) {
      look_at_tag(place, X_WA, sample, due[i], number, seen[due[i]]);
    });
  }

  void look_at_tag(const AntennaPlace& place, const RigidTransform& X_WA, std::size_t sample,
                   std::size_t tag, int number, Seen& seen) const {
    thread_local std::vector<RadioPath> paths;
    const RigidTransform& X_WT = samples_[sample].X_WT[tag];
    const auto kind = scenario_.tags[tag].model ? scenario_.tags[tag].model : default_tag_model();
    const double distance_m = (X_WT.translation - X_WA.translation).norm();
    if (seen.nearest_m < 0.0 || distance_m < seen.nearest_m) seen.nearest_m = distance_m;
    const TagEnd end{*kind, X_WT, stream_key(scenario_.tags[tag].id)};
    merge(place.look(end, {{X_WT.rotation}, false}, paths), number, seen.cell);
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
  if (seen.cell.probability >= kReadProbability) tag.read_by.push_back(antenna);
  merge(seen.cell, antenna, tag.best);
}

}  // namespace

TagVerdict verdict_of(const std::vector<int>& read_by, int nearest) {
  if (read_by.empty()) return TagVerdict::kNever;
  const bool is_own = std::find(read_by.begin(), read_by.end(), nearest) != read_by.end();
  if (!is_own) return TagVerdict::kWrong;
  return read_by.size() == 1 ? TagVerdict::kIntended : TagVerdict::kAlsoOther;
}

void cover_tags(const Scenario& scenario, const std::vector<DriveSample>& samples,
                const CoverageRequest& request, Coverage& coverage,
                const std::function<void(double share)>& on_progress) {
  const TagRun run(scenario, samples, request);
  coverage.tags.resize(scenario.tags.size());
  for (std::size_t i = 0; i < scenario.tags.size(); ++i) {
    coverage.tags[i].id = scenario.tags[i].id;
    coverage.tags[i].p_WT = samples.front().X_WT[i].translation;
  }
  for (std::size_t number = 0; number < request.antennas.size(); ++number) {
    const std::vector<Seen> seen = run.look(number);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      add(seen[i], static_cast<int>(number), coverage.tags[i]);
    }
    on_progress(static_cast<double>(number + 1) / static_cast<double>(request.antennas.size()));
  }
  for (TagCoverage& tag : coverage.tags) tag.verdict = verdict_of(tag.read_by, tag.nearest);
}

}  // namespace tagfield
