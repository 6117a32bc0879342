// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/llrp_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <set>

#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield::llrp {
namespace {

using std::chrono::milliseconds;

/// Two readers with one antenna each, a Gen2 inventory, and three tags that both of them read.
Scenario two_readers(const std::string& rate_hz, const std::string& plan) {
  std::string text = "duration_s: 10\nmodel: link_budget\nantennas:\n";
  for (const std::string number : {"1", "2"}) {
    text += "  - {name: a" + number + ", reader: r" + number + ", pose: [0, " + number +
            ", 1], profiles: [speedway_r420, panel_6dbi], channel_plan: " + plan +
            ", inventory: gen2, rate_hz: " + rate_hz + "}\n";
  }
  text +=
      "tags:\n  - {id: E20000000000000000000001, position: [1.5, 1, 1]}\n"
      "  - {id: E20000000000000000000002, position: [1.5, 1.5, 1]}\n"
      "  - {id: E20000000000000000000003, position: [1.5, 2, 1]}\n";
  Diagnostics unheard;
  return scenario_from_text(text, "test", {}, nullptr, unheard).scenario;
}

/// A client that stores what it receives, with a buffer of any level.
struct Line final : ClientLine {
  std::vector<Message> received;
  double full = 0.0;
  std::int64_t dropped = 0;
  void send(const Bytes& message, bool /*is_report*/) override {
    received.push_back(message_of(message));
  }
  double level() override { return full; }
  std::int64_t take_dropped() override { return std::exchange(dropped, 0); }
};

/// The world's reads, which the readers receive, too.
struct Air final : ReadListener, LiveMember {
  std::vector<LlrpReader*> readers;
  std::vector<TagRead> reads;
  Time until;
  std::atomic<bool> stop{false};
  void on_read(const TagRead& read) override {
    reads.push_back(read);
    for (LlrpReader* const reader : readers) reader->on_read(read);
  }
  void on_step(LiveWorld& world, Time now) override {
    for (LlrpReader* const reader : readers) reader->on_step(world, now);
    if (now >= until) stop = true;
  }
};

Bytes u32_bytes(std::uint32_t value) {
  ByteWriter out;
  out.u32(value);
  return out.written();
}

/// Two readers of a world, each with a client that receives all events.
class LlrpReaderTest : public testing::Test {
 protected:
  explicit LlrpReaderTest(const std::string& rate_hz = "15", const std::string& plan = "etsi_low")
      : world_(two_readers(rate_hz, plan), 1, outlets(air_), silent()) {
    for (LlrpReader* const reader : {&first_, &second_}) air_->readers.push_back(reader);
    world_.attach(air_);
    first_.connect(world_, line_);
    second_.connect(world_, other_line_);
    ByteWriter events;
    events.u8(0);
    events.parameter(kReaderEventNotificationSpec, [&] {
      for (std::uint16_t kind = 0; kind <= 8; ++kind) {
        events.parameter(245, [&] {
          events.u16(kind);
          events.flag(true);
        });
      }
    });
    EXPECT_EQ(ask(3, events.written()), Status::kSuccess);
  }

  void run_for(milliseconds time) {
    air_->until = world_.now() + time;
    air_->stop = false;
    world_.run(air_->stop);
  }

  /// The status of the response.
  Status ask(std::uint16_t type, const Bytes& body) { return ask(first_, *line_, type, body); }
  Status ask(LlrpReader& reader, Line& line, std::uint16_t type, const Bytes& body) {
    const std::size_t before = line.received.size();
    EXPECT_TRUE(reader.on_message(world_, {type, 7, body}));
    EXPECT_GT(line.received.size(), before);
    const Message& answer = line.received.at(before);
    EXPECT_EQ(answer.type, type + 10);
    const Parameter status = require(parameters_of(ByteReader(answer.body)), 287);
    return static_cast<Status>(ByteReader(status.content).u16());
  }
  Status ask(std::uint16_t type, std::uint32_t id) { return ask(type, u32_bytes(id)); }
  /// Adds the ROSpec 1, enables and starts it.
  void start(const Bytes& spec) {
    EXPECT_EQ(ask(20, spec), Status::kSuccess);
    EXPECT_EQ(ask(24, 1), Status::kSuccess);
    EXPECT_EQ(ask(22, 1), Status::kSuccess);
  }

  /// The other reader reads all the time.
  void start_other();

