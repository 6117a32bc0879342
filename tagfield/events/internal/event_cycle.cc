// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/internal/event_cycle.h"

#include <algorithm>

namespace tagfield {
namespace {

using Tags = std::map<std::string, EpcToMatch>;

/// The `tags` that are not among `others`.
Tags without(const Tags& tags, const Tags& others) {
  Tags rest;
  for (const auto& tag : tags) {
    if (others.count(tag.first) == 0) rest.insert(tag);
  }
  return rest;
}

bool has_same_ids(const Tags& a, const Tags& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [](const auto& one, const auto& other) { return one.first == other.first; });
}

std::vector<ReportGroup> grouped(const Tags& tags, const std::vector<EpcPattern>& patterns) {
  std::map<std::string, std::vector<std::string>> by_name;
  for (const auto& [id, tag] : tags) {
    const auto pattern =
        std::find_if(patterns.begin(), patterns.end(),
                     [&epc = tag](const EpcPattern& of) { return matches(of, epc); });
    by_name[pattern == patterns.end() ? "" : group_of(*pattern, tag)].push_back(id);
  }
  std::vector<ReportGroup> groups;
  groups.reserve(by_name.size());
  for (auto& [name, ids] : by_name) groups.push_back({name, std::move(ids)});
  return groups;
}

}  // namespace

EventCycle::EventCycle(const CycleSpec& spec) : spec_(spec), before_(spec.reports.size()) {}

std::optional<Duration> EventCycle::period() const {
  return spec_.repeat ? spec_.repeat : spec_.duration;
}

std::pair<Time, CycleEnd> EventCycle::end_due() const {
  std::pair<Time, CycleEnd> due{Time::max(), CycleEnd::kDuration};
  if (spec_.duration) due.first = begin_ + *spec_.duration;
  if (spec_.stable && newest_ + *spec_.stable < due.first) {
    due = {newest_ + *spec_.stable, CycleEnd::kStable};
  }
  if (spec_.stop && *spec_.stop < due.first) due = {*spec_.stop, CycleEnd::kStop};
  return due;
}

std::optional<Time> EventCycle::due() const {
  if (goes_on_) return end_due().first;
  return next_;
}

void EventCycle::begin_at_first(Time now) {
  is_first_ = false;
  next_ = spec_.start;
  if (now <= spec_.start) return;
  if (!period()) {
    next_ = now;
    return;
  }
  const auto passed = (now - spec_.start) / *period();
  number_ = static_cast<std::size_t>(passed);
  next_ = spec_.start + passed * *period();
}

void EventCycle::begin(Time at) {
  next_.reset();
  if (spec_.stop && at >= *spec_.stop) return;
  goes_on_ = true;
  begin_ = newest_ = at;
  ++number_;
}

/// If only cycles with nothing to report lie ahead, counts them without iterating over them.
void EventCycle::skip_idle(Time horizon) {
  const bool tells_empty = std::any_of(spec_.reports.begin(), spec_.reports.end(),
                                       [](const ReportSpec& report) { return report.if_empty; });
  const bool is_idle = tags_.empty() && std::all_of(before_.begin(), before_.end(),
                                                    [](const Tags& tags) { return tags.empty(); });
  if (tells_empty || !is_idle || !goes_on_) return;
  const Duration each = period() ? *period() : *spec_.stable;
  const Time last = spec_.stop ? std::min(horizon, *spec_.stop - Duration(1)) : horizon;
  if (last <= begin_) return;
  const auto passed = (last - begin_) / each;
  begin_ += passed * each;
  newest_ = begin_;
  number_ += static_cast<std::size_t>(passed);
}

void EventCycle::advance(Time now, Time horizon, EventListener& listener) {
  if (is_first_) begin_at_first(now);
  for (;;) {
    skip_idle(horizon);
    const std::optional<Time> next = due();
    if (!next || *next > now) return;
    if (goes_on_) {
      end(*next, end_due().second, listener);
    } else {
      begin(*next);
    }
  }
}

void EventCycle::take(Time stamp, const std::string& id, const EpcToMatch& tag) {
  if (!goes_on_ || tags_.count(id) != 0) return;
  const bool is_wanted =
      std::any_of(spec_.reports.begin(), spec_.reports.end(),
                  [&tag](const ReportSpec& report) { return takes(report.filter, tag); });
  if (!is_wanted) return;
  tags_.emplace(id, tag);
  newest_ = stamp;
}

void EventCycle::finish(Time now, EventListener& listener) {
  if (goes_on_ && now > begin_) end(now, CycleEnd::kCut, listener);
}

std::optional<CycleReport> EventCycle::report(std::size_t index) {
  const ReportSpec& spec = spec_.reports[index];
  Tags current;
  for (const auto& tag : tags_) {
    if (takes(spec.filter, tag.second)) current.insert(tag);
  }
  Tags& before = before_[index];
  const bool is_changed = !has_same_ids(current, before);
  Tags reported = current;
  if (spec.set == ReportSet::kAdditions) reported = without(current, before);
  if (spec.set == ReportSet::kDeletions) reported = without(before, current);
  before = std::move(current);
  if ((reported.empty() && !spec.if_empty) || (spec.only_on_change && !is_changed))
    return std::nullopt;
  return CycleReport{spec.name, spec.set, grouped(reported, spec.groups)};
}

void EventCycle::end(Time at, CycleEnd why, EventListener& listener) {
  CycleReports all{spec_.name, number_, begin_, at, why, spec_.logical_readers, {}};
  for (std::size_t i = 0; i < spec_.reports.size(); ++i) {
    // Tags that the rest of the cycle might have read are not known to be missing.
    if (why == CycleEnd::kCut && spec_.reports[i].set == ReportSet::kDeletions) continue;
    std::optional<CycleReport> one = report(i);
    if (one) all.reports.push_back(std::move(*one));
  }
  goes_on_ = false;
  tags_.clear();
  // After an early end, the next cycle waits for its period, or, without a period, begins
  // immediately.
  next_ = period() ? begin_ + *period() : at;
  if (!all.reports.empty()) listener.on_cycle(all);
}

}  // namespace tagfield
