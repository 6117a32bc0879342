// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/event_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>

#include "tagfield/events/internal/event_cycle.h"
#include "tagfield/events/internal/presence.h"

namespace tagfield {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Forwards events to several listeners.
class Several final : public EventListener {
 public:
  explicit Several(std::vector<std::shared_ptr<EventListener>> all) : all_(std::move(all)) {}
  void on_presence(const PresenceEvent& event) override {
    for (const auto& one : all_) one->on_presence(event);
  }
  void on_cycle(const CycleReports& reports) override {
    for (const auto& one : all_) one->on_cycle(reports);
  }

 private:
  std::vector<std::shared_ptr<EventListener>> all_;
};

/// The last two updates of an antenna.
struct Updates {
  std::optional<Time> before;
  std::optional<Time> last;
};

}  // namespace

const char* to_string(PresenceChange change) {
  return std::array{"glimpsed", "observed", "gone"}[static_cast<std::size_t>(change)];
}

const char* to_string(ReportSet set) {
  return std::array{"current", "additions", "deletions"}[static_cast<std::size_t>(set)];
}

const char* to_string(CycleEnd end) {
  return std::array{"duration", "stable", "stop", "cut"}[static_cast<std::size_t>(end)];
}

bool takes(const EpcFilter& filter, const EpcToMatch& tag) {
  const auto means = [&tag](const EpcPattern& pattern) { return matches(pattern, tag); };
  return (filter.include.empty() ||
          std::any_of(filter.include.begin(), filter.include.end(), means)) &&
         std::none_of(filter.exclude.begin(), filter.exclude.end(), means);
}

class EventStage::Impl {
 public:
  Impl(EventsSpec spec, std::vector<std::shared_ptr<EventListener>> listeners)
      : spec_(std::move(spec)), listener_(std::move(listeners)) {
    begin();
  }

  void begin() {
    presences_.clear();
    cycles_.clear();
    ways_.clear();
    updates_.clear();
    now_.reset();
    readers_ = spec_.logical_readers;
    for (const LogicalReader& reader : readers_) add_presence(reader);
    for (const CycleSpec& cycle : spec_.cycles) cycles_.emplace_back(cycle);
  }

  void take(TagRead read) {
    // A late read counts as if it were made now.
    const Time now = now_ ? std::max(*now_, read.stamp) : read.stamp;
    read.stamp = now;
    advance(now);
    const std::vector<std::size_t>& places = way_of(read);
    if (places.empty()) return;
    const EpcToMatch& epc = epc_of_tag(read.tag);
    const bool counts = takes(spec_.presence.filter, epc);
    std::vector<bool> is_in_cycle(cycles_.size(), false);
    for (const std::size_t place : places) {
      const LogicalReader& reader = readers_[place];
      if (reader.min_rssi_dbm && read.rssi_dbm < *reader.min_rssi_dbm) continue;
      if (counts) presences_[place].take(read, listener_);
      for (std::size_t i = 0; i < cycles_.size(); ++i) {
        const std::vector<std::string>& of = cycles_[i].spec().logical_readers;
        if (of.empty() || has(of, reader.name)) is_in_cycle[i] = true;
      }
    }
    for (std::size_t i = 0; i < cycles_.size(); ++i) {
      if (is_in_cycle[i]) cycles_[i].take(now, read.tag, epc);
    }
  }

  void update(const std::string& antenna, Time stamp) {
    Updates& updates = updates_[antenna];
    if (updates.last != stamp) updates.before = updates.last;
    updates.last = stamp;
    std::optional<Time> reported_until;
    for (const auto& [name, of] : updates_) {
      if (!of.before) return;
      reported_until = std::min(reported_until.value_or(*of.before), *of.before);
    }
    if (reported_until) advance(*reported_until);
  }

  void remove(const std::string& antenna) { updates_.erase(antenna); }

  void advance(Time now) {
    if (now_ && now < *now_) return;
    if (!now_) {
      for (EventCycle& cycle : cycles_) cycle.advance(now, now, listener_);
    }
    now_ = now;
    while (advance_earliest(now)) {
    }
  }

  void finish(Time end) {
    advance(end);
    for (EventCycle& cycle : cycles_) cycle.finish(end, listener_);
  }