  /// Number of reads by the first reader from `begin` to before `end`.
  [[nodiscard]] std::size_t reads_between(Time begin, Time end) const {
    return static_cast<std::size_t>(
        std::count_if(air_->reads.begin(), air_->reads.end(), [&](const TagRead& read) {
          return read.reader == "r1" && read.stamp >= begin && read.stamp < end;
        }));
  }

  static Outlets outlets(const std::shared_ptr<Air>& air) {
    Outlets all;
    all.reads.push_back(air);
    return all;
  }
  static LiveOptions silent() {
    LiveOptions options;
    options.speed = 0.0;
    options.readers_start = false;
    return options;
  }

  std::shared_ptr<Air> air_ = std::make_shared<Air>();
  LiveWorld world_;
  std::shared_ptr<TagStore> tags_ = std::make_shared<TagStore>();
  LlrpReader first_{"r1", tags_, 0, [](const std::string&) {}};
  LlrpReader second_{"r2", tags_, 0, [](const std::string&) {}};
  std::shared_ptr<Line> line_ = std::make_shared<Line>();
  std::shared_ptr<Line> other_line_ = std::make_shared<Line>();
};

/// What a ROSpec in these tests may differ in.
struct Asked {
  std::uint32_t id = 1;
  std::uint8_t priority = 0;
  std::uint32_t duration_ms = 0;
  std::function<void(ByteWriter&)> ai_stop;
  std::vector<std::uint16_t> antennas = {0};
  std::uint16_t inventory_spec = 9;
  std::function<void(ByteWriter&)> setting;
  std::uint8_t trigger = 2;
  std::uint16_t n = 0;
};

void write_ai_spec(const Asked& asked, ByteWriter& out) {
  out.parameter(183, [&] {
    out.u16(static_cast<std::uint16_t>(asked.antennas.size()));
    for (const std::uint16_t antenna : asked.antennas) out.u16(antenna);
    out.parameter(184, [&] {
      if (asked.ai_stop) return asked.ai_stop(out);
      out.u8(0);
      out.u32(0);
    });
    out.parameter(186, [&] {
      out.u16(asked.inventory_spec);
      out.u8(1);
      if (asked.setting) asked.setting(out);
    });
  });
}

Bytes ro_spec(const Asked& asked) {
  ByteWriter out;
  out.parameter(kRoSpec, [&] {
    out.u32(asked.id);
    out.u8(asked.priority);
    out.u8(0);
    out.parameter(178, [&] {
      out.parameter(179, [&] { out.u8(0); });
      out.parameter(182, [&] {
        out.u8(asked.duration_ms > 0 ? 1 : 0);
        out.u32(asked.duration_ms);
      });
    });
    write_ai_spec(asked, out);
    out.parameter(kRoReportSpec, [&] {
      out.u8(asked.trigger);
      out.u16(asked.n);
      out.parameter(238, [&] { out.u16(0xFFC0); });
    });
  });
  return out.written();
}

/// A stop by tag observation.
std::function<void(ByteWriter&)> observed(std::uint8_t kind, std::uint16_t tags,
                                          std::uint16_t quiet_ms) {
  return [=](ByteWriter& out) {
    out.u8(3);
    out.u32(0);
    out.parameter(185, [&] {
      out.u8(kind);
      out.u8(0);
      out.u16(tags);
      out.u16(1);
      out.u16(quiet_ms);
      out.u32(3000);
    });
  };
}

struct AskedAccess {
  std::uint16_t count = 1;
  std::optional<std::uint8_t> report;
  std::vector<std::uint16_t> ops = {1};
};

/// An AccessSpec 5 that reads a word of the TID of any tag.
Bytes access_spec(const AskedAccess& asked) {
  ByteWriter out;
  out.parameter(kAccessSpec, [&] {
    out.u32(5);
    out.u16(0);
    out.u8(1);
    out.u8(0);
    out.u32(0);
    out.parameter(208, [&] {
      out.u8(asked.count > 0 ? 1 : 0);
      out.u16(asked.count);
    });
    out.parameter(209, [&] {
      out.parameter(338, [] {});
      for (const std::uint16_t id : asked.ops) {
        out.parameter(341, [&] {
          out.u16(id);
          out.u32(0);
          out.u8(2 << 6);
          out.u16(0);
          out.u16(1);
        });
      }
    });
    if (asked.report) out.parameter(kAccessReportSpec, [&] { out.u8(*asked.report); });
  });
  return out.written();
}

/// A SET_READER_CONFIG with this parameter.
Bytes config(const std::function<void(ByteWriter&)>& write) {
  ByteWriter out;
  out.u8(0);
  write(out);
  return out.written();
}

void write_transmitter(std::uint16_t antenna, std::uint16_t hop_table, std::uint16_t channel,
                       std::uint16_t power, ByteWriter& out) {
  out.parameter(kAntennaConfiguration, [&] {
    out.u16(antenna);
    out.parameter(224, [&] {
      out.u16(hop_table);
      out.u16(channel);
      out.u16(power);
    });
  });
}

Bytes transmitter(std::uint16_t antenna, std::uint16_t hop_table, std::uint16_t channel,
                  std::uint16_t power) {
  return config(
      [&](ByteWriter& out) { write_transmitter(antenna, hop_table, channel, power, out); });
}

void LlrpReaderTest::start_other() {
  Asked asked;
  asked.trigger = 1;
  asked.n = 1;
  EXPECT_EQ(ask(second_, *other_line_, 20, ro_spec(asked)), Status::kSuccess);
  EXPECT_EQ(ask(second_, *other_line_, 24, u32_bytes(1)), Status::kSuccess);
  EXPECT_EQ(ask(second_, *other_line_, 22, u32_bytes(1)), Status::kSuccess);
}

/// A report's tag, as far as these tests look at it.
struct Tag {
  unsigned seen = 0;
  std::uint64_t first_us = 0;
  unsigned results = 0;
};

std::vector<Tag> tags_in(const Message& message) {
  std::vector<Tag> tags;
  for (const Parameter& data : parameters_of(ByteReader(message.body))) {
    EXPECT_EQ(data.type, 240);
    Tag tag;
    for (const Parameter& parameter : parameters_of(data.content)) {
      ByteReader content = parameter.content;
      if (parameter.type == 2) tag.first_us = content.u64();
      if (parameter.type == 8) tag.seen = content.u16();
      if (parameter.type == 349) ++tag.results;
    }
    tags.push_back(tag);
  }
  return tags;
}

/// UTC [us] and content of the events of this type among the messages from `begin` on.
struct Event {
  std::uint64_t us = 0;
  Bytes content;
};

std::optional<Event> event_in(const Message& message, std::uint16_t type) {
  if (message.type != 63) return std::nullopt;
  const Parameter data = require(parameters_of(ByteReader(message.body)), 246);
  const std::vector<Parameter> inner = parameters_of(data.content);
  const auto found = find(inner, type);
  if (!found) return std::nullopt;
  ByteReader stamp = require(inner, kUtcTimestamp).content;
  ByteReader content = found->content;
  return Event{stamp.u64(), content.bytes(content.left())};
}

/// What a client received of a ROSpec: reads before and after the event of its end.
struct Outcome {
  std::size_t reads = 0;
  std::size_t late_reads = 0;
  std::size_t ends = 0;
};

Outcome outcome_of(const std::vector<Message>& messages) {
  Outcome outcome;
  for (const Message& message : messages) {
    const auto event = event_in(message, 249);
    if (event && event->content.front() == 1) ++outcome.ends;
    if (message.type != 61) continue;
    for (const Tag& tag : tags_in(message)) {
      (outcome.ends > 0 ? outcome.late_reads : outcome.reads) += tag.seen;
    }
  }
  return outcome;
}

TEST_F(LlrpReaderTest, ItsReportHasAllReadsThoughAnotherReaderReadsToo) {
  start_other();
  for (int turn = 0; turn < 12; ++turn) {
    run_for(milliseconds(50 + 10 * turn));
    line_->received.clear();
    Asked asked;
    asked.duration_ms = 100;
    start(ro_spec(asked));
    const Time begin = world_.now();
    run_for(milliseconds(300));
    EXPECT_EQ(ask(21, 1), Status::kSuccess);
    run_for(milliseconds(100));
    const Outcome outcome = outcome_of(line_->received);
    EXPECT_EQ(outcome.ends, 1U);
    EXPECT_EQ(outcome.reads, reads_between(begin, begin + milliseconds(100)));
    EXPECT_GT(outcome.reads, 5U);
    EXPECT_EQ(outcome.late_reads, 0U);
  }
}

TEST_F(LlrpReaderTest, NothingComesAfterItWasStoppedAndDeleted) {
  start_other();
  for (int turn = 0; turn < 12; ++turn) {
    run_for(milliseconds(30 + 10 * turn));
    line_->received.clear();
    EXPECT_EQ(ask(20, ro_spec({})), Status::kSuccess);
    EXPECT_EQ(ask(24, 1), Status::kSuccess);
    EXPECT_EQ(ask(22, 1), Status::kSuccess);
    const Time begin = world_.now();
    run_for(milliseconds(50));
    const Time end = world_.now();
    EXPECT_EQ(ask(23, 1), Status::kSuccess);
    EXPECT_EQ(ask(21, 1), Status::kSuccess);
    run_for(milliseconds(300));
    const Outcome outcome = outcome_of(line_->received);
    EXPECT_EQ(outcome.reads, reads_between(begin, end));
    EXPECT_GT(outcome.reads, 0U);
    EXPECT_EQ(outcome.late_reads, 0U);
  }
}

class SlowAntennas : public LlrpReaderTest {
 protected:
  SlowAntennas() : LlrpReaderTest("2") {}

