// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/odd_tables.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "tagfield/report/text.h"

namespace tagfield {
namespace {

/// Larger than the ratio between the UHF bands of any two regions.
constexpr double kMaxRatio = 1.2;

void warn_of_order(const std::string& file, std::size_t backwards, std::size_t rows,
                   Diagnostics& diagnostics) {
  if (backwards == 0) return;
  diagnostics.warn(
      {file, 0},
      fmt::format(
          "{} of {} rows have an earlier stamp_s than the row before them: they are sorted by time",
          backwards, rows));
}

}  // namespace

void warn_of_odd_reads(const std::string& file, const ReadOverview& reads,
                       Diagnostics& diagnostics) {
  warn_of_order(file, reads.backwards, reads.count, diagnostics);
  const std::set<double>& carriers = reads.carriers_hz;
  if (carriers.empty() || *carriers.rbegin() <= kMaxRatio * *carriers.begin()) return;
  diagnostics.warn({file, 0},
                   fmt::format("frequency_hz goes from {:g} to {:g}: is all of it in Hz?",
                               *carriers.begin(), *carriers.rbegin()));
}

void warn_of_odd_poses(const std::string& file, const std::vector<AntennaPose>& poses,
                       Diagnostics& diagnostics) {
  std::map<std::string, Time> last;
  std::size_t backwards = 0;
  for (const AntennaPose& pose : poses) {
    const auto [entry, is_first] = last.try_emplace(pose.antenna, pose.stamp);
    if (!is_first && pose.stamp < entry->second) ++backwards;
    entry->second = pose.stamp;
  }
  warn_of_order(file, backwards, poses.size(), diagnostics);
}

std::string summary_of_reads(const ReadOverview& reads) {
  std::string text =
      fmt::format("{} of {} by {}", counted(reads.count, "read"), counted(reads.tags.size(), "tag"),
                  counted(reads.last_by_antenna.size(), "antenna"));
  const std::set<double>& carriers = reads.carriers_hz;
  if (carriers.size() < 2) return text;
  return text + fmt::format(" on {} carriers from {:g} to {:g} MHz", carriers.size(),
                            1e-6 * *carriers.begin(), 1e-6 * *carriers.rbegin());
}

}  // namespace tagfield
