// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/event_stage.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tagfield/events/test/event_log.h"

namespace tagfield {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Lines = std::vector<std::string>;

std::shared_ptr<EventLog> log_of(const EventsSpec& spec, const std::vector<TagRead>& reads,
                                 double end_s) {
  auto log = std::make_shared<EventLog>();
  EventStage stage(spec, {log});
  for (const TagRead& read : reads) stage.on_read(read);
  stage.finish(time_from_seconds(end_s));
  return log;
}

EventsSpec presence_spec(std::size_t reads, Duration within, Duration gone_after) {
  EventsSpec spec;
  spec.presence.reads = reads;
  spec.presence.within = within;
  spec.presence.gone_after = gone_after;
  return spec;
}

TEST(EventStage, ObservesAfterSoManyReadsAndMissesAfterATimeWithoutAny) {
  const auto log = log_of(presence_spec(3, seconds(1), seconds(2)),
                          {read_of(0.5, "t"), read_of(0.9, "t"), read_of(1.6, "t"),
                           read_of(1.8, "t"), read_of(3.0, "t")},
                          10.0);
  // At 1.6 the read at 0.5 is too long ago.
  EXPECT_EQ(log->presence, (Lines{"0.5 glimpsed t at r", "1.8 observed t at r", "5 gone t at r"}));
  const PresenceEvent& gone = log->events.back();
  EXPECT_EQ(gone.first_read, time_from_seconds(0.5));
  EXPECT_EQ(gone.last_read, time_from_seconds(3.0));
  EXPECT_EQ(gone.reads, 5U);
}

TEST(EventStage, KnowsWhoIsThere) {
  EventStage stage(presence_spec(2, seconds(1), seconds(2)), {});
  for (const auto& read : {read_of(0.1, "u"), read_of(0.2, "t"), read_of(0.3, "t"),
                           read_of(0.4, "u"), read_of(0.5, "v"), read_of(0.6, "u")}) {
    stage.on_read(read);
  }
  const std::vector<PresenceEvent> present = stage.present();
  ASSERT_EQ(present.size(), 2U);
  EXPECT_EQ(present[0].tag, "t");
  EXPECT_EQ(present[1].tag, "u");
  EXPECT_EQ(present[1].reads, 3U);
  stage.advance(time_from_seconds(2.3));
  EXPECT_EQ(stage.present().size(), 1U);
}

TEST(EventStage, WhatWasOnlyGlimpsedIsForgottenInSilence) {
  const auto log = log_of(presence_spec(2, seconds(1), seconds(1)),
                          {read_of(1.0, "t"), read_of(2.0, "t"), read_of(2.9, "t")}, 3.0);
  // At 2.0, a second without reads is just over.
  EXPECT_EQ(log->presence,
            (Lines{"1 glimpsed t at r", "2 glimpsed t at r", "2.9 observed t at r"}));
}

TEST(EventStage, GroupsAntennasIntoLogicalReaders) {
  EventsSpec spec = presence_spec(1, seconds(1), seconds(9));
  spec.logical_readers.resize(2);
  spec.logical_readers[0] = {"gate", {"a", "b"}, {}, {}, {}};
  spec.logical_readers[1] = {"all", {"missing"}, {"r", "other"}, -60.0, {}};
  auto log = std::make_shared<EventLog>();
  EventStage stage(spec, {log});
  stage.on_read(read_of(1.0, "t", "a", -70.0));
  stage.on_read(read_of(2.0, "t", "c", -55.0));
  stage.on_read(read_of(3.0, "t", "b", -50.0));
  EXPECT_EQ(log->presence, (Lines{"1 glimpsed t at gate", "1 observed t at gate",
                                  "2 glimpsed t at all", "2 observed t at all"}));
  EXPECT_EQ(stage.unheard(), (Lines{"antenna 'missing' of logical reader 'all'",
                                    "reader 'other' of logical reader 'all'"}));
}

CycleSpec door() {
  CycleSpec cycle;
  cycle.name = "door";
  cycle.duration = seconds(2);
  return cycle;
}

ReportSpec report(ReportSet set) {
  ReportSpec report;
  report.set = set;
  report.name = to_string(set);
  return report;
}

EventsSpec with(const CycleSpec& cycle) {
  EventsSpec spec;
  spec.cycles = {cycle};
  return spec;
}

const std::vector<TagRead>& some_reads() {
  static const std::vector<TagRead> reads = {
      read_of(0.5, "x"), read_of(0.6, "y"), read_of(1.9, "x"), read_of(2.0, "y"),
      read_of(3.0, "z"), read_of(7.0, "z"), read_of(8.5, "x")};
  return reads;
}

TEST(EventStage, ReportsWhatIsThereWhatIsNewAndWhatIsGone) {
  CycleSpec cycle = door();
  cycle.reports = {report(ReportSet::kCurrent), report(ReportSet::kAdditions),
                   report(ReportSet::kDeletions)};
  EXPECT_EQ(log_of(with(cycle), some_reads(), 9.0)->cycles,
            (Lines{"door#1 0-2 duration: current[=x,y] additions[=x,y]",
                   "door#2 2-4 duration: current[=y,z] additions[=z] deletions[=x]",
                   "door#3 4-6 duration: deletions[=y,z]",
                   "door#4 6-8 duration: current[=z] additions[=z]",
                   "door#5 8-9 cut: current[=x] additions[=x]"}));
}

TEST(EventStage, RepeatsCyclesWithPausesAndStops) {
  CycleSpec cycle = door();
  cycle.start = time_from_seconds(0.55);
  cycle.repeat = seconds(3);
  cycle.stop = time_from_seconds(8.0);
  cycle.reports = {report(ReportSet::kCurrent)};
  cycle.reports[0].if_empty = true;
  EXPECT_EQ(log_of(with(cycle), some_reads(), 20.0)->cycles,
            (Lines{"door#1 0.55-2.55 duration: current[=x,y]", "door#2 3.55-5.55 duration: current",
                   "door#3 6.55-8 stop: current[=z]"}));
}

TEST(EventStage, EndsACycleOnceNoNewTagComes) {
  CycleSpec cycle = door();
  cycle.duration = {};
  cycle.stable = seconds(1);
  cycle.reports = {report(ReportSet::kCurrent)};
  EXPECT_EQ(log_of(with(cycle), some_reads(), 9.0)->cycles,
            (Lines{"door#1 0.5-1.6 stable: current[=x,y]", "door#2 1.6-3 stable: current[=x,y]",
                   "door#3 3-4 stable: current[=z]", "door#7 7-8 stable: current[=z]",
                   "door#8 8-9 cut: current[=x]"}));
}

TEST(EventStage, TellsOnlyWhatChanges) {
  CycleSpec cycle = door();
  cycle.duration = seconds(1);
  cycle.reports = {report(ReportSet::kCurrent)};
  cycle.reports[0].only_on_change = true;
  const auto log =
      log_of(with(cycle), {read_of(0.1, "x"), read_of(1.1, "x"), read_of(2.1, "y")}, 3);
  EXPECT_EQ(log->cycles,
            (Lines{"door#1 0-1 duration: current[=x]", "door#3 2-3 duration: current[=y]"}));
}

TEST(EventStage, FiltersAndGroupsByPattern) {
  const std::string first = "3074257BF7194E4000001A85";  // SGTIN 0614141.812345, from the standard.
  const std::string second = "urn:epc:tag:sgtin-96:1.0614141.100001.7";
  CycleSpec cycle = door();
  cycle.reports = {report(ReportSet::kCurrent)};
  cycle.reports[0].filter.exclude = {parse_epc_pattern("E280*")};
  cycle.reports[0].groups = {parse_epc_pattern("urn:epc:pat:sgtin-96:X.0614141.*.*")};
  const std::vector<TagRead> reads = {read_of(0.1, first), read_of(0.2, second),
                                      read_of(0.3, "pallet"),
                                      read_of(0.4, "E2801160600002054CC2096F")};
  EXPECT_EQ(log_of(with(cycle), reads, 2.0)->cycles, (Lines{"door#1 0-2 duration: current[=pallet]"
                                                            "[urn:epc:pat:sgtin-96:1.0614141.*.*=" +
                                                            second +
                                                            "]"
                                                            "[urn:epc:pat:sgtin-96:3.0614141.*.*=" +
                                                            first + "]"}));
  cycle.reports[0].filter.include = {parse_epc_pattern("30*")};
  cycle.reports[0].groups = {};
  EXPECT_EQ(log_of(with(cycle), reads, 2.0)->cycles,
            (Lines{"door#1 0-2 duration: current[=" + first + "," + second + "]"}));
}

TEST(EventStage, CountsIdleCyclesWithoutGoingThroughThem) {
  CycleSpec cycle = door();
  cycle.duration = milliseconds(1);
  cycle.reports = {report(ReportSet::kAdditions), report(ReportSet::kDeletions)};
  // 1.7e12 cycles, as with Unix timestamps.
  const auto log =
      log_of(with(cycle), {read_of(0.0002, "x"), read_of(1'700'000'000.5002, "y")}, 1'700'000'001);
  ASSERT_EQ(log->cycles.size(), 4U);
  EXPECT_EQ(log->cycles[0], "door#1 0-0.001 duration: additions[=x]");
  EXPECT_EQ(log->cycles[1], "door#2 0.001-0.002 duration: deletions[=x]");
  EXPECT_TRUE(log->cycles[2].starts_with("door#1700000000501 ")) << log->cycles[2];
  EXPECT_TRUE(log->cycles[3].starts_with("door#1700000000502 ")) << log->cycles[3];
}

AntennaInfo antenna(const std::string& name) {
  AntennaInfo info;
  info.name = name;
  return info;
}

TEST(EventStage, KnowsTimeByUpdatesWhereNothingIsRead) {
  auto log = std::make_shared<EventLog>();
  EventStage stage(presence_spec(1, seconds(1), seconds(1)), {log});
  stage.on_read(read_of(0.1, "t"));
  for (const double s : {0.5, 1.0, 1.5}) {
    stage.on_update(antenna("a"), time_from_seconds(s));
    stage.on_update(antenna("b"), time_from_seconds(s + 0.01));
  }
  EXPECT_EQ(log->presence.size(), 2U);
  stage.on_update(antenna("a"), time_from_seconds(2.0));
  EXPECT_EQ(log->presence.size(), 2U);  // b's reads after 1.01 may still follow
  stage.on_antenna_removed("b");
  stage.on_update(antenna("a"), time_from_seconds(2.5));
  EXPECT_EQ(log->presence.back(), "1.1 gone t at r");
}

TEST(EventStage, ForgetsAllWhereTimeGoesBack) {
  auto log = std::make_shared<EventLog>();
  EventStage stage(presence_spec(1, seconds(1), seconds(1)), {log});
  stage.on_read(read_of(50.0, "t"));
  stage.on_restart();
  stage.on_read(read_of(0.5, "t"));
  stage.advance(time_from_seconds(3.0));
  EXPECT_EQ(log->presence, (Lines{"50 glimpsed t at r", "50 observed t at r", "0.5 glimpsed t at r",
                                  "0.5 observed t at r", "1.5 gone t at r"}));
}

/// Reads of four tags at multiples of 0.1 s, sorted by timestamp.
std::vector<TagRead> random_reads() {
  std::vector<TagRead> reads;
  for (int i = *rc::gen::inRange(0, 60); i > 0; --i) {
    reads.push_back(read_of(0.1 * *rc::gen::inRange(0, 200),
                            std::string(1, static_cast<char>('p' + *rc::gen::inRange(0, 4)))));
  }
  std::stable_sort(reads.begin(), reads.end(),
                   [](const TagRead& a, const TagRead& b) { return a.stamp < b.stamp; });
  return reads;
}

/// Reference: presence events from one tag's timestamps, computed for each run of reads as a whole.
Lines naive_presence(const std::string& tag, const std::vector<Time>& stamps,
                     const PresenceRule& rule, Time end) {
  Lines lines;
  const auto add = [&](Time stamp, const char* what) {
    lines.push_back(fmt::format("{:g} {} {} at r", to_seconds(stamp), what, tag));
  };
  for (std::size_t first = 0, next = 0; first < stamps.size(); first = next) {
    next = first + 1;
    while (next < stamps.size() && stamps[next] - stamps[next - 1] < rule.gone_after) ++next;
    add(stamps[first], "glimpsed");
    bool is_observed = false;
    for (std::size_t last = first + rule.reads - 1; last < next && !is_observed; ++last) {
      is_observed = stamps[last] - stamps[last + 1 - rule.reads] <= rule.within;
      if (is_observed) add(stamps[last], "observed");
    }
    const Time gone = stamps[next - 1] + rule.gone_after;
    if (is_observed && gone <= end) add(gone, "gone");
  }
  return lines;
}

RC_GTEST_PROP(EventStage, TellsPresenceAsALookAtAllReadsDoes, ()) {
  const std::vector<TagRead> reads = random_reads();
  const EventsSpec spec = presence_spec(*rc::gen::inRange<std::size_t>(1, 4),
                                        milliseconds(100 * *rc::gen::inRange(1, 20)),
                                        milliseconds(100 * *rc::gen::inRange(1, 40)));
  const double end = 22.0;
  const auto log = log_of(spec, reads, end);
  std::map<std::string, std::vector<Time>> stamps;
  for (const TagRead& read : reads) stamps[read.tag].push_back(read.stamp);
  Lines expected;
  for (const auto& [tag, of] : stamps) {
    const Lines lines = naive_presence(tag, of, spec.presence, time_from_seconds(end));
    expected.insert(expected.end(), lines.begin(), lines.end());
  }
  Lines reported = log->presence;
  std::sort(reported.begin(), reported.end());
  std::sort(expected.begin(), expected.end());
  RC_ASSERT(reported == expected);
  RC_ASSERT(std::is_sorted(
      log->events.begin(), log->events.end(),
      [](const PresenceEvent& a, const PresenceEvent& b) { return a.stamp < b.stamp; }));
}

RC_GTEST_PROP(EventStage, TellsAdditionsAndDeletionsAsSetsDo, ()) {
  const std::vector<TagRead> reads = random_reads();
  CycleSpec cycle = door();
  cycle.duration = milliseconds(100 * *rc::gen::inRange(1, 20));
  cycle.repeat = *cycle.duration + milliseconds(100 * *rc::gen::inRange(0, 10));
  cycle.reports = {report(ReportSet::kAdditions), report(ReportSet::kDeletions)};
  Lines expected;
  std::set<std::string> before;
  const Time end = time_from_seconds(22.0);
  for (int k = 0; Time(k * *cycle.repeat) + *cycle.duration <= end; ++k) {
    const Time begin(k * *cycle.repeat);
    std::set<std::string> now;
    for (const TagRead& read : reads) {
      if (read.stamp >= begin && read.stamp < begin + *cycle.duration) now.insert(read.tag);
    }
    Lines added;
    Lines gone;
    std::set_difference(now.begin(), now.end(), before.begin(), before.end(),
                        std::back_inserter(added));
    std::set_difference(before.begin(), before.end(), now.begin(), now.end(),
                        std::back_inserter(gone));
    std::string line = fmt::format("door#{} {:g}-{:g} duration:", k + 1, to_seconds(begin),
                                   to_seconds(begin + *cycle.duration));
    if (!added.empty()) line += fmt::format(" additions[={}]", fmt::join(added, ","));
    if (!gone.empty()) line += fmt::format(" deletions[={}]", fmt::join(gone, ","));
    if (!added.empty() || !gone.empty()) expected.push_back(line);
    before = now;
  }
  Lines reported = log_of(with(cycle), reads, 22.0)->cycles;
  reported.erase(std::remove_if(reported.begin(), reported.end(),
                                [](const std::string& line) {
                                  return line.find(" cut:") != std::string::npos;
                                }),
                 reported.end());
  RC_ASSERT(reported == expected);
}

}  // namespace
}  // namespace tagfield
