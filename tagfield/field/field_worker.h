// SPDX-License-Identifier: Apache-2.0
/// @file
/// Makes the reads on a thread of its own, so that a driver does not wait for them.
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

/// Where to say what is odd or went wrong; called on the worker's thread.
struct FieldConsole {
  std::function<void(const std::string&)> warn;
  std::function<void(const std::string&)> complain;
};

/// What was done so far.
struct WorkDone {
  double busy_s = 0.0;  ///< CPU time of the thread.
  std::int64_t reads = 0;
};

/// Takes a field's steps in order. Reads don't act back on what moves, so they may come a little
/// later in wall time; their stamps and values don't depend on it. Errors of a step or a listener
/// are complained of, and the next step is taken.
class FieldWorker {
 public:
  FieldWorker(Outlets outlets, FieldConsole console);
  /// Finishes all steps that are waiting.
  ~FieldWorker();
  FieldWorker(const FieldWorker&) = delete;
  FieldWorker& operator=(const FieldWorker&) = delete;

  /// Hands over a step. Waits while too many are waiting already, so that a simulation that runs
  /// faster than its reads can be made is held back and loses none.
  void post(FieldStep step);

  /// Waits for all steps that are waiting; nothing may be posted afterwards.
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
