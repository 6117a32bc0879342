// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/field_worker.h"

#include <algorithm>
#include <ctime>
#include <exception>
#include <utility>

namespace tagfield {
namespace {

constexpr std::size_t kMaxWaiting = 64;

/// CPU time of this thread [s]; wall time would include others' work on a busy machine.
double cpu_time_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// All of the machine's but one, which the driver needs.
int threads_left() {
  return std::max(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1);
}

}  // namespace

FieldWorker::FieldWorker(Outlets outlets, FieldConsole console)
    : field_(std::move(outlets), nullptr, threads_left()),
      console_(std::move(console)),
      thread_([this] { work(); }) {}

FieldWorker::~FieldWorker() { finish(); }

void FieldWorker::finish() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FieldWorker::post(FieldStep step) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMaxWaiting; });
  waiting_.push_back(std::move(step));
  lock.unlock();
  changed_.notify_all();
}

WorkDone FieldWorker::done() const {
  const std::lock_guard lock(mutex_);
  return done_;
}

void FieldWorker::work() {
  while (true) {
    FieldStep step;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
      if (waiting_.empty()) break;
      step = std::move(waiting_.front());
      waiting_.pop_front();
    }
    changed_.notify_all();
    take(step);
  }
  guarded([this] { field_.finish(); });
}

/// No error caused by reads may terminate the simulation.
void FieldWorker::guarded(const std::function<void()>& task) const {
  try {
    task();
  } catch (const std::exception& error) {
    console_.complain(error.what());
  }
}

void FieldWorker::take(const FieldStep& step) {
  const double begin = cpu_time_s();
  guarded([&] { field_.step(step); });
  for (const std::string& warning : field_.take_warnings()) console_.warn(warning);
  const double took = cpu_time_s() - begin;
  const std::lock_guard lock(mutex_);
  done_.busy_s += took;
  done_.reads = field_.reads();
}

}  // namespace tagfield
