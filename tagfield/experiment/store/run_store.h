// SPDX-License-Identifier: Apache-2.0
/// @file
/// The runs of a bench or of many seeds that are done, kept in a log until all are: so that one
/// that was cut off, whatever by, goes on where it was.
#pragma once

#include <map>
#include <string>

#include "tagfield/base/error.h"
#include "tagfield/experiment/store/result_log.h"

namespace tagfield {

/// Whether runs that were done earlier count.
enum class Resume { kNo, kYes };

/// The log's name in a folder of results, which keeps it (StagedFolder::keep()).
inline constexpr const char* kResumeLog = "resume.log";

/// Safe to be used by several threads, but for drop().
class RunStore {
 public:
  /// Opens or makes the log at `path`. With Resume::kYes what is in it counts; else it is emptied,
  /// which `diagnostics` warns of where it held runs. Throws Error as ResultLog does: with kYes
  /// also where it is of other work.
  RunStore(std::string path, const LogHead& head, Resume resume, Diagnostics& diagnostics);

  /// What a run came to earlier; null where it is to be done.
  [[nodiscard]] const std::string* find(const RunKey& key) const;
  [[nodiscard]] std::size_t found() const { return earlier_.size(); }
  [[nodiscard]] Location location() const { return {path_, 0}; }

  /// Keeps what a run came to, a line of text.
  void add(const RunKey& key, const std::string& body);

  /// Deletes the log: all is done, and written elsewhere.
  void drop();

 private:
  std::string path_;
  std::map<RunKey, std::string> earlier_;
  ResultLog log_;
};

}  // namespace tagfield
