/// @file
/// Makes the reads on a thread of its own, so that physics does not wait for them.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tagfield/field/rfid_field.h"

namespace tagfield {

/// What was done so far.
struct WorkDone {
  double busy_s = 0.0;  ///< CPU time.
  std::int64_t reads = 0;
};

/// Takes a field's steps in order. Reads don't act back on physics, so they may come a little later
/// in wall time; their stamps and values don't depend on it.
class FieldWorker {
 public:
  explicit FieldWorker(std::vector<std::unique_ptr<FieldListener>> listeners);
  /// Finishes all steps that are waiting.
  ~FieldWorker();
  FieldWorker(const FieldWorker&) = delete;
  FieldWorker& operator=(const FieldWorker&) = delete;

  /// Hands over a step. Waits while too many are waiting already, so that a simulation that runs
  /// faster than its reads can be made is held back and loses none.
  void post(FieldStep step);

  [[nodiscard]] WorkDone done() const;

 private:
  void work();
  void take(const FieldStep& step);

  RfidField field_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<FieldStep> waiting_;
  WorkDone done_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace tagfield
