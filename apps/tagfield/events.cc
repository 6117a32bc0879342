// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>

#include "adapters/bags/bag_recording.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/middleware_arguments.h"
#include "apps/tagfield/output_file.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/start_time.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/base/utc.h"
#include "tagfield/events/epcis.h"
#include "tagfield/events/event_json.h"
#include "tagfield/events/event_stage.h"
#include "tagfield/events/events_yaml.h"
#include "tagfield/files/files.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/report/summary.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

struct EventsArguments {
  std::string recording;
  std::string spec;
  std::string epcis;
  CaptureArguments capture;
  std::string start;
  bool json = false;
  bool force = false;
};

std::vector<TagRead> reads_in_bag(const std::string& path, Diagnostics& diagnostics) {
  ProgressBar bar("reading");
  BagOptions options;
  options.on_progress = [&bar](double share) { bar.show(share); };
  return read_bag(path, options, diagnostics).reads;
}

/// Reads from a table, or from the one in a run's folder.
std::vector<TagRead> reads_in_table(const std::string& path) {
  const bool of_run = is_folder(path);
  const fs::path file = of_run ? fs::path(path) / "reads.csv" : fs::path(path);
  if (of_run) finish_commit(path);
  ProgressBar bar("reading");
  return read_reads_csv(file.string(), [&bar](double share) { bar.show(share); });
}

std::vector<TagRead> reads_of(const EventsArguments& arguments, Diagnostics& diagnostics) {
  std::vector<TagRead> reads = is_bag(arguments.recording)
                                   ? reads_in_bag(arguments.recording, diagnostics)
                                   : reads_in_table(arguments.recording);
  std::stable_sort(reads.begin(), reads.end(),
                   [](const TagRead& a, const TagRead& b) { return a.stamp < b.stamp; });
  if (reads.empty()) diagnostics.warn({arguments.recording, 0}, "no reads: there are no events");
  return reads;
}

/// When the recording ends: a run's folder says how long it was simulated, otherwise with the last
/// read.
Time end_of(const std::string& recording, Time last_read) {
  const fs::path summary = fs::path(recording) / "summary.json";
  if (!is_folder(recording) || !is_file(summary)) return last_read;
  const double simulated_s =
      summary_from_json(read_text_file(summary.string()), summary.string()).simulated_s;
  return std::max(last_read, time_from_seconds(simulated_s));
}

/// Events as a human-readable table.
class EventTable final : public EventListener {
 public:
  void on_presence(const PresenceEvent& event) override {
    if (event.change == PresenceChange::kObserved) ++observed_;
    if (event.change != PresenceChange::kGone) return;
    ++gone_;
    add(event, fmt::format("gone at {:.3f} s", to_seconds(event.stamp)));
  }
  void on_cycle(const CycleReports& reports) override {
    cycles_ +=
        fmt::format("{} {}, {:.3f} to {:.3f} s ({})\n", reports.cycle, reports.number,
                    to_seconds(reports.begin), to_seconds(reports.end), to_string(reports.why));
    for (const CycleReport& report : reports.reports) add(report);
    ++reported_cycles_;
  }
  void add_present(const std::vector<PresenceEvent>& present) {
    for (const PresenceEvent& event : present) add(event, "still there");
  }
  [[nodiscard]] std::string text() const {
    std::string all;
    if (observed_ > 0) {
      all = fmt::format("{:<16} {:<28} {:>12} {:>12} {:>7} {:>9}\n{}", "logical reader", "tag",
                        "first read", "last read", "reads", "max. RSSI", visits_);
    }
    all += cycles_;
    return all + fmt::format("{} times observed, {} times gone, {} cycles reported\n", observed_,
                             gone_, reported_cycles_);
  }

 private:
  void add(const PresenceEvent& event, const std::string& how) {
    visits_ += fmt::format("{:<16} {:<28} {:>10.3f} s {:>10.3f} s {:>7} {:>5.1f} dBm  {}\n",
                           event.logical_reader, event.tag, to_seconds(event.first_read),
                           to_seconds(event.last_read), event.reads, event.max_rssi_dbm, how);
  }
  void add(const CycleReport& report) {
    for (const ReportGroup& group : report.groups) {
      cycles_ +=
          fmt::format("  {}{}: {}: {}\n", report.name, group.name.empty() ? "" : ' ' + group.name,
                      group.tags.size(), fmt::join(group.tags, ", "));
    }
    if (report.groups.empty()) cycles_ += fmt::format("  {}: 0\n", report.name);
  }

  std::string visits_;
  std::string cycles_;
  std::size_t observed_ = 0;
  std::size_t gone_ = 0;
  std::size_t reported_cycles_ = 0;
};

/// EPCIS to a file: one document, or, if it is named ….jsonl, one event per line.
class EpcisFile {
 public:
  EpcisFile(std::string path, const EventsSpec& spec, Time start)
      : path_(std::move(path)),
        has_lines_(fs::path(path_).extension() == ".jsonl"),
        listener_(std::make_shared<EpcisEvents>(
            spec, start, has_lines_,
            [this](const std::string& event) { events_.push_back(event); })) {}

  [[nodiscard]] const std::shared_ptr<EpcisEvents>& listener() const { return listener_; }
  [[nodiscard]] std::size_t count() const { return events_.size(); }
  void write(Time created) const {
    std::string text;
    for (const std::string& event : events_) text += event + '\n';
    catch_interrupts();  // The rest takes only a moment, and no incomplete files remain.
    write_text_file(path_, has_lines_ ? text : epcis_document(events_, created));
  }

