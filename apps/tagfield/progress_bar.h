// SPDX-License-Identifier: Apache-2.0
/// @file
/// A progress bar on a terminal, lines of progress in a log.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tagfield {

/// If standard error is a terminal, shows there the share that is done and, after some seconds, an
/// estimate of the remaining time at that rate. Disappears when it goes out of scope. If it is not
/// a terminal, as in a log, work of over three seconds prints a line then, and one per tenth.
class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;

  /// `begin` is that of the whole work, of which this can be a later stage.
  explicit ProgressBar(std::string label, Clock::time_point begin = Clock::now());
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows `share`, 0 to 1. May be called often, and from any thread.
  void show(double share);

 private:
  void wait_and_say();
  void say();
  [[nodiscard]] double seconds() const;

  std::string label_;
  bool on_terminal_;
  Clock::time_point begin_of_work_;
  Clock::time_point begin_ = Clock::now();
  std::string shown_;
  double share_ = 0.0;
  int tenths_ = -1;  ///< Tenths already printed to a log; -1 before the first line.
  bool is_over_ = false;
  std::condition_variable over_;
  std::mutex mutex_;
  std::thread waiter_;  ///< Names work in a log that calls show() late.
};

/// A sequence of bars, one per stage of the work.
class StageBars {
 public:
  /// May be called often, and from any thread.
  void show(const std::string& stage, double share);

 private:
  ProgressBar::Clock::time_point begin_ = ProgressBar::Clock::now();
  std::mutex mutex_;
  std::string stage_;
  std::optional<ProgressBar> bar_;
};

}  // namespace tagfield