  [[nodiscard]] std::vector<PresenceEvent> present() const {
    std::vector<PresenceEvent> all;
    for (const Presence& presence : presences_) presence.append_present(all);
    std::sort(all.begin(), all.end(), [](const PresenceEvent& a, const PresenceEvent& b) {
      return std::tie(a.logical_reader, a.tag) < std::tie(b.logical_reader, b.tag);
    });
    return all;
  }

  [[nodiscard]] std::vector<std::string> unheard() const {
    std::vector<std::string> names;
    for (const LogicalReader& reader : spec_.logical_readers) {
      for (const std::string& antenna : reader.antennas) {
        if (heard_antennas_.count(antenna) != 0) continue;
        names.push_back(fmt::format("antenna '{}' of logical reader '{}'", antenna, reader.name));
      }
      for (const std::string& physical : reader.readers) {
        if (heard_readers_.count(physical) != 0) continue;
        names.push_back(fmt::format("reader '{}' of logical reader '{}'", physical, reader.name));
      }
    }
    return names;
  }

 private:
  void add_presence(const LogicalReader& reader) {
    presences_.emplace_back(reader.name, spec_.presence);
  }

  /// Advances whatever is due first, if anything is due by `now`. Returns whether it was.
  bool advance_earliest(Time now) {
    Presence* presence = nullptr;
    EventCycle* cycle = nullptr;
    std::optional<Time> first;
    const auto is_first = [&](std::optional<Time> due) {
      if (!due || *due > now || (first && *first <= *due)) return false;
      first = due;
      return true;
    };
    for (Presence& one : presences_) {
      if (is_first(one.due())) presence = &one;
    }
    for (EventCycle& one : cycles_) {
      if (is_first(one.due())) cycle = &one;
    }
    if (!first) return false;
    if (cycle != nullptr) {
      cycle->advance(*first, now, listener_);
    } else {
      presence->advance(*first, listener_);
    }
    return true;
  }

  /// Indices of the logical readers that the read's antenna belongs to.
  const std::vector<std::size_t>& way_of(const TagRead& read) {
    const auto [way, is_new] = ways_.try_emplace({read.reader, read.antenna});
    if (!is_new) return way->second;
    heard_antennas_.insert(read.antenna);
    heard_readers_.insert(read.reader);
    if (spec_.logical_readers.empty()) add_own_reader(read.reader);
    for (std::size_t i = 0; i < readers_.size(); ++i) {
      if (has(readers_[i].antennas, read.antenna) || has(readers_[i].readers, read.reader)) {
        way->second.push_back(i);
      }
    }
    return way->second;
  }

  /// If no logical readers are specified, each reader is one.
  void add_own_reader(const std::string& name) {
    for (const LogicalReader& reader : readers_) {
      if (reader.name == name) return;
    }
    LogicalReader reader;
    reader.name = name;
    reader.readers = {name};
    readers_.push_back(reader);
    add_presence(reader);
  }

  const EpcToMatch& epc_of_tag(const std::string& id) {
    const auto [place, is_new] = epcs_.try_emplace(id);
    if (is_new) place->second = epc_to_match(id);
    return place->second;
  }

  EventsSpec spec_;
  Several listener_;
  std::vector<LogicalReader> readers_;
  std::vector<Presence> presences_;  ///< One for each logical reader.
  std::vector<EventCycle> cycles_;
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> ways_;
  std::unordered_map<std::string, EpcToMatch> epcs_;
  std::map<std::string, Updates> updates_;
  std::set<std::string> heard_antennas_;
  std::set<std::string> heard_readers_;
  std::optional<Time> now_;
};

EventStage::EventStage(EventsSpec spec, std::vector<std::shared_ptr<EventListener>> listeners)
    : impl_(std::make_unique<Impl>(std::move(spec), std::move(listeners))) {}

EventStage::~EventStage() = default;

void EventStage::on_read(const TagRead& read) { impl_->take(read); }

void EventStage::on_update(const AntennaInfo& antenna, Time stamp) {
  impl_->update(antenna.name, stamp);
}

void EventStage::on_antenna_removed(const std::string& name) { impl_->remove(name); }

void EventStage::on_restart() { impl_->begin(); }

void EventStage::advance(Time now) { impl_->advance(now); }

void EventStage::finish(Time end) { impl_->finish(end); }

std::vector<PresenceEvent> EventStage::present() const { return impl_->present(); }

std::vector<std::string> EventStage::unheard() const { return impl_->unheard(); }

}  // namespace tagfield