  /// The end of the AISpec [us] that is stopped like this.
  std::uint64_t end_us(const std::function<void(ByteWriter&)>& stop) {
    start_other();
    run_for(milliseconds(90));
    Asked asked;
    asked.ai_stop = stop;
    start(ro_spec(asked));
    begin_ = world_.now();
    run_for(milliseconds(3000));
    for (const Message& message : line_->received) {
      if (const auto event = event_in(message, 254)) return event->us;
    }
    ADD_FAILURE() << "the AISpec did not end";
    return 0;
  }

  /// When the first reader had read this many tags [us].
  [[nodiscard]] double seen_us(std::size_t count) const {
    std::set<std::string> seen;
    for (const TagRead& read : air_->reads) {
      if (read.reader != "r1" || read.stamp < begin_) continue;
      seen.insert(read.tag);
      if (seen.size() == count) return to_seconds(read.stamp) * 1e6;
    }
    ADD_FAILURE() << "there are fewer than " << count << " tags";
    return 0.0;
  }

  Time begin_;
};

/// Within the step in which the second tag is read, though the antennas update every 500 ms.
TEST_F(SlowAntennas, EndWhenTheTagsAreSeen) {
  const auto end = static_cast<double>(end_us(observed(0, 2, 0)));
  EXPECT_GE(end, seen_us(2));
  EXPECT_LE(end, seen_us(2) + 10e3);
}

TEST_F(SlowAntennas, EndWhenNoNewTagIsSeen) {
  const auto end = static_cast<double>(end_us(observed(1, 0, 50)));
  EXPECT_GE(end, seen_us(3) + 50e3);
  EXPECT_LE(end, seen_us(3) + 60e3);
}

TEST_F(LlrpReaderTest, StopsAfterAttemptsAreRefused) {
  Asked asked;
  asked.ai_stop = observed(2, 0, 0);
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kUnsupportedParameter);
}

