// SPDX-License-Identifier: Apache-2.0
/// @file
/// The finished runs of a bench or of many seeds, kept in a log until all are done, so that an
/// interrupted one can be resumed.
#pragma once

#include <map>
#include <string>

#include "tagfield/base/error.h"
#include "tagfield/experiment/store/result_log.h"

namespace tagfield {

/// Whether to reuse runs that were done earlier.
enum class Resume { kNo, kYes };

/// The log's name in a results folder, which keeps it (StagedFolder::keep()).
inline constexpr const char* kResumeLog = "resume.log";

/// Thread-safe, except for drop().
class RunStore {
 public:
  /// Opens or creates the log at `path`. With Resume::kYes its runs are reused; otherwise it is
  /// emptied, with a warning if it had runs. Throws Error as ResultLog does; with kYes also if the
  /// log is of other work.
  RunStore(std::string path, const LogHead& head, Resume resume, Diagnostics& diagnostics);

  /// The earlier result of a run; null if it is still to be done.
  [[nodiscard]] const std::string* find(const RunKey& key) const;
  [[nodiscard]] std::size_t found() const { return earlier_.size(); }
  [[nodiscard]] Location location() const { return {path_, 0}; }

  /// Stores the result of a run, a line of text.
  void add(const RunKey& key, const std::string& body);

  /// Deletes the log, once all runs are done and their results written elsewhere.
  void drop();

 private:
  std::string path_;
  std::map<RunKey, std::string> earlier_;
  ResultLog log_;
};

}  // namespace tagfield
