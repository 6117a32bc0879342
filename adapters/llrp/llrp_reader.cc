// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/llrp_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"

namespace tagfield::llrp {
namespace {

/// Levels of a client's buffer: it is told above the first, and may be told again once below the
/// second.
constexpr double kFullLevel = 0.8;
constexpr double kRelaxedLevel = 0.5;

// Messages (§16.3) and their responses.
constexpr std::uint16_t kCloseConnection = 14;
constexpr std::uint16_t kGetReport = 60;
constexpr std::uint16_t kReportMessage = 61;
constexpr std::uint16_t kKeepalive = 62;
constexpr std::uint16_t kEvent = 63;
constexpr std::uint16_t kEnableEvents = 64;
constexpr std::uint16_t kKeepaliveAck = 72;
constexpr std::uint16_t kErrorMessage = 100;
constexpr std::uint16_t kCustomMessage = 1023;
constexpr std::uint16_t kToAnswer = 10;  ///< Offset from a request's type to its response's.

// Kinds of events (§13.1.6.1).
constexpr std::uint16_t kRoSpecEvents = 2;
constexpr std::uint16_t kBufferEvents = 3;
constexpr std::uint16_t kAiSpecEvents = 6;
constexpr std::uint16_t kAntennaEvents = 8;
constexpr std::uint16_t kAlways = 0xffff;  ///< Events of the connection.

void write_status(Status status, const std::string& text, ByteWriter& writer) {
  writer.parameter(287, [&] {
    writer.u16(static_cast<std::uint16_t>(status));
    writer.text(text.substr(0, 1000));
  });
}

void write_ok(ByteWriter& writer, const std::string& text = "") {
  write_status(Status::kSuccess, text, writer);
}

}  // namespace

LlrpReader::LlrpReader(std::string name, std::shared_ptr<TagStore> tags, std::uint64_t epoch_us,
                       std::function<void(const std::string&)> warn)
    : name_(std::move(name)), tags_(std::move(tags)), epoch_us_(epoch_us), warn_(std::move(warn)) {}

std::uint64_t LlrpReader::utc_us(Time time) const {
  return epoch_us_ +
         static_cast<std::uint64_t>(
             std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch())
                 .count());
}

void LlrpReader::send(std::uint16_t type, std::uint32_t id, const ByteWriter& body,
                      bool is_report) {
  if (!line_) return;
  Bytes message = to_bytes({type, id, body.written()});
  if (after_answer_) {
    after_answer_->emplace_back(std::move(message), is_report);
  } else {
    line_->send(message, is_report);
  }
}

/// Sent before all messages that the request caused: simple clients take the next message for the
/// response.
void LlrpReader::answer(std::uint16_t type, std::uint32_t id, const ByteWriter& body) {
  const auto brought_about = std::exchange(after_answer_, std::nullopt);
  send(type, id, body);
  if (!brought_about || !line_) return;
  for (const auto& [message, is_report] : *brought_about) line_->send(message, is_report);
}

void LlrpReader::tell_event(std::uint16_t kind, const std::function<void(ByteWriter&)>& write) {
  if (kind != kAlways && configuration_.events.count(kind) == 0) return;
  ByteWriter body;
  body.parameter(246, [&] {
    body.parameter(kUtcTimestamp, [&] { body.u64(utc_us(now_)); });
    write(body);
  });
  send(kEvent, next_id_++, body);
}

void LlrpReader::connect(LiveWorld& world, std::shared_ptr<ClientLine> line) {
  line_ = std::move(line);
  now_ = world.now();
  kept_alive_ = now_;
  is_holding_ = configuration_.holds_reports;
  has_warned_of_buffer_ = has_told_of_overflow_ = false;
  tell_event(kAlways, [](ByteWriter& out) { out.parameter(256, [&] { out.u16(0); }); });
  flush();
}

void LlrpReader::disconnect(const ClientLine& line) {
  if (line_.get() == &line) line_.reset();
}

bool LlrpReader::on_message(LiveWorld& world, const Message& message) {
  now_ = world.now();
  ports_ = ports_of(world, name_, ports_);
  ByteWriter out;
  try {
    switch (message.type) {
      case kKeepaliveAck:
        return true;
      case kEnableEvents:
        is_holding_ = false;
        flush();
        return true;
      case kGetReport:
        take_reads(world);
        report_all();
        flush();
        return true;
      case kCustomMessage:
        on_custom(world, message);
        return true;
      case kCloseConnection:
        write_ok(out);
        answer(4, message.id, out);
        return false;
      default:
        break;
    }
    const auto handler = handlers().find(message.type);
    if (handler == handlers().end()) {
      throw Fault(Status::kUnsupportedMessage,
                  fmt::format("message {} is not supported", message.type));
    }
    after_answer_.emplace();
    (this->*handler->second)(world, message, out);
    answer(static_cast<std::uint16_t>(message.type + kToAnswer), message.id, out);
  } catch (const Fault& fault) {
    ByteWriter refusal;
    write_status(fault.status(), fault.what(), refusal);
    const bool is_known = handlers().count(message.type) > 0;
    answer(is_known ? static_cast<std::uint16_t>(message.type + kToAnswer) : kErrorMessage,
           message.id, refusal);
  }
  return true;
}