TEST_F(LlrpReaderTest, GetReportHasWhatWasReadUntilThen) {
  start_other();
  Asked asked;
  asked.trigger = 0;
  start(ro_spec(asked));
  const Time begin = world_.now();
  run_for(milliseconds(120));
  const Time end = world_.now();
  EXPECT_EQ(outcome_of(line_->received).reads, 0U);
  EXPECT_TRUE(first_.on_message(world_, {60, 1, {}}));
  const std::size_t reads = outcome_of(line_->received).reads;
  run_for(milliseconds(300));
  EXPECT_EQ(reads, reads_between(begin, end));
}

TEST_F(LlrpReaderTest, GetReportHasWhatAnEndedROSpecRead) {
  Asked asked;
  asked.trigger = 0;
  asked.duration_ms = 100;
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kSuccess);
  EXPECT_EQ(ask(24, 1), Status::kSuccess);
  for (int turn = 0; turn < 2; ++turn) {
    line_->received.clear();
    EXPECT_EQ(ask(22, 1), Status::kSuccess);
    const Time begin = world_.now();
    run_for(milliseconds(300));
    EXPECT_EQ(outcome_of(line_->received).late_reads, 0U);
    EXPECT_TRUE(first_.on_message(world_, {60, 1, {}}));
    EXPECT_EQ(outcome_of(line_->received).late_reads,
              reads_between(begin, begin + milliseconds(100)));
  }
}

/// Numbers of results of the tags in each report that has any.
std::vector<std::size_t> results_in(const std::vector<Message>& messages) {
  std::vector<std::size_t> all;
  for (const Message& message : messages) {
    if (message.type != 61) continue;
    std::size_t results = 0;
    for (const Tag& tag : tags_in(message)) results += tag.results;
    if (results > 0) all.push_back(results);
  }
  return all;
}

