#include "adapters/gazebo_classic/field_worker.h"

#include <ctime>
#include <gazebo/common/Console.hh>
#include <utility>

namespace tagfield {
namespace {

constexpr std::size_t kMostWaiting = 64;

/// CPU time of this thread [s]: wall time would count others' work on a busy machine.
double cpu_time_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

FieldWorker::FieldWorker(std::vector<std::unique_ptr<FieldListener>> listeners)
    : field_(std::move(listeners)), thread_([this] { work(); }) {}

FieldWorker::~FieldWorker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FieldWorker::post(FieldStep step) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting; });
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
      if (waiting_.empty()) return;
      step = std::move(waiting_.front());
      waiting_.pop_front();
    }
    changed_.notify_all();
    take(step);
  }
}

void FieldWorker::take(const FieldStep& step) {
  const double begin = cpu_time_s();
  try {
    field_.step(step);
    for (const std::string& warning : field_.take_warnings()) {
      gzwarn << "Tagfield: " << warning << "\n";
    }
  } catch (const std::exception& error) {
    // Nothing that comes of reads may end the simulation.
    gzerr << "Tagfield: " << error.what() << "\n";
  }
  const double took = cpu_time_s() - begin;
  const std::lock_guard lock(mutex_);
  done_.busy_s += took;
  done_.reads = field_.reads();
}

}  // namespace tagfield
