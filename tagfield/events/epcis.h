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

/// The name of a tag in EPCIS: the pure identity URI if its ID is an EPC of a known scheme,
/// otherwise "urn:epc:raw:…" with the bits that it sends (sent_bits()).
std::string epcis_name(const std::string& id);

/// Makes ObjectEvents with action OBSERVE from its input: for each observed tag, or for each report
/// of current tags or additions; for tags that are gone, or deletions, if there is a gone_biz_step.
/// Reports without tags make no events.
class EpcisEvents final : public EventListener {
 public:
  /// Each event is passed to `take` as one JSON object on one line, with the JSON-LD context if
  /// `has_context` (for events outside a document). Event time is `start`, since 1970, plus the
  /// timestamp.
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

/// An EPCISDocument of events that have no context of their own, created at `created` since 1970.
std::string epcis_document(const std::vector<std::string>& events, Time created);

}  // namespace tagfield
