// SPDX-License-Identifier: Apache-2.0
/// @file
/// One reader of a live world in LLRP 1.0.1: ROSpecs, AccessSpecs, reports, events. Independent of
/// sockets; docs/llrp.md lists the supported parts of the protocol.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "adapters/llrp/access_specs.h"
#include "adapters/llrp/capabilities.h"
#include "adapters/llrp/reader_configuration.h"
#include "adapters/llrp/report_queue.h"
#include "adapters/llrp/reports.h"
#include "adapters/llrp/specs.h"
#include "adapters/llrp/tag_store.h"
#include "tagfield/live/live_world.h"

namespace tagfield::llrp {

/// Outgoing connection from a reader to its client.
class ClientLine {
 public:
  ClientLine() = default;
  virtual ~ClientLine() = default;
  ClientLine(const ClientLine&) = delete;
  ClientLine& operator=(const ClientLine&) = delete;

  /// Returns immediately. If the buffer is full, the oldest reports are dropped.
  virtual void send(const Bytes& message, bool is_report) = 0;
  /// Fill level of the buffer, 0 to 1.
  virtual double level() = 0;
  /// Number of reports dropped since the last call.
  virtual std::int64_t take_dropped() = 0;
};

/// To be used only on the thread that runs the world.
class LlrpReader {
 public:
  /// `name`: that of the world's reader. `tags` are shared with the world's other readers.
  /// `epoch_us`: UTC at the simulated time 0. `warn` receives client requests that have no effect.
  LlrpReader(std::string name, std::shared_ptr<TagStore> tags, std::uint64_t epoch_us,
             std::function<void(const std::string&)> warn);

  [[nodiscard]] const std::string& name() const { return name_; }

  /// Accepts a client and notifies it.
  void connect(LiveWorld& world, std::shared_ptr<ClientLine> line);
  /// Removes the client on this line: its ROSpecs continue, and reports are kept.
  void disconnect(const ClientLine& line);
  /// Answers a message from the client. False if the connection is to be closed.
  bool on_message(LiveWorld& world, const Message& message);
  void on_read(const TagRead& read);
  void on_step(LiveWorld& world, Time now);

 private:
  enum class State : std::uint8_t { kDisabled = 0, kInactive = 1, kActive = 2 };
  struct RoEntry {
    RoSpec spec;
    State state = State::kDisabled;
    std::optional<Time> next_start;  ///< According to its period.
  };
  /// The active ROSpec.
  struct Running {
    std::uint32_t id = 0;
    Time began;
    std::size_t ai = 0;
    Time ai_began;
    std::set<std::string> seen;  ///< In this AISpec.
    Time last_new;
    std::vector<TagFilter> filters;
    Time ends = Time::max();  ///< By the ROSpec's duration.
    AiSpec ai_spec;
    ReportGathering gathering;
  };
  using Handler = void (LlrpReader::*)(LiveWorld&, const Message&, ByteWriter&);

  static const std::map<std::uint16_t, Handler>& handlers();
  void capabilities(LiveWorld& world, const Message& message, ByteWriter& out);
  void get_config(LiveWorld& world, const Message& message, ByteWriter& out);
  void set_config(LiveWorld& world, const Message& message, ByteWriter& out);
  void add_ro_spec(LiveWorld& world, const Message& message, ByteWriter& out);
  void change_ro_spec(LiveWorld& world, const Message& message, ByteWriter& out);
  void get_ro_specs(LiveWorld& world, const Message& message, ByteWriter& out);
  void add_access_spec(LiveWorld& world, const Message& message, ByteWriter& out);
  void change_access_spec(LiveWorld& world, const Message& message, ByteWriter& out);
  void get_access_specs(LiveWorld& world, const Message& message, ByteWriter& out);
  void on_custom(LiveWorld& world, const Message& message);

  RoEntry& ro_spec(std::uint32_t id);
  void enable(LiveWorld& world, RoEntry& entry);
  void disable(LiveWorld& world, RoEntry& entry);
  [[nodiscard]] bool may_start(const RoEntry& entry);
  void start(LiveWorld& world, RoEntry& entry);
  void end(LiveWorld& world, std::uint32_t preempted_by = 0);
  void be_silent(LiveWorld& world);
  void begin_ai_spec(LiveWorld& world);
  void end_ai_spec(LiveWorld& world);
  void start_those_due(LiveWorld& world, Time now);
  void check_duty(const LiveWorld& world, const AiSpec& spec);
  void report_warnings(const std::vector<std::string>& warnings);
  void watch_antennas(const LiveWorld& world);
  void tell_line_state();

  static bool is_ai_spec_over(const Running& running, Time at);
  void take_reads(LiveWorld& world);
  void take_held(const LiveWorld& world);
  void take(const TagRead& read);
  [[nodiscard]] TagReport report_of(const TagRead& read, const Running& running,
                                    const MemoryBanks& tag) const;
  void report_gathered(Running& running);
  void report_all();
  void add_pending(std::vector<Bytes> reports);
  [[nodiscard]] bool is_nobody_taking() const;
  void flush();
  void tell_event(std::uint16_t kind, const std::function<void(ByteWriter&)>& write);
  void send(std::uint16_t type, std::uint32_t id, const ByteWriter& body, bool is_report = false);
  void answer(std::uint16_t type, std::uint32_t id, const ByteWriter& body);
  [[nodiscard]] std::uint64_t utc_us(Time time) const;

  std::string name_;
  std::shared_ptr<TagStore> tags_;
  std::uint64_t epoch_us_;
  std::function<void(const std::string&)> warn_;
  std::set<std::string> warned_;

  std::shared_ptr<ClientLine> line_;
  bool is_holding_ = false;  ///< Holds reports until the client requests them.
  std::uint32_t next_id_ = 1;
  /// Messages that a request caused, to be sent after its response; none between requests.
  std::optional<std::vector<std::pair<Bytes, bool>>> after_answer_;
  Time now_{};
  std::optional<Time> kept_alive_;
  bool has_warned_of_buffer_ = false;
  bool has_told_of_overflow_ = false;

  ReaderConfiguration configuration_;
  std::map<std::uint32_t, RoEntry> ro_specs_;
  AccessSpecs access_specs_;
  std::optional<Running> running_;
  /// Reads until then have been taken, including those that the world held back and delivers later.
  Time taken_until_ = Time::min();
  Ports ports_;  ///< As of the last step.
  std::map<std::string, bool> faulty_;
  ReportQueue queue_;
  std::vector<std::string> killed_;  ///< Tags to be removed from the world.
};

}  // namespace tagfield::llrp