 private:
  std::string path_;
  bool has_lines_;
  std::vector<std::string> events_;
  std::shared_ptr<EpcisEvents> listener_;
};

/// Posts events to the requested repository.
class Capture {
 public:
  Capture(CaptureArguments arguments, const EventsSpec& spec, Time start) {
    arguments.buffer = std::numeric_limits<std::size_t>::max();  // Limited by the input.
    client_ = capture_client(arguments);
    if (!client_) return;
    listener_ = std::make_shared<EpcisEvents>(
        spec, start, false, [this](const std::string& event) { client_->capture(event); });
  }

  void attach_to(std::vector<std::shared_ptr<EventListener>>& listeners) const {
    if (listener_) listeners.push_back(listener_);
  }
  /// Throws Error if the repository has not accepted all events.
  void finish() const {
    if (!client_) return;
    client_->finish(kPatience, {});
    const CaptureCounts counts = client_->counts();
    if (counts.captured == counts.taken) return;
    throw Error(fmt::format("{}: captured {} of {} events", client_->name(), counts.captured,
                            counts.taken));
  }
  [[nodiscard]] std::string text() const {
    if (!client_) return "";
    return fmt::format("EPCIS: {} events captured\n", client_->counts().captured);
  }

 private:
  /// Longer than the time limit of a request.
  static constexpr std::chrono::milliseconds kPatience{35'000};
  std::shared_ptr<CaptureClient> client_;
  std::shared_ptr<EpcisEvents> listener_;
};

int events(const EventsArguments& arguments) {
  require_replaceable(
      {"--epcis", arguments.epcis, "a file of EPCIS", {"\"EPCISDocument\"", "\"ObjectEvent\""}},
      {arguments.recording, arguments.spec}, arguments.force);
  Diagnostics diagnostics;
  const EventsSpec spec = arguments.spec.empty() ? EventsSpec{} : read_events_spec(arguments.spec);
  const std::vector<TagRead> reads = reads_of(arguments, diagnostics);
  const Time first = reads.empty() ? Time{} : reads.front().stamp;
  const Time last = reads.empty() ? Time{} : end_of(arguments.recording, reads.back().stamp);
  const Time start = start_time("events", arguments.start, first);
  const auto table = std::make_shared<EventTable>();
  std::vector<std::shared_ptr<EventListener>> listeners = {table};
  if (arguments.json) {
    listeners.push_back(std::make_shared<EventJson>(
        start, [](const std::string& line) { std::fwrite(line.data(), 1, line.size(), stdout); }));
  }
  std::unique_ptr<EpcisFile> epcis;
  if (!arguments.epcis.empty()) {
    epcis = std::make_unique<EpcisFile>(arguments.epcis, spec, start);
    listeners.push_back(epcis->listener());
  }
  const Capture capture(arguments.capture, spec, start);
  capture.attach_to(listeners);
  EventStage stage(spec, listeners);
  for (const TagRead& read : reads) stage.on_read(read);
  stage.finish(last);
  table->add_present(stage.present());
  for (const std::string& name : stage.unheard()) {
    diagnostics.warn(Location{arguments.spec, 0}, "nothing was read by " + name);
  }
  print_warnings(diagnostics);
  if (epcis) epcis->write(start + last.time_since_epoch());
  capture.finish();
  if (arguments.json) return kExitOk;
  fmt::print("{}", table->text());
  if (epcis) fmt::print("EPCIS: {} events in {}\n", epcis->count(), arguments.epcis);
  fmt::print("{}", capture.text());
  return kExitOk;
}

}  // namespace

void add_events_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<EventsArguments>();
  CLI::App* command = app.add_subcommand(
      "events",
      "Turn reads into events as middleware does: tags that came and went, reports, EPCIS");
  command
      ->add_option("READS", arguments->recording,
                   "CSV: stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm; the folder of "
                   "a run; or a bag (.bag, .mcap, .db3)")
      ->required();
  command->add_option("--spec", arguments->spec,
                      "File (YAML) with a section 'events': logical readers, presence, cycles, "
                      "EPCIS (docs/events.md)");
  command->add_option("--epcis", arguments->epcis,
                      "Write ObjectEvents of EPCIS 2.0 (JSON-LD) into this file: one document, or "
                      "an event on each line if its name ends in .jsonl");
  add_force_option(*command, arguments->force);
  add_capture_options(*command, arguments->capture);
  add_start_option(*command, arguments->start);
  add_json_option(*command, arguments->json, "a line for each event");
  command->footer(
      "Without --spec each reader is one location, a tag is there from its first read on, and "
      "gone\n"
      "after 2 s without any. For example, what a dock door reports every 5 s:\n"
      "  events:\n"
      "    logical_readers: [{name: door, antennas: [left, right], biz_step: receiving}]\n"
      "    presence: {reads: 3, within_s: 1, gone_after_s: 5}\n"
      "    cycles:\n"
      "      - {name: every 5 s, duration_s: 5, reports: [{set: additions}, {set: deletions}]}");
  command->callback([arguments, &chosen] { chosen = [arguments] { return events(*arguments); }; });
}

}  // namespace tagfield
