// SPDX-License-Identifier: Apache-2.0
/// @file
/// Results of runs in a file that only grows: each is there whole or not at all, whatever ends the
/// program. So it is known afterwards which runs were done, and the rest can go on.
///
/// A line says whose results they are (LogHead), then each line is one run: CRC-32 of what follows
/// in eight hexadecimal digits, "POINT:SEED", "ok" or "failed", CPU seconds, and the body, which is
/// one line of text.
#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "tagfield/base/error.h"

namespace tagfield {

/// Which run it is of those that a suite, or a scenario, asks for.
struct RunKey {
  std::uint64_t point = 0;  ///< Place of the condition in the suite, from 0 on.
  std::uint64_t seed = 0;
  auto operator<=>(const RunKey&) const = default;
};

/// "POINT:SEED".
std::string to_string(const RunKey& key);

/// Whose results a log holds.
struct LogHead {
  std::string program;  ///< Version: results of another are not mixed with these.
  std::string work;     ///< Hash of all that the results follow from (see identity.h).
  bool operator==(const LogHead&) const = default;
};

/// One run's result.
struct LoggedRun {
  RunKey key;
  bool failed = false;    ///< Then `body` says why.
  double cpu_s = 0.0;     ///< That it took.
  std::string_view body;  ///< Without line ends.
};

/// Where a result stands in its file.
struct LogPlace {
  std::uint64_t offset = 0;  ///< Of its line [bytes].
  std::uint64_t length = 0;  ///< Without the line's end.
};

/// What becomes of the results that a log holds already.
enum class LogStart { kGoOn, kAnew };

/// Writes a log. Safe to be used by several threads.
class ResultLog {
 public:
  /// Opens a log to go on with it, or makes it and its folder. A last line that was cut off is
  /// dropped. What was added is written, and on its way to the disk, `save_every_s` later at most,
  /// or when the next result comes if that is later: on file systems that many machines share, few
  /// large writes are what costs least. Throws Error where the file can't be written to, is of
  /// other work (LogHead), or another process is at it.
  ResultLog(const std::string& path, const LogHead& head, double save_every_s = 0.0,
            LogStart start = LogStart::kGoOn);
  ~ResultLog();
  ResultLog(const ResultLog&) = delete;
  ResultLog& operator=(const ResultLog&) = delete;

  /// Bytes of results that were there and went, with LogStart::kAnew.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

  /// Throws Error where the disk is full; what was written before remains whole.
  void add(const LoggedRun& run);
  /// Writes all that was added through to the disk. Throws Error likewise.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void open_and_lock();
  void begin(const LogHead& head, LogStart start);
  void save();

  std::string path_;
  double save_every_s_;
  int file_ = -1;
  std::uint64_t size_ = 0;  ///< Of what is whole in the file.
  std::uint64_t dropped_ = 0;
  std::string waiting_;
  Clock::time_point saved_ = Clock::now();
  std::mutex mutex_;
};

/// Calls `take` for each whole line of a log, in their order. Lines that are damaged are warned of
/// and left out: their runs count as not done. Throws Error where the file can't be read or is of
/// other work.
void read_result_log(const std::string& path, const LogHead& head, Diagnostics& diagnostics,
                     const std::function<void(const LoggedRun&, const LogPlace&)>& take);

/// The result in a line of a log; its text is that of `line`. Throws Error where it is damaged.
LoggedRun logged_run_in(std::string_view line, const Location& location);

}  // namespace tagfield
