// SPDX-License-Identifier: Apache-2.0
/// @file
/// A progress bar on a terminal.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

namespace tagfield {

/// If standard error is a terminal, shows there the share that is done and, after some seconds, an
/// estimate of the remaining time at that rate. Disappears when it goes out of scope. If it is not
/// a terminal, as in a log, work of over twenty seconds prints a line per tenth.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows `share`, 0 to 1. May be called often, and from any thread.
  void show(double share);

 private:
  std::string label_;
  bool on_terminal_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  void say(double share, double so_far_s);

  std::string shown_;
  int tenths_ = 0;  ///< Tenths already printed to a log.
  std::mutex mutex_;
};

/// A sequence of bars, one per stage of the work.
class StageBars {
 public:
  /// May be called often, and from any thread.
  void show(const std::string& stage, double share);

 private:
  std::mutex mutex_;
  std::string stage_;
  std::optional<ProgressBar> bar_;
};

}  // namespace tagfield
