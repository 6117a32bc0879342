// SPDX-License-Identifier: Apache-2.0
/// @file
/// Work that may crash in a library: done in a separate process, so that only that process is lost.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace tagfield {

/// Resource limits for one request.
struct WorkLimits {
  unsigned seconds = 2;                      ///< CPU time.
  std::uint64_t memory_bytes = 256'000'000;  ///< In addition to the memory already in use.
};

/// A copy of this process that answers requests, one at a time. It is started by the first request,
/// and restarted by the next one after a crash.
class WorkerProcess {
 public:
  explicit WorkerProcess(std::function<std::string(const std::string&)> work)
      : work_(std::move(work)) {}
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// The result of the work for `request`. If the work throws, throws Error with that message; if
  /// the process terminates instead, throws Error with a message that begins with `what` and says
  /// how it ended.
  std::string ask(const std::string& what, const WorkLimits& limits, const std::string& request);

 private:
  void start(const std::string& what);
  void close_pipes() const;
  [[noreturn]] void answer_all(int requests, int answers) const;
  [[nodiscard]] std::string how_it_ended(const WorkLimits& limits);

  std::function<std::string(const std::string&)> work_;
  pid_t child_ = -1;
  int requests_ = -1;  ///< File descriptor that requests are written to.
  int answers_ = -1;
};

}  // namespace tagfield
