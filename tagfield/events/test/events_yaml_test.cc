// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/events_yaml.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

constexpr const char* kWhole = R"(events:
  logical_readers:
    - name: gate
      antennas: [north, south]
      min_rssi_dbm: -70
      read_point: urn:epc:id:sgln:0614141.12345.1
      biz_step: receiving
    - {name: belt, readers: [r2]}
  presence: {reads: 3, within_s: 0.5, gone_after_s: 4, include: ["30*"], exclude: [31*]}
  cycles:
    - name: door
      logical_readers: [gate]
      start_s: 1
      stop_s: 60
      duration_s: 2
      repeat_s: 5
      stable_s: 1
      reports:
        - {set: additions, groups: ["urn:epc:pat:sgtin-96:X.*.*.*"], if_empty: true}
        - {set: deletions, name: left, only_on_change: true}
  epcis: {source: reports, time_zone: "-05:00", disposition: in_progress}
)";

std::string write(const std::string& text) { return folder_of_test().with("events.yaml", text); }

/// The error message with `from` replaced by `to`, without the folder.
std::string complaint_of(const std::string& from, const std::string& to) {
  std::string text = kWhole;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  text.replace(text.find(from), from.size(), to);
  const std::string path = write(text);
  try {
    read_events_spec(path);
  } catch (const Error& error) {
    const std::string what = error.what();
    return what.rfind(path, 0) == 0 ? what.substr(path.size() + 1) : what;
  }
  return "no complaint";
}

TEST(ReadEventsSpec, TakesEveryPart) {
  const EventsSpec spec = read_events_spec(write(kWhole));
  ASSERT_EQ(spec.logical_readers.size(), 2U);
  EXPECT_EQ(spec.logical_readers[0].antennas, (std::vector<std::string>{"north", "south"}));
  EXPECT_EQ(spec.logical_readers[0].min_rssi_dbm, -70.0);
  EXPECT_EQ(spec.logical_readers[0].epcis.read_point, "urn:epc:id:sgln:0614141.12345.1");
  EXPECT_EQ(spec.logical_readers[0].epcis.biz_step, "receiving");
  EXPECT_EQ(spec.logical_readers[1].readers, std::vector<std::string>{"r2"});
  EXPECT_EQ(spec.presence.reads, 3U);
  EXPECT_EQ(spec.presence.within, std::chrono::milliseconds(500));
  EXPECT_EQ(spec.presence.gone_after, std::chrono::seconds(4));
  EXPECT_EQ(spec.presence.filter.include.at(0).text, "30*");
  EXPECT_EQ(spec.presence.filter.exclude.at(0).text, "31*");
  ASSERT_EQ(spec.cycles.size(), 1U);
  const CycleSpec& cycle = spec.cycles[0];
  EXPECT_EQ(cycle.start, time_from_seconds(1));
  EXPECT_EQ(cycle.stop, time_from_seconds(60));
  EXPECT_EQ(cycle.duration, std::chrono::seconds(2));
  EXPECT_EQ(cycle.repeat, std::chrono::seconds(5));
  EXPECT_EQ(cycle.stable, std::chrono::seconds(1));
  ASSERT_EQ(cycle.reports.size(), 2U);
  EXPECT_EQ(cycle.reports[0].name, "additions");
  EXPECT_TRUE(cycle.reports[0].if_empty);
  EXPECT_EQ(cycle.reports[0].groups.size(), 1U);
  EXPECT_EQ(cycle.reports[1].name, "left");
  EXPECT_EQ(cycle.reports[1].set, ReportSet::kDeletions);
  EXPECT_TRUE(cycle.reports[1].only_on_change);
  EXPECT_EQ(spec.epcis.source, EpcisSource::kReports);
  EXPECT_EQ(spec.epcis.zone, std::chrono::hours(-5));
  EXPECT_EQ(spec.epcis.otherwise.disposition, "in_progress");
}

TEST(ReadEventsSpec, NeedsNothing) {
  const EventsSpec spec = read_events_spec(write("events: {}\n"));
  EXPECT_TRUE(spec.logical_readers.empty());
  EXPECT_EQ(spec.presence.reads, 1U);
}

TEST(ReadEventsSpec, SaysWhatIsWrongAndWhere) {
  const auto says = [](const char* from, const char* to, const char* expected) {
    const std::string complaint = complaint_of(from, to);
    EXPECT_EQ(complaint.substr(0, std::string(expected).size()), expected);
  };
  says("reads: 3", "raeds: 3", "9: unknown key 'raeds' in events.presence (did you mean 'reads'?)");
  says("reads: 3", "reads: 0", "9: events.presence.reads must be 1 to 1000000");
  says("within_s: 0.5", "within_s: -1", "9: events.presence.within_s must be");
  says("[31*]", "[3*1]", "9: EPC pattern '3*1': must be urn:epc:pat:");
  says("biz_step: receiving", "biz_step: receving",
       "7: events.logical_readers[0].biz_step is 'receving', must be a word of the Core Business "
       "Vocabulary or a URI (did you mean 'receiving'?)");
  says("urn:epc:id:sgln:0614141.12345.1", "the gate",
       "6: events.logical_readers[0].read_point is 'the gate', must be a URI");
  says("readers: [r2]", "biz_step: storing",
       "8: events.logical_readers[1] ('belt') has neither antennas nor readers");
  says("name: belt", "name: gate", "8: events.logical_readers[1] has the name 'gate', as another");
  says("[gate]", "[gaet]", "12: events.cycles[0].logical_readers[0] is 'gaet', which is not known");
  says("repeat_s: 5", "repeat_s: 1", "16: events.cycles[0].repeat_s must be at least duration_s");
  says("stop_s: 60", "stop_s: 0.5", "14: events.cycles[0].stop_s must be later than start_s");
  says("set: additions", "set: addition", "19: events.cycles[0].reports[0].set is 'addition'");
  says("\"-05:00\"", "EST", "21: events.epcis.time_zone 'EST' must be an offset from UTC");
  says("events:", "event:", "1: unknown key 'event' ");
}

TEST(ReadEventsSpec, WantsCyclesThatEndAndReport) {
  const auto complaint = [](const std::string& text) {
    try {
      read_events_spec(write(text));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  EXPECT_NE(complaint("events: {cycles: [{name: c, reports: [{set: current}]}]}")
                .find("('c') needs duration_s or stable_s"),
            std::string::npos);
  EXPECT_NE(complaint("events: {cycles: [{name: c, duration_s: 1}]}").find("('c') has no reports"),
            std::string::npos);
  EXPECT_NE(complaint("events: {epcis: {source: reports}}").find("but there are no cycles"),
            std::string::npos);
}

}  // namespace
}  // namespace tagfield
