// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/epcis.h"

#include <gtest/gtest.h>

#include "tagfield/base/utc.h"

namespace tagfield {
namespace {

TEST(EpcisName, IsTheIdentityOrTheBits) {
  EXPECT_EQ(epcis_name("3074257BF7194E4000001A85"), "urn:epc:id:sgtin:0614141.812345.6789");
  EXPECT_EQ(epcis_name("urn:epc:tag:sgtin-96:3.0614141.812345.6789"),
            "urn:epc:id:sgtin:0614141.812345.6789");
  EXPECT_EQ(epcis_name("e2801160600002054cc2096f"), "urn:epc:raw:96.xE2801160600002054CC2096F");
  EXPECT_EQ(epcis_name("tag_1"), "urn:epc:raw:96.x7461675F3100000000000000");
  EXPECT_EQ(epcis_name("a longer name"), "urn:epc:raw:112.x61206C6F6E676572206E616D6500");
}

EventsSpec spec_of_a_dock() {
  EventsSpec spec;
  spec.logical_readers.resize(2);
  spec.logical_readers[0].name = "dock";
  spec.logical_readers[0].epcis = {"urn:epc:id:sgln:0614141.12345.1",
                                   "urn:epc:id:sgln:0614141.12345.0", "receiving", "", ""};
  spec.logical_readers[1].name = "belt";
  spec.epcis.otherwise.disposition = "in_progress";
  spec.epcis.zone = std::chrono::minutes(60);
  return spec;
}

PresenceEvent observed() {
  PresenceEvent event;
  event.change = PresenceChange::kObserved;
  event.logical_reader = "dock";
  event.tag = "3074257BF7194E4000001A85";
  event.stamp = time_from_seconds(1.5);
  return event;
}

std::vector<std::string> json_of(const EventsSpec& spec, const PresenceEvent& event,
                                 bool has_context = false) {
  std::vector<std::string> all;
  EpcisEvents events(spec, utc_from_text("2020-01-01"), has_context,
                     [&all](const std::string& json) { all.push_back(json); });
  events.on_presence(event);
  return all;
}

TEST(EpcisEvents, SayWhatWasSeenWhereWhenAndWhy) {
  EXPECT_EQ(
      json_of(spec_of_a_dock(), observed()),
      (std::vector<std::string>{
          R"({"type":"ObjectEvent","action":"OBSERVE",)"
          R"("eventTime":"2020-01-01T01:00:01.500000+01:00","eventTimeZoneOffset":"+01:00",)"
          R"("recordTime":"2020-01-01T00:00:01.500000Z",)"
          R"("epcList":["urn:epc:id:sgtin:0614141.812345.6789"],"bizStep":"receiving",)"
          R"("disposition":"in_progress","readPoint":{"id":"urn:epc:id:sgln:0614141.12345.1"},)"
          R"("bizLocation":{"id":"urn:epc:id:sgln:0614141.12345.0"}})"}));
}

TEST(EpcisEvents, TellOfWhatIsGoneWhereThereIsAStepForIt) {
  EventsSpec spec = spec_of_a_dock();
  PresenceEvent event = observed();
  event.change = PresenceChange::kGone;
  EXPECT_TRUE(json_of(spec, event).empty());
  spec.epcis.otherwise.gone_biz_step = "departing";
  ASSERT_EQ(json_of(spec, event).size(), 1U);
  EXPECT_NE(json_of(spec, event)[0].find(R"("bizStep":"departing")"), std::string::npos);
  event.change = PresenceChange::kGlimpsed;
  EXPECT_TRUE(json_of(spec, event).empty());
}

TEST(EpcisEvents, StandAloneWithTheirContext) {
  const std::string line = json_of(spec_of_a_dock(), observed(), true).at(0);
  EXPECT_TRUE(line.starts_with(R"({"@context":["https://ref.gs1.org/standards/epcis/2.0.0/)"))
      << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(EpcisEvents, AreMadeOfReportsWhereThatIsAskedFor) {
  EventsSpec spec = spec_of_a_dock();
  spec.epcis.source = EpcisSource::kReports;
  EXPECT_TRUE(json_of(spec, observed()).empty());
  std::vector<std::string> all;
  EpcisEvents events(spec, Time{}, false, [&all](const std::string& json) { all.push_back(json); });
  CycleReports reports;
  reports.end = time_from_seconds(2.0);
  reports.logical_readers = {"dock", "belt"};
  // The last two are the same EPC.
  reports.reports = {
      {"all",
       ReportSet::kCurrent,
       {{"", {"tag_1"}}, {"30*", {"3074257BF7194E4000001A85", "3074257bf7194e4000001a85"}}}},
      {"gone", ReportSet::kDeletions, {{"", {"tag_2"}}}},
      {"none", ReportSet::kAdditions, {}}};
  events.on_cycle(reports);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NE(all[0].find(R"("epcList":["urn:epc:id:sgtin:0614141.812345.6789",)"
                        R"("urn:epc:raw:96.x7461675F3100000000000000"])"),
            std::string::npos)
      << all[0];
  EXPECT_EQ(all[0].find("readPoint"), std::string::npos);  // of two locations
}

TEST(EpcisDocument, HoldsAllEvents) {
  EXPECT_EQ(
      epcis_document({"{1}", "{2}"}, utc_from_text("2020-01-01")),
      "{\n\"@context\":[\"https://ref.gs1.org/standards/epcis/2.0.0/epcis-context.jsonld\"],\n"
      "\"type\":\"EPCISDocument\",\n\"schemaVersion\":\"2.0\",\n"
      "\"creationDate\":\"2020-01-01T00:00:00.000000Z\",\n"
      "\"epcisBody\":{\"eventList\":[\n{1},\n{2}\n]}\n}\n");
}

}  // namespace
}  // namespace tagfield