const std::map<std::uint16_t, LlrpReader::Handler>& LlrpReader::handlers() {
  static const std::map<std::uint16_t, Handler> all = {
      {1, &LlrpReader::capabilities},        {2, &LlrpReader::get_config},
      {3, &LlrpReader::set_config},          {20, &LlrpReader::add_ro_spec},
      {21, &LlrpReader::change_ro_spec},     {22, &LlrpReader::change_ro_spec},
      {23, &LlrpReader::change_ro_spec},     {24, &LlrpReader::change_ro_spec},
      {25, &LlrpReader::change_ro_spec},     {26, &LlrpReader::get_ro_specs},
      {40, &LlrpReader::add_access_spec},    {41, &LlrpReader::change_access_spec},
      {42, &LlrpReader::change_access_spec}, {43, &LlrpReader::change_access_spec},
      {44, &LlrpReader::get_access_specs},
  };
  return all;
}

void LlrpReader::capabilities(LiveWorld& /*world*/, const Message& message, ByteWriter& out) {
  const std::uint8_t requested = ByteReader(message.body).u8();
  if (requested > 4) throw Fault(Status::kFieldError, "the requested data must be from 0 to 4");
  write_ok(out);
  write_capabilities(ports_, requested, out);
}

/// Impinj's message that enables extensions, which are always enabled.
void LlrpReader::on_custom(LiveWorld& /*world*/, const Message& message) {
  ByteReader reader(message.body);
  if (reader.u32() != kImpinj || reader.u8() != 21) {
    throw Fault(Status::kUnsupportedMessage, "this vendor's message is not supported");
  }
  ByteWriter out;
  out.u32(kImpinj);
  out.u8(22);
  write_ok(out);
  send(kCustomMessage, message.id, out);
}

void LlrpReader::get_config(LiveWorld& /*world*/, const Message& message, ByteWriter& out) {
  ByteWriter parameters;
  write_configuration(configuration_, name_, ports_, ByteReader(message.body), parameters);
  write_ok(out);
  out.bytes(parameters.written());
}

void LlrpReader::set_config(LiveWorld& world, const Message& message, ByteWriter& out) {
  configuration_ = configured(configuration_, ports_, ByteReader(message.body));
  kept_alive_ = world.now();
  write_ok(out);
}

void LlrpReader::report_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    if (warned_.insert(warning).second) warn_(fmt::format("reader '{}': {}", name_, warning));
  }
}

/// Throws Fault if the AISpec can't be executed.
void LlrpReader::check_duty(const LiveWorld& /*world*/, const AiSpec& spec) {
  const ReaderDuty duty = duty_of(configuration_, ports_, spec);
  std::vector<std::string> warnings;
  try {
    for (const AntennaDuty& one : duty.antennas) {
      on_duty(ports_.antennas[ports_.id_of(one.antenna) - 1U].spec.parameters, duty, warnings);
    }
  } catch (const Error& error) {
    throw Fault(Status::kFieldError, error.what());
  }
  report_warnings(warnings);
}

void LlrpReader::add_ro_spec(LiveWorld& world, const Message& message, ByteWriter& out) {
  const RoSpec spec = ro_spec_of(only_parameter(message, kRoSpec));
  if (ro_specs_.count(spec.id) > 0) {
    throw Fault(Status::kFieldError, fmt::format("there is a ROSpec {} already", spec.id));
  }
  require_room(ro_specs_.size(), kMaxRoSpecs, "ROSpecs");
  for (const AiSpec& ai : spec.specs) check_duty(world, ai);
  ro_specs_[spec.id].spec = spec;
  write_ok(out);
}

LlrpReader::RoEntry& LlrpReader::ro_spec(std::uint32_t id) {
  const auto found = ro_specs_.find(id);
  if (found == ro_specs_.end()) {
    throw Fault(Status::kFieldError, fmt::format("there is no ROSpec {}", id));
  }
  return found->second;
}