class AccessReports : public LlrpReaderTest {
 protected:
  AccessReports() {
    Asked asked;
    asked.trigger = 0;
    start(ro_spec(asked));
  }
  void access(const AskedAccess& asked) {
    EXPECT_EQ(ask(40, access_spec(asked)), Status::kSuccess);
    EXPECT_EQ(ask(42, 5), Status::kSuccess);
    run_for(milliseconds(300));
  }
};

TEST_F(AccessReports, ComeWithTheROReportByDefault) {
  access({2, {}});
  EXPECT_TRUE(results_in(line_->received).empty());
  EXPECT_TRUE(first_.on_message(world_, {60, 1, {}}));
  EXPECT_EQ(results_in(line_->received), std::vector<std::size_t>{2});
}

TEST_F(AccessReports, ComeAtTheEndOfTheAccessSpec) {
  access({2, 1});
  EXPECT_EQ(results_in(line_->received), std::vector<std::size_t>{2});
}

TEST_F(AccessReports, ComeAtTheEndAsConfigured) {
  const Bytes at_end =
      config([](ByteWriter& out) { out.parameter(kAccessReportSpec, [&] { out.u8(1); }); });
  EXPECT_EQ(ask(3, at_end), Status::kSuccess);
  access({2, {}});
  EXPECT_EQ(results_in(line_->received), std::vector<std::size_t>{2});
  // The AccessSpec's own setting takes precedence.
  access({2, 0});
  EXPECT_EQ(results_in(line_->received), std::vector<std::size_t>{2});
}

TEST_F(AccessReports, ComeWhenAClientEndsTheAccessSpec) {
  access({65535, 1});
  EXPECT_TRUE(results_in(line_->received).empty());
  EXPECT_EQ(ask(41, 5), Status::kSuccess);
  ASSERT_EQ(results_in(line_->received).size(), 1U);
  EXPECT_GT(results_in(line_->received).front(), 5U);
}

TEST_F(AccessReports, ComeAfterEachExecutionWithoutEnd) {
  access({0, 1});
  std::size_t results = 0;
  for (const std::size_t each : results_in(line_->received)) results += each;
  EXPECT_GT(results, 5U);
}

TEST_F(AccessReports, HaveATriggerOfTwo) {
  EXPECT_EQ(ask(40, access_spec({1, 2})), Status::kFieldError);
  const Bytes third =
      config([](ByteWriter& out) { out.parameter(kAccessReportSpec, [&] { out.u8(2); }); });
  EXPECT_EQ(ask(3, third), Status::kFieldError);
}

TEST_F(LlrpReaderTest, NothingIsConfiguredThatIsNotThere) {
  const auto keepalive = [](std::uint8_t trigger, std::uint32_t ms) {
    return config([=](ByteWriter& out) {
      out.parameter(kKeepaliveSpec, [&] {
        out.u8(trigger);
        out.u32(ms);
      });
    });
  };
  const auto mode = [](std::uint16_t index) {
    return config([=](ByteWriter& out) {
      out.parameter(kAntennaConfiguration, [&] {
        out.u16(0);
        out.parameter(330, [&] {
          out.u8(0);
          out.parameter(335, [&] {
            out.u16(index);
            out.u16(0);
          });
        });
      });
    });
  };
  const auto whole = [&] {
    line_->received.clear();
    EXPECT_EQ(ask(2, Bytes(7, 0)), Status::kSuccess);
    return line_->received.back().body;
  };
  EXPECT_EQ(ask(3, transmitter(1, 0, 2, 5)), Status::kSuccess);
  EXPECT_EQ(ask(3, keepalive(1, 100)), Status::kSuccess);
  EXPECT_EQ(ask(3, mode(2)), Status::kSuccess);
  const Bytes before = whole();
  for (const Bytes& bad :
       {transmitter(0, 0, 1, 0), transmitter(0, 0, 1, 300), transmitter(0, 0, 77, 1),
        transmitter(2, 0, 1, 1), mode(5000), keepalive(5, 100), keepalive(1, 0)}) {
    EXPECT_EQ(ask(3, bad), Status::kFieldError);
    Bytes resets = bad;
    resets.front() = 0x80;
    EXPECT_EQ(ask(3, resets), Status::kFieldError);
  }
  EXPECT_EQ(whole(), before);
  EXPECT_EQ(ask(20, ro_spec({})), Status::kSuccess);
}

