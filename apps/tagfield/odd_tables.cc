// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/odd_tables.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "tagfield/report/text.h"

namespace tagfield {
namespace {

/// The UHF bands of all regions lie closer together than this.
constexpr double kMostRatio = 1.2;

/// Rows earlier than the one before of the same antenna.
template <typename Row>
std::size_t count_backwards(const std::vector<Row>& rows) {
  std::map<std::string, Time> last;
  std::size_t count = 0;
  for (const Row& row : rows) {
    const auto [entry, is_first] = last.try_emplace(row.antenna, row.stamp);
    if (!is_first && row.stamp < entry->second) ++count;
    entry->second = row.stamp;
  }
  return count;
}

template <typename Row>
void warn_of_order(const std::string& file, const std::vector<Row>& rows,
                   Diagnostics& diagnostics) {
  const std::size_t count = count_backwards(rows);
  if (count == 0) return;
  diagnostics.warn({file, 0},
                   fmt::format("{} of {} rows have an earlier stamp_s than the row before them: "
                               "they are put in order of time",
                               count, rows.size()));
}

std::set<double> carriers_of(const std::vector<TagRead>& reads) {
  std::set<double> carriers;
  for (const TagRead& read : reads) carriers.insert(read.frequency_hz);
  return carriers;
}

}  // namespace

void warn_of_odd_reads(const std::string& file, const std::vector<TagRead>& reads,
                       Diagnostics& diagnostics) {
  warn_of_order(file, reads, diagnostics);
  const std::set<double> carriers = carriers_of(reads);
  if (carriers.empty() || *carriers.rbegin() <= kMostRatio * *carriers.begin()) return;
  diagnostics.warn({file, 0},
                   fmt::format("frequency_hz goes from {:g} to {:g}: is all of it in Hz?",
                               *carriers.begin(), *carriers.rbegin()));
}

void warn_of_odd_poses(const std::string& file, const std::vector<AntennaPose>& poses,
                       Diagnostics& diagnostics) {
  warn_of_order(file, poses, diagnostics);
}

std::string told_of_reads(const std::vector<TagRead>& reads) {
  std::set<std::string> tags;
  std::set<std::string> antennas;
  for (const TagRead& read : reads) {
    tags.insert(read.tag);
    antennas.insert(read.antenna);
  }
  std::string text = fmt::format("{} of {} by {}", counted(reads.size(), "read"),
                                 counted(tags.size(), "tag"), counted(antennas.size(), "antenna"));
  const std::set<double> carriers = carriers_of(reads);
  if (carriers.size() < 2) return text;
  return text + fmt::format(" on {} carriers from {:g} to {:g} MHz", carriers.size(),
                            1e-6 * *carriers.begin(), 1e-6 * *carriers.rbegin());
}

}  // namespace tagfield
