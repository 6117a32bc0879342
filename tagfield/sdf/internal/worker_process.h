// SPDX-License-Identifier: Apache-2.0
/// @file
/// Work that may go wrong in a library: done by a process of its own, so that nothing but it is
/// lost.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace tagfield {

/// What one piece of work may take.
struct WorkLimits {
  unsigned seconds = 2;                      ///< Of processor time.
  std::uint64_t memory_bytes = 256'000'000;  ///< Beyond what there is already.
};

/// A copy of this process that answers requests, one at a time. It begins with the first one, and
/// again with the next where it broke down.
class WorkerProcess {
 public:
  explicit WorkerProcess(std::function<std::string(const std::string&)> work)
      : work_(std::move(work)) {}
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// What the work makes of `request`. Throws Error with the message of what it throws; or, where
  /// the process ends instead, with one that begins with `what` and says how.
  std::string ask(const std::string& what, const WorkLimits& limits, const std::string& request);

 private:
  void start(const std::string& what);
  void close_pipes() const;
  [[noreturn]] void answer_all(int requests, int answers) const;
  [[nodiscard]] std::string how_it_ended(const WorkLimits& limits);

  std::function<std::string(const std::string&)> work_;
  pid_t child_ = -1;
  int requests_ = -1;  ///< Where they are written to.
  int answers_ = -1;
};

}  // namespace tagfield
