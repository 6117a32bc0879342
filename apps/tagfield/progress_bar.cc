// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/progress_bar.h"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>

namespace tagfield {
namespace {

/// Shorter work says nothing in a log.
constexpr std::chrono::seconds kLong{3};

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

ProgressBar::ProgressBar(std::string label, Clock::time_point begin)
    : label_(std::move(label)), on_terminal_(isatty(STDERR_FILENO) == 1), begin_of_work_(begin) {
  if (on_terminal_) return;
  // Signals are for the threads that work.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    waiter_ = std::thread([this] { wait_and_say(); });
  } catch (const std::exception&) {
    // Without another thread the first line waits for show().
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ProgressBar::~ProgressBar() {
  if (on_terminal_ && !shown_.empty()) fmt::print(stderr, "\r\033[K");
  if (!waiter_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_all();
  waiter_.join();
}

double ProgressBar::seconds() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

/// Names the work in a log as soon as it turns out to be long.
void ProgressBar::wait_and_say() {
  std::unique_lock lock(mutex_);
  if (over_.wait_until(lock, begin_of_work_ + kLong, [this] { return is_over_; })) return;
  say();
}

/// A line of a log: "tagfield: simulating: 40 %, 30 s left". The mutex is locked.
void ProgressBar::say() {
  const int tenths = static_cast<int>(10.0 * share_);
  if (Clock::now() - begin_of_work_ < kLong || tenths <= tenths_ || tenths >= 10) return;
  tenths_ = tenths;
  fmt::print(stderr, "tagfield: {}: {} %{}\n", label_, 10 * tenths, time_left(seconds(), share_));
}

void ProgressBar::show(double share) {
  share = std::clamp(share, 0.0, 1.0);
  if (!on_terminal_) {
    const std::lock_guard lock(mutex_);
    share_ = share;
    say();
    return;
  }
  const int percent = static_cast<int>(100.0 * share);
  constexpr int kWidth = 40;
  const int full = percent * kWidth / 100;
  const std::string text = fmt::format("{} [{:#<{}}{:.<{}}] {:3} %{}", label_, "", full, "",
                                       kWidth - full, percent, time_left(seconds(), share));
  const std::lock_guard lock(mutex_);
  if (text == shown_) return;
  shown_ = text;
  fmt::print(stderr, "\r{}\033[K", text);
  std::fflush(stderr);
}

void StageBars::show(const std::string& stage, double share) {
  const std::lock_guard lock(mutex_);
  if (stage != stage_) {
    bar_.emplace(stage, begin_);
    stage_ = stage;
  }
  bar_->show(share);
}

}  // namespace tagfield
