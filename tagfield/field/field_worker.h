// SPDX-License-Identifier: Apache-2.0
/// @file
/// Generates the reads on a separate thread, so that a driver doesn't wait for them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "tagfield/field/rfid_field.h"

namespace tagfield {

/// Sinks for warnings and errors; called on the worker's thread.
struct FieldConsole {
  std::function<void(const std::string&)> warn;
  std::function<void(const std::string&)> complain;
};

/// Statistics of the work so far.
struct WorkDone {
  double busy_s = 0.0;  ///< CPU time of its thread, without those that trace paths for it.
  std::int64_t reads = 0;
};

/// Processes a field's steps in order. Reads have no effect on what moves, so they may be generated
/// with a delay in wall time; their stamps and values don't depend on it. If a step or a listener
/// throws, the error is reported and the next step is processed. Paths to many tags are traced on
/// all of the machine's processors but one.
class FieldWorker {
 public:
  FieldWorker(Outlets outlets, FieldConsole console);
  /// Finishes all queued steps.
  ~FieldWorker();
  FieldWorker(const FieldWorker&) = delete;
  FieldWorker& operator=(const FieldWorker&) = delete;

  /// Queues a step. Blocks while the queue is full, so that a simulation that runs faster than its
  /// reads can be generated is slowed down, and no reads are lost.
  void post(FieldStep step);

  /// Waits until all queued steps are finished; nothing may be posted afterwards.
  void finish();

  [[nodiscard]] WorkDone done() const;

 private:
  void work();
  void take(const FieldStep& step);
  void guarded(const std::function<void()>& task) const;

  RfidField field_;
  FieldConsole console_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<FieldStep> waiting_;
  WorkDone done_;
  bool stop_ = false;
  std::jthread thread_;
};

}  // namespace tagfield
