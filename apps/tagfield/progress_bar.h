/// @file
/// A progress bar on a terminal.
#pragma once

#include <functional>
#include <mutex>
#include <string>

namespace tagfield {

/// Draws on standard error, and only if that is a terminal. Vanishes when it goes out of scope.
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
  int shown_percent_ = -1;
  std::mutex mutex_;
};

}  // namespace tagfield
