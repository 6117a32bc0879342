// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/event_json.h"

#include <gtest/gtest.h>

#include "tagfield/base/utc.h"

namespace tagfield {
namespace {

TEST(EventJson, TellsPresence) {
  PresenceEvent event;
  event.change = PresenceChange::kGone;
  event.logical_reader = "dock \"3\"";
  event.tag = "3074257BF7194E4000001A85";
  event.antenna = "left";
  event.stamp = time_from_seconds(4.0);
  event.first_read = time_from_seconds(1.5);
  event.last_read = time_from_seconds(2.0);
  event.reads = 3;
  event.max_rssi_dbm = -51.239;
  EXPECT_EQ(to_json_line(event, utc_from_text("2020-01-01")),
            R"({"eventType":"gone","timestamp":"2020-01-01T00:00:04.000000000Z",)"
            R"("logicalReader":"dock \"3\"","epc":"3074257BF7194E4000001A85",)"
            R"("epcUri":"urn:epc:id:sgtin:0614141.812345.6789","antennaName":"left",)"
            R"("firstRead":"2020-01-01T00:00:01.500000000Z",)"
            R"("lastRead":"2020-01-01T00:00:02.000000000Z","reads":3,"peakRssiCdbm":-5124})"
            "\n");
}

TEST(EventJson, TellsCycles) {
  CycleReports reports;
  reports.cycle = "door";
  reports.number = 7;
  reports.end = time_from_seconds(2.0);
  reports.logical_readers = {"a", "b"};
  reports.reports = {{"new", ReportSet::kAdditions, {{"", {"t1", "t2"}}, {"30*", {"30AB"}}}},
                     {"all", ReportSet::kCurrent, {}}};
  EXPECT_EQ(
      to_json_line(reports, Time{}),
      R"({"eventType":"cycle","cycle":"door","number":7,)"
      R"("begin":"1970-01-01T00:00:00.000000000Z","end":"1970-01-01T00:00:02.000000000Z",)"
      R"("endedBy":"duration","logicalReaders":["a","b"],"reports":[)"
      R"({"name":"new","set":"additions","count":3,"groups":[)"
      R"({"name":null,"count":2,"epcs":["t1","t2"]},{"name":"30*","count":1,"epcs":["30AB"]}]},)"
      R"({"name":"all","set":"current","count":0,"groups":[]}]})"
      "\n");
}

}  // namespace
}  // namespace tagfield
