// SPDX-License-Identifier: Apache-2.0
/// @file
/// A progress bar on a terminal.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace tagfield {

/// Draws on standard error, and only if that is a terminal: the share that is done and, after some
/// seconds, about how long the rest takes at that rate. Vanishes when it goes out of scope.
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
  std::string shown_;
  std::mutex mutex_;
};

}  // namespace tagfield