void LlrpReader::change_ro_spec(LiveWorld& world, const Message& message, ByteWriter& out) {
  const std::uint32_t id = id_in(message);
  std::vector<std::uint32_t> ids;
  const bool takes_all = message.type != 22 && message.type != 23;
  if (id == 0 && takes_all) {
    for (const auto& [each, entry] : ro_specs_) ids.push_back(each);
  } else {
    ro_spec(id);
    ids = {id};
  }
  for (const std::uint32_t each : ids) {
    RoEntry& entry = ro_spec(each);
    switch (message.type) {
      case 21:
        disable(world, entry);
        ro_specs_.erase(each);
        break;
      case 22:
        if (entry.state == State::kDisabled) {
          throw Fault(Status::kFieldError, fmt::format("ROSpec {} is disabled", each));
        }
        if (!may_start(entry)) {
          throw Fault(Status::kFieldError,
                      fmt::format("ROSpec {} is active, and ROSpec {} has no higher priority",
                                  running_->id, each));
        }
        start(world, entry);
        break;
      case 23:
        if (entry.state != State::kActive) {
          throw Fault(Status::kFieldError, fmt::format("ROSpec {} is not active", each));
        }
        end(world);
        break;
      case 24:
        enable(world, entry);
        break;
      default:
        disable(world, entry);
        break;
    }
  }
  write_ok(out);
}

void LlrpReader::get_ro_specs(LiveWorld& /*world*/, const Message& message, ByteWriter& out) {
  ByteReader(message.body).require_end();
  write_ok(out);
  for (const auto& [id, entry] : ro_specs_) {
    Bytes whole = entry.spec.whole;
    whole[9] = static_cast<std::uint8_t>(entry.state);  // after the header, ID and priority
    out.bytes(whole);
  }
}

void LlrpReader::enable(LiveWorld& world, RoEntry& entry) {
  if (entry.state != State::kDisabled) return;
  entry.state = State::kInactive;
  if (entry.spec.start == StartAt::kImmediate) start(world, entry);
  if (entry.spec.start == StartAt::kPeriodic) {
    entry.next_start = now_ + entry.spec.offset;
    if (entry.spec.start_utc_us && *entry.spec.start_utc_us > utc_us(now_)) {
      entry.next_start = now_ + std::chrono::microseconds(*entry.spec.start_utc_us - utc_us(now_)) +
                         entry.spec.offset;
    }
  }
}

void LlrpReader::disable(LiveWorld& world, RoEntry& entry) {
  if (entry.state == State::kActive) end(world);
  entry.state = State::kDisabled;
  entry.next_start.reset();
}

/// Only a ROSpec of lower priority is preempted; its number is greater.
bool LlrpReader::may_start(const RoEntry& entry) {
  return !running_ || entry.state == State::kActive ||
         ro_spec(running_->id).spec.priority > entry.spec.priority;
}

void LlrpReader::start(LiveWorld& world, RoEntry& entry) {
  if (entry.state == State::kActive || !may_start(entry)) return;
  if (running_) end(world, entry.spec.id);
  entry.state = State::kActive;
  const bool has_duration = entry.spec.stop == StopAt::kDuration;
  running_ = Running{entry.spec.id,
                     now_,
                     0,
                     now_,
                     {},
                     now_,
                     {},
                     has_duration ? now_ + entry.spec.duration : Time::max(),
                     {},
                     ReportGathering(entry.spec.report.value_or(configuration_.report))};
  tell_event(kRoSpecEvents, [&](ByteWriter& out) {
    out.parameter(249, [&] {
      out.u8(0);
      out.u32(entry.spec.id);
      out.u32(0);
    });
  });
  begin_ai_spec(world);
}

void LlrpReader::begin_ai_spec(LiveWorld& world) {
  Running& running = *running_;
  const AiSpec& spec = ro_spec(running.id).spec.specs[running.ai];
  running.ai_began = running.last_new = now_;
  running.seen.clear();
  running.ai_spec = spec;
  running.filters = setting_of(configuration_, spec.settings, spec.antennas.front())
                        .filters.value_or(std::vector<TagFilter>{});
  try {
    report_warnings(world.set_duty(name_, duty_of(configuration_, ports_, spec)));
  } catch (const std::exception& error) {
    // Antennas may have been removed from the world since it was added.
    report_warnings({fmt::format("ROSpec {} can't continue: {}", running.id, error.what())});
    be_silent(world);
  }
}

/// Takes what the antennas have read so far.
void LlrpReader::be_silent(LiveWorld& world) {
  try {
    world.set_duty(name_, {});
  } catch (const Error&) {
    // All of its antennas have been removed from the world: it is silent.
  }
  take_held(world);
}

