// SPDX-License-Identifier: Apache-2.0
/// @file
/// Results of runs in an append-only file: each is stored completely or not at all, however the
/// program ends. So it is known afterwards which runs are done, and the rest can be resumed.
///
/// The first line identifies the work (LogHead), then each line is one run: CRC-32 of what follows
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

/// Identifies a run among those of a suite or a scenario.
struct RunKey {
  std::uint64_t point = 0;  ///< Index of the condition in the suite, from 0.
  std::uint64_t seed = 0;
  auto operator<=>(const RunKey&) const = default;
};

/// "POINT:SEED".
std::string to_string(const RunKey& key);

/// Identifies the work that a log has results of.
struct LogHead {
  std::string program;  ///< Version: results of different versions are not mixed.
  std::string work;     ///< Hash of everything that the results depend on (see work_hash.h).
  bool operator==(const LogHead&) const = default;
};

/// One run's result.
struct LoggedRun {
  RunKey key;
  bool failed = false;    ///< If so, `body` is the reason.
  double cpu_s = 0.0;     ///< CPU time it took.
  std::string_view body;  ///< Without line breaks.
};

/// Position of a result in its file.
struct LogLocation {
  std::uint64_t offset = 0;  ///< Of its line [bytes].
  std::uint64_t length = 0;  ///< Without the line break.
};

/// Whether to keep or drop the results that are already in a log.
enum class LogStart { kGoOn, kAnew };

/// Writes a log. Thread-safe.
class ResultLog {
 public:
  /// Opens a log to append to it, or creates it and its folder. A truncated last line is dropped.
  /// Added results are buffered: they are written and flushed towards the disk `save_every_s` after
  /// the last write, or with the next result if that is later. On file systems shared by many
  /// machines a few large writes are the cheapest. Throws Error if the file can't be written, is of
  /// other work (LogHead), or is locked by another process.
  ResultLog(const std::string& path, const LogHead& head, double save_every_s = 0.0,
            LogStart start = LogStart::kGoOn);
  ~ResultLog();
  ResultLog(const ResultLog&) = delete;
  ResultLog& operator=(const ResultLog&) = delete;

  /// Bytes of earlier results that were dropped, with LogStart::kAnew.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

  /// Adds a result. Throws Error if the disk is full; what was written before remains intact.
  void add(const LoggedRun& run);
  /// Writes everything that was added to the disk. Throws Error as add() does.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void open_and_lock();
  void begin(const LogHead& head, LogStart start);
  void save();

  std::string path_;
  double save_every_s_;
  int file_ = -1;
  std::uint64_t size_ = 0;  ///< Of the complete lines in the file.
  std::uint64_t dropped_ = 0;
  std::string waiting_;
  Clock::time_point saved_ = Clock::now();
  std::mutex mutex_;
};

/// Calls `take` for each complete line of a log, in order. Damaged lines are skipped with a
/// warning: their runs count as not done. Throws Error if the file can't be read or is of other
/// work.
void read_result_log(const std::string& path, const LogHead& head, Diagnostics& diagnostics,
                     const std::function<void(const LoggedRun&, const LogLocation&)>& take);

/// The result in a line of a log; its `body` refers to the text of `line`. Throws Error if the line
/// is damaged.
LoggedRun logged_run_in(std::string_view line, const Location& location);

}  // namespace tagfield
