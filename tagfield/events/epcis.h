// SPDX-License-Identifier: Apache-2.0
/// @file
/// Events for repositories of GS1's EPC Information Services (EPCIS) 2.0, as JSON-LD.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tagfield/events/event_listener.h"
#include "tagfield/events/events_spec.h"

namespace tagfield {

/// What EPCIS calls a tag: its pure identity where its ID is an EPC of a scheme, else
/// "urn:epc:raw:…" of the bits that it sends (sent_bits()).
std::string epcis_name(const std::string& id);

/// Makes ObjectEvents with action OBSERVE of what it is told: of each tag that is observed, or of
/// each report of current tags or additions; of tags that are gone, or deletions, where there is a
/// gone_biz_step. Reports of no tags make none.
class EpcisEvents final : public EventListener {
 public:
  /// Each event goes to `take` as one JSON object on one line; on its own, with `has_context`, it
  /// has the JSON-LD context. Event time is `start`, since 1970, plus the stamp.
  EpcisEvents(EventsSpec spec, Time start, bool has_context,
              std::function<void(const std::string& event)> take);

  void on_presence(const PresenceEvent& event) override;
  void on_cycle(const CycleReports& reports) override;

 private:
  void tell(Time stamp, const std::vector<std::string>& logical_readers, bool is_gone,
            const std::vector<std::string>& tags) const;
  [[nodiscard]] EpcisContext context_of(const std::vector<std::string>& logical_readers) const;

  EventsSpec spec_;
  Time start_;
  bool has_context_;
  std::function<void(const std::string& event)> take_;
};

/// An EPCISDocument of events without a context each, made at `created` since 1970.
std::string epcis_document(const std::vector<std::string>& events, Time created);

}  // namespace tagfield
