#include "apps/tagfield/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace tagfield {

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_ && shown_percent_ >= 0) fmt::print(stderr, "\r\033[K");
}

void ProgressBar::show(double share) {
  if (!on_terminal_) return;
  const int percent = static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0));
  const std::lock_guard lock(mutex_);
  if (percent == shown_percent_) return;
  shown_percent_ = percent;
  constexpr int kWidth = 40;
  const int full = percent * kWidth / 100;
  fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3} %", label_, "", full, "", kWidth - full, percent);
  std::fflush(stderr);
}

}  // namespace tagfield
