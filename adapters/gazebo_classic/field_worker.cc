#include "adapters/gazebo_classic/field_worker.h"

#include <chrono>
#include <gazebo/common/Console.hh>
#include <utility>

namespace tagfield {
namespace {

constexpr std::size_t kMostWaiting = 64;

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
  const auto begin = std::chrono::steady_clock::now();
  try {
    field_.step(step);
  } catch (const std::exception& error) {
    // Nothing that comes of reads may end the simulation.
    gzerr << "Tagfield: " << error.what() << "\n";
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const std::lock_guard lock(mutex_);
  done_.busy_s += took.count();
  done_.reads = field_.reads();
}

}  // namespace tagfield