void LlrpReader::end_ai_spec(LiveWorld& world) {
  Running& running = *running_;
  be_silent(world);
  if (running.gathering.spec().trigger == 1) report_gathered(running);
  const std::uint32_t id = running.id;
  const auto index = static_cast<std::uint16_t>(running.ai + 1);
  tell_event(kAiSpecEvents, [&](ByteWriter& out) {
    out.parameter(254, [&] {
      out.u8(0);
      out.u32(id);
      out.u16(index);
    });
  });
  if (++running.ai < ro_spec(id).spec.specs.size()) {
    begin_ai_spec(world);
  } else {
    end(world);
  }
}

void LlrpReader::end(LiveWorld& world, std::uint32_t preempted_by) {
  be_silent(world);
  const std::uint32_t id = running_->id;
  if (running_->gathering.spec().trigger != 0) {
    report_gathered(*running_);
  } else {
    queue_.keep(running_->gathering.take());
  }
  running_.reset();
  ro_spec(id).state = State::kInactive;
  flush();
  tell_event(kRoSpecEvents, [&](ByteWriter& out) {
    out.parameter(249, [&] {
      out.u8(preempted_by == 0 ? 1 : 2);
      out.u32(id);
      out.u32(preempted_by);
    });
  });
}

bool LlrpReader::is_ai_spec_over(const Running& running, Time at) {
  const AiSpec& spec = running.ai_spec;
  if (spec.stop == StopAt::kDuration) return at - running.ai_began >= spec.duration;
  if (spec.stop != StopAt::kTagObservation) return false;
  if (spec.timeout > Duration::zero() && at - running.ai_began >= spec.timeout) return true;
  if (spec.observation == 0) return running.seen.size() >= spec.tags;
  return spec.quiet > Duration::zero() && at - running.last_new >= spec.quiet;
}

void LlrpReader::start_those_due(LiveWorld& world, Time now) {
  for (auto& [id, entry] : ro_specs_) {
    if (!entry.next_start || now < *entry.next_start) continue;
    if (entry.spec.period > Duration::zero()) {
      while (*entry.next_start <= now) *entry.next_start += entry.spec.period;
    } else {
      entry.next_start.reset();
    }
    start(world, entry);
  }
}

void LlrpReader::watch_antennas(const LiveWorld& world) {
  ports_ = ports_of(world, name_, ports_);
  for (const LiveAntenna& antenna : ports_.antennas) {
    const std::string& name = antenna.spec.parameters.name;
    const auto known = faulty_.find(name);
    const bool has_changed = known != faulty_.end() && known->second != antenna.is_faulty;
    faulty_[name] = antenna.is_faulty;
    if (!has_changed) continue;
    tell_event(kAntennaEvents, [&](ByteWriter& out) {
      out.parameter(255, [&] {
        out.u8(antenna.is_faulty ? 0 : 1);
        out.u16(ports_.id_of(name));
      });
    });
  }
}

/// Notifies a client that falls behind, and that it loses reports, once until it has caught up.
void LlrpReader::tell_line_state() {
  if (!line_) return;
  const double level = line_->level();
  if (level > kFullLevel && !has_warned_of_buffer_) {
    tell_event(kBufferEvents, [&](ByteWriter& out) {
      out.parameter(250, [&] { out.u8(static_cast<std::uint8_t>(100.0 * level)); });
    });
    has_warned_of_buffer_ = true;
  }
  const std::int64_t dropped = queue_.take_dropped() + line_->take_dropped();
  if (dropped > 0 && !has_told_of_overflow_) {
    report_warnings({"a client is too slow and loses reports"});
    tell_event(kBufferEvents, [](ByteWriter& out) { out.parameter(251, [] {}); });
    has_told_of_overflow_ = true;
  }
  if (level < kRelaxedLevel && !is_holding_) has_warned_of_buffer_ = has_told_of_overflow_ = false;
}

void LlrpReader::on_step(LiveWorld& world, Time now) {
  now_ = now;
  watch_antennas(world);
  for (const std::string& id : killed_) {
    const std::vector<LivePose> tags = world.tags();
    const bool is_there =
        std::any_of(tags.begin(), tags.end(), [&](const LivePose& tag) { return tag.name == id; });
    if (is_there) world.remove_tag(id);
  }
  killed_.clear();
  // Such a stop depends on what is read, and is not to depend on when antennas update.
  if (running_ && running_->ai_spec.stop == StopAt::kTagObservation) take_reads(world);
  if (running_) {
    if (now >= running_->ends) {
      end(world);
    } else if (is_ai_spec_over(*running_, now)) {
      end_ai_spec(world);
    }
  }
  start_those_due(world, now);
  flush();
  tell_line_state();
  if (line_ && configuration_.keepalive > Duration::zero() &&
      now - *kept_alive_ >= configuration_.keepalive) {
    kept_alive_ = now;
    send(kKeepalive, next_id_++, {});
  }
}