/// The channel is ignored where readers hop, and the hop table where they do not (§12.2.6.2).
TEST_F(LlrpReaderTest, AHopTableIsIgnoredWithoutHopping) {
  EXPECT_EQ(ask(3, transmitter(0, 7, 1, 1)), Status::kSuccess);
}

class HoppingReaders : public LlrpReaderTest {
 protected:
  HoppingReaders() : LlrpReaderTest("15", "fcc") {}
};

TEST_F(HoppingReaders, HaveOneHopTable) {
  EXPECT_EQ(ask(3, transmitter(0, 1, 77, 1)), Status::kSuccess);
  EXPECT_EQ(ask(3, transmitter(0, 7, 0, 1)), Status::kFieldError);
  Asked asked;
  asked.setting = [](ByteWriter& out) { write_transmitter(0, 7, 0, 1, out); };
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kFieldError);
}

TEST_F(LlrpReaderTest, KeepsToItsCapabilities) {
  const auto filters = [](int count) {
    Asked asked;
    asked.setting = [=](ByteWriter& out) {
      out.parameter(kAntennaConfiguration, [&] {
        out.u16(0);
        out.parameter(330, [&] {
          out.u8(0);
          for (int i = 0; i < count; ++i) {
            out.parameter(331, [&] {
              out.u8(0);
              out.parameter(332, [&] {
                out.u8(1 << 6);
                out.u16(32);
                out.u16(0);
              });
            });
          }
        });
      });
    };
    return ro_spec(asked);
  };
  EXPECT_EQ(ask(20, filters(8)), Status::kSuccess);
  EXPECT_EQ(ask(20, filters(9)), Status::kOverflowParameter);
  AskedAccess many;
  many.ops.clear();
  for (std::uint16_t id = 1; id <= 17; ++id) many.ops.push_back(id);
  EXPECT_EQ(ask(40, access_spec(many)), Status::kOverflowParameter);
  many.ops.pop_back();
  EXPECT_EQ(ask(40, access_spec(many)), Status::kSuccess);
}

TEST_F(LlrpReaderTest, AnAntennaIsNamedOnceAndAnInventoryHasAnId) {
  Asked asked;
  asked.antennas = {1, 1};
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kFieldError);
  // All antennas if 0 is among them (§10.2.2).
  asked.antennas = {0, 1};
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kSuccess);
  asked.id = 2;
  asked.inventory_spec = 0;
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kFieldError);
}

TEST_F(LlrpReaderTest, MessagesEndWhereTheyShould) {
  EXPECT_EQ(ask(26, Bytes{}), Status::kSuccess);
  EXPECT_EQ(ask(26, Bytes{1, 2, 3}), Status::kParameterError);
  EXPECT_EQ(ask(44, Bytes{1}), Status::kParameterError);
  EXPECT_EQ(ask(21, Bytes{0, 0, 0, 0, 9}), Status::kParameterError);
}

TEST_F(LlrpReaderTest, OnlyAHigherPriorityStartsWhileAnotherIsActive) {
  Asked asked;
  asked.priority = 3;
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kSuccess);
  asked.id = 2;
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kSuccess);
  asked.id = 3;
  asked.priority = 2;
  EXPECT_EQ(ask(20, ro_spec(asked)), Status::kSuccess);
  EXPECT_EQ(ask(24, 0U), Status::kSuccess);
  EXPECT_EQ(ask(22, 1), Status::kSuccess);
  EXPECT_EQ(ask(22, 1), Status::kSuccess);  // Already active.
  EXPECT_EQ(ask(22, 2), Status::kFieldError);
  EXPECT_EQ(ask(22, 3), Status::kSuccess);
  EXPECT_EQ(ask(22, 1), Status::kFieldError);
}

TEST_F(LlrpReaderTest, AnOverflowIsToldOnce) {
  const auto overflows = [&] {
    return std::count_if(line_->received.begin(), line_->received.end(),
                         [](const Message& message) { return event_in(message, 251).has_value(); });
  };
  // The level falls below that of the warning between losses.
  for (int i = 0; i < 20; ++i) {
    line_->full = i % 2 == 0 ? 1.0 : 0.7;
    line_->dropped = 3;
    run_for(milliseconds(10));
  }
  EXPECT_EQ(overflows(), 1);
  line_->full = 0.1;
  run_for(milliseconds(20));
  EXPECT_EQ(overflows(), 1);
  line_->full = 1.0;
  line_->dropped = 1;
  run_for(milliseconds(10));
  EXPECT_EQ(overflows(), 2);
}

}  // namespace
}  // namespace tagfield::llrp
