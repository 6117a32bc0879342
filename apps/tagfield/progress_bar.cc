// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace tagfield {
namespace {

/// ", 40 s left", ", 5 min left"; empty while that is unknown.
std::string time_left(double so_far_s, double share) {
  constexpr double kToSay = 3.0;  // [s]
  if (so_far_s < kToSay || share <= 0.0) return "";
  const double left_s = so_far_s * (1.0 - share) / share;
  if (left_s < 90.0) return fmt::format(", {:.0f} s left", left_s);
  return left_s < 5400.0 ? fmt::format(", {:.0f} min left", left_s / 60.0)
                         : fmt::format(", {:.1f} h left", left_s / 3600.0);
}

}  // namespace

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_ && !shown_.empty()) fmt::print(stderr, "\r\033[K");
}

/// A line of a log: "tagfield: simulating: 40 %, 30 s left".
void ProgressBar::say(double share, double so_far_s) {
  constexpr double kLong_s = 20.0;
  const int tenths = static_cast<int>(10.0 * share);
  const std::lock_guard lock(mutex_);
  if (so_far_s < kLong_s || tenths <= tenths_ || tenths >= 10) return;
  tenths_ = tenths;
  fmt::print(stderr, "tagfield: {}: {} %{}\n", label_, 10 * tenths, time_left(so_far_s, share));
}

void ProgressBar::show(double share) {
  share = std::clamp(share, 0.0, 1.0);
  const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - begin_;
  if (!on_terminal_) {
    say(share, so_far.count());
    return;
  }
  const int percent = static_cast<int>(100.0 * share);
  constexpr int kWidth = 40;
  const int full = percent * kWidth / 100;
  const std::string text = fmt::format("{} [{:#<{}}{:.<{}}] {:3} %{}", label_, "", full, "",
                                       kWidth - full, percent, time_left(so_far.count(), share));
  const std::lock_guard lock(mutex_);
  if (text == shown_) return;
  shown_ = text;
  fmt::print(stderr, "\r{}\033[K", text);
  std::fflush(stderr);
}

void StageBars::show(const std::string& stage, double share) {
  const std::lock_guard lock(mutex_);
  if (stage != stage_) {
    bar_.emplace(stage);
    stage_ = stage;
  }
  bar_->show(share);
}

}  // namespace tagfield
