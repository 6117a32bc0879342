// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace tagfield {
namespace {

/// ", 40 s left", ", 5 min left"; empty as long as that can't be said.
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

void ProgressBar::show(double share) {
  if (!on_terminal_) return;
  share = std::clamp(share, 0.0, 1.0);
  const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - begin_;
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

}  // namespace tagfield
