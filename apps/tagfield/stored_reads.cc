// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/stored_reads.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "apps/tagfield/progress_bar.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

/// The innermost existing folder on the path to `out`.
fs::path existing_folder(const std::string& out) {
  fs::path folder = fs::absolute(out);
  std::error_code ignored;
  while (folder.has_relative_path() && !fs::is_directory(folder, ignored)) {
    folder = folder.parent_path();
  }
  return folder;
}

void warn_of_thinned_tags(const StoredReads& reads, Diagnostics& diagnostics) {
  std::size_t tags = 0;
  std::size_t most = 0;
  for (const auto& [tag, count] : reads.source.overview.count_by_tag) {
    if (count > reads.most_of_a_tag) ++tags;
    most = std::max(most, count);
  }
  if (tags == 0) return;
  diagnostics.warn({reads.source.file, 0},
                   fmt::format("{} {} over {} reads, up to {}: only every second, third, … is "
                               "used, so that those of one tag fit in memory (--part-reads)",
                               counted(tags, "tag"), tags == 1 ? "has" : "have",
                               grouped(reads.most_of_a_tag), grouped(most)));
}

}  // namespace

void add_part_option(CLI::App& command, std::optional<std::size_t>& part_reads) {
  command
      .add_option("--part-reads", part_reads,
                  "Process tags in parts of about this many reads, and keep the others on disk; 0: "
                  "all at once, in memory. Default: 250000 for CSV of over 400 MB and recordings "
                  "of over five million reads, else 0")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000'000}));
}

std::optional<std::size_t> part_of_table(const std::string& table,
                                         std::optional<std::size_t> part_reads) {
  if (part_reads == std::size_t{0}) return std::nullopt;
  std::error_code unknown;
  const bool is_file = fs::is_regular_file(table, unknown);
  if (part_reads && fs::exists(table, unknown) && !is_file) {
    fail({table, 0}, "can't be read twice, as --part-reads requires: expected a file");
  }
  if (part_reads) return part_reads;
  const std::uintmax_t size = is_file ? fs::file_size(table, unknown) : std::uintmax_t{0};
  if (unknown || size < kLargeTable) return std::nullopt;
  return kReadsOfPart;
}

bool is_read_anew(const std::string& table) {
  std::error_code unknown;
  if (!fs::is_regular_file(table, unknown)) return false;
  const std::uintmax_t size = fs::file_size(table, unknown);
  return !unknown && size >= kTableToReadAnew;
}

ReadSource reads_of_table(const std::string& table, Diagnostics& diagnostics) {
  ReadSource source;
  source.file = table;
  ProgressBar bar("reading");
  for_each_read(
      table, [&](const TagRead& read) { add(read, source.overview); },
      [&](double share) { bar.show(share); }, &diagnostics);
  source.for_each = [table, at_first = source.overview.count](
                        const std::function<void(const TagRead&)>& take,
                        const std::function<void(double)>& on_progress) {
    std::size_t again = 0;
    for_each_read(
        table,
        [&](const TagRead& read) {
          ++again;
          take(read);
        },
        on_progress);
    if (again == at_first) return;
    fail({table, 0}, fmt::format("had {} reads at first and {} when they were read again: expected "
                                 "a file that does not change",
                                 at_first, again));
  };
  return source;
}

ReadSource reads_of_bag(const std::string& bag, const UnreportedReads& unreported) {
  return {bag, unreported.overview,
          [tell = unreported.tell](const std::function<void(const TagRead&)>& take,
                                   const std::function<void(double)>& on_progress) {
            tell({take, {}, on_progress});
          }};
}

StoredReads store_reads(ReadSource source, const std::string& out, std::size_t part_reads,
                        const std::set<std::string>& everywhere, Diagnostics& diagnostics) {
  StoredReads reads;
  reads.source = std::move(source);
  reads.most_of_a_tag = part_reads;
  reads.store = std::make_unique<ReadStore>(
      existing_folder(out), plan_parts(reads.source.overview, part_reads, everywhere));
  ProgressBar bar("sorting reads by tag");
  reads.source.for_each([&](const TagRead& read) { reads.store->add(read); },
                        [&](double share) { bar.show(share); });
  warn_of_thinned_tags(reads, diagnostics);
  return reads;
}

ReadParts parts_of(const StoredReads& reads, const std::optional<Calibration>& calibration) {
  const auto part = [&reads, calibration](std::size_t i) {
    std::vector<TagRead> of_part = reads.store->part(i, reads.most_of_a_tag);
    std::vector<AntennaPose> no_poses;
    KnownBeforehand ignored;
    if (calibration) apply_calibration(*calibration, of_part, no_poses, ignored);
    return of_part;
  };
  return {reads.store->parts(), part};
}

}  // namespace tagfield
