// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/store/run_store.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace tagfield {
namespace {

constexpr double kStoreEvery_s = 1.0;

LogStart start_of(Resume resume) {
  return resume == Resume::kYes ? LogStart::kGoOn : LogStart::kAnew;
}

}  // namespace

RunStore::RunStore(std::string path, const LogHead& head, Resume resume, Diagnostics& diagnostics)
    : path_(std::move(path)), log_(path_, head, kStoreEvery_s, start_of(resume)) {
  if (log_.dropped() > 0) {
    diagnostics.warn({path_, 0}, fmt::format("held {} bytes of runs that were cut off, which are "
                                             "dropped: --resume would have continued them",
                                             log_.dropped()));
  }
  if (resume == Resume::kNo) return;
  read_result_log(path_, head, diagnostics, [&](const LoggedRun& run, const LogLocation&) {
    if (!run.failed) earlier_[run.key] = std::string(run.body);
  });
}

const std::string* RunStore::find(const RunKey& key) const {
  const auto found = earlier_.find(key);
  return found == earlier_.end() ? nullptr : &found->second;
}

void RunStore::add(const RunKey& key, const std::string& body) {
  log_.add({key, false, 0.0, body});
}

void RunStore::drop() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace tagfield