TagReport LlrpReader::report_of(const TagRead& read, const Running& running,
                                const MemoryBanks& tag) const {
  const std::vector<double> channels = channels_of(ports_);
  const auto channel = std::min_element(channels.begin(), channels.end(), [&](double a, double b) {
    return std::abs(a - read.frequency_hz) < std::abs(b - read.frequency_hz);
  });
  TagReport report;
  report.epc = tag.epc();
  report.pc = tag.pc();
  report.crc = tag.crc();
  report.ro_spec = running.id;
  report.spec_index = static_cast<std::uint16_t>(running.ai + 1);
  report.inventory_spec = running.ai_spec.inventory_spec;
  report.antenna = ports_.id_of(read.antenna);
  report.channel = static_cast<std::uint16_t>(channel - channels.begin() + 1);
  report.peak_rssi_dbm = read.rssi_dbm;
  report.phase_rad = read.phase_rad;
  report.doppler_hz = read.doppler_hz;
  report.first_us = report.last_us = utc_us(read.stamp);
  return report;
}

void LlrpReader::on_read(const TagRead& read) {
  if (read.reader == name_ && read.stamp > taken_until_) take(read);
}

/// Takes all reads until now.
void LlrpReader::take_reads(LiveWorld& world) {
  world.update_reader(name_);
  take_held(world);
}

/// Takes the reads that the world still holds back.
void LlrpReader::take_held(const LiveWorld& world) {
  const Time before = taken_until_;
  for (const TagRead& read : world.held_reads(name_)) {
    if (read.stamp > before) take(read);
    taken_until_ = std::max(taken_until_, read.stamp);
  }
}

void LlrpReader::take(const TagRead& read) {
  if (!running_ || read.stamp < running_->ai_began) return;
  Running& running = *running_;
  MemoryBanks& tag = tags_->of(read.tag);
  if (tag.is_killed() || !is_selected(running.filters, tag)) return;
  // The ROSpec ended within a step: the reader is silent from then on.
  if (read.stamp >= running.ends || is_ai_spec_over(running, read.stamp)) return;
  if (running.seen.insert(read.tag).second) running.last_new = read.stamp;
  TagReport report = report_of(read, running, tag);
  // One AccessSpec per singulation.
  AccessEntry* const access = access_specs_.for_tag(report, tag);
  if (access != nullptr) execute(*access, tag, report);
  if (tag.is_killed()) killed_.push_back(read.tag);
  const bool is_for_access =
      access != nullptr && access->spec.report.value_or(configuration_.access_report) ==
                               AccessReportAt::kEndOfAccessSpec;
  if (is_for_access) {
    ByteWriter encoded;
    write_report(report, running.gathering.spec(), encoded);
    access->results.push_back(encoded.written());
  } else {
    running.gathering.add(report);
  }
  if (access != nullptr) add_pending(access_specs_.end_if_done(*access));
  if (running.gathering.is_full()) report_gathered(running);
}

void LlrpReader::add_access_spec(LiveWorld& /*world*/, const Message& message, ByteWriter& out) {
  access_specs_.add(message, ports_);
  write_ok(out);
}

void LlrpReader::change_access_spec(LiveWorld& /*world*/, const Message& message, ByteWriter& out) {
  add_pending(access_specs_.change(message));
  flush();
  write_ok(out);
}

void LlrpReader::get_access_specs(LiveWorld& /*world*/, const Message& message, ByteWriter& out) {
  ByteReader(message.body).require_end();
  write_ok(out);
  access_specs_.write_all(out);
}

void LlrpReader::report_gathered(Running& running) { add_pending(running.gathering.take()); }

/// Regardless of triggers.
void LlrpReader::report_all() {
  queue_.release_kept(is_nobody_taking());
  if (running_) report_gathered(*running_);
  add_pending(access_specs_.take_results());
}

bool LlrpReader::is_nobody_taking() const { return !line_ || is_holding_; }

void LlrpReader::add_pending(std::vector<Bytes> reports) {
  queue_.add(std::move(reports), is_nobody_taking());
}

void LlrpReader::flush() {
  if (is_nobody_taking()) return;
  while (!queue_.is_empty()) send(kReportMessage, next_id_++, queue_.take_message(), true);
}

}  // namespace tagfield::llrp
