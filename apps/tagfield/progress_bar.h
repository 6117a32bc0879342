// SPDX-License-Identifier: Apache-2.0
/// @file
/// A progress bar on a terminal.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

namespace tagfield {

/// Draws on standard error, if that is a terminal: the share that is done and, after some seconds,
/// about how long the rest takes at that rate. Vanishes when it goes out of scope. Where it is
/// none, as in a log, work of over twenty seconds says a line a tenth.
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
  int tenths_ = 0;  ///< That a log has.
  std::mutex mutex_;
};

/// Bars one after the other, as work goes from one stage to the next; each stage takes up one.
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
