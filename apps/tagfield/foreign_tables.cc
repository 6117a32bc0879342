// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/foreign_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "adapters/archive/unpacked_archive.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/shared_folder.h"
#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/base/spelling.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/report/text.h"
#include "tagfield/scenario/dataset_format.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_formats() { return shared_folder("profiles") / "datasets"; }

/// The formats that come with Tagfield.
std::vector<std::string> format_names() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_of_formats(), ignored)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The file of a format given by name, such as "adarf".
std::string format_file(const std::string& command, const std::string& format) {
  const fs::path path(format);
  if (path.has_extension() || path.has_parent_path() || is_there(path)) return format;
  const fs::path folder = folder_of_formats();
  const fs::path file = folder / (format + ".yaml");
  if (is_there(file)) return file.string();
  throw Error(fmt::format("{}: --format: there is no format '{}' in {}{}", command, format,
                          folder.string(), suggestion(format, format_names())));
}

/// Refuses a folder that only a format could explain, saying what is in it.
void refuse_unknown_tables(const std::string& folder) {
  std::vector<std::string> tables;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".csv") tables.push_back(entry.path().filename().string());
  }
  std::sort(tables.begin(), tables.end(), natural_less);
  if (tables.empty()) fail({folder, 0}, "is a folder without tables, expected *.csv in it");
  constexpr std::size_t kNamed = 3;
  const std::string more = tables.size() > kNamed ? ", …" : "";
  const std::size_t count = tables.size();
  tables.resize(std::min(count, kNamed));
  fail(
      {folder, 0},
      fmt::format("has {} ({}{}), but not the reads.csv of a run, and therefore needs --format: {} "
                  "or a file (docs/datasets.md)",
                  counted(count, "table"), fmt::join(tables, ", "), more,
                  fmt::join(format_names(), ", ")));
}

std::vector<AntennaPose> poses_of(const TableSources& from, const DatasetForm& form,
                                  std::vector<AntennaPose> own) {
  if (from.poses.empty() && own.empty() && from.needs_poses) {
    throw Error(
        fmt::format("{}: tables in the format {} have no antenna positions: they need --poses FILE",
                    from.command, from.format));
  }
  if (from.poses.empty()) return own;
  if (!own.empty()) {
    throw Error(fmt::format(
        "{}: tables in the format {} have the antennas' positions already: leave out --poses",
        from.command, from.format));
  }
  return form.poses ? read_dataset_poses_csv(from.poses, *form.poses) : read_poses_csv(from.poses);
}

/// Tables that are not in an archive.
ReadsAndPoses read_plain_tables(const TableSources& from, Diagnostics& diagnostics) {
  if (!from.format.empty()) {
    const DatasetForm form = read_dataset_form(format_file(from.command, from.format));
    Dataset dataset = read_dataset_csv(from.reads, form);
    return {std::move(dataset.reads), poses_of(from, form, std::move(dataset.poses))};
  }
  if (is_folder(from.reads) && !is_run(from.reads)) refuse_unknown_tables(from.reads);
  const bool has_poses = from.needs_poses || !from.poses.empty() || is_run(from.reads);
  const TableFiles files =
      has_poses ? own_tables(from.command, from.reads, from.poses) : TableFiles{from.reads, ""};
  ProgressBar bar("reading");
  ReadsAndPoses tables;
  tables.reads = read_reads_csv(
      files.reads, [&](double share) { bar.show(share); }, &diagnostics);
  if (has_poses) tables.poses = read_poses_csv(files.poses);
  return tables;
}

/// `text` with `path` in place of the temporary `folder` at its beginning.
std::string outside(std::string text, const std::string& folder, const std::string& path) {
  if (text.rfind(folder, 0) == 0) text.replace(0, folder.size(), path);
  return text;
}

}  // namespace

TableFiles own_tables(const std::string& command, const std::string& reads,
                      const std::string& poses) {
  const bool of_run = is_run(reads);
  if (is_folder(reads) && !of_run) refuse_unknown_tables(reads);
  const fs::path folder = of_run ? fs::path(reads) : fs::path(reads).parent_path();
  TableFiles files{of_run ? (folder / "reads.csv").string() : reads, poses};
  if (poses.empty() && of_run) files.poses = (folder / "antenna_poses.csv").string();
  if (files.poses.empty()) {
    throw Error(fmt::format(
        "{}: reads as CSV need --poses FILE, the poses of their antennas, or a --format that has "
        "them in the same table: {} or a file (docs/datasets.md)",
        command, fmt::join(format_names(), ", ")));
  }
  finish_commit(folder);
  return files;
}

bool is_run(const std::string& path) { return is_there(fs::path(path) / "reads.csv"); }

void add_format_option(CLI::App& command, std::string& format) {
  command.add_option("--format", format,
                     "Format of CSV from other sources: a name of profiles/datasets, such as adarf "
                     "or llrp_log, or a file (YAML); docs/datasets.md");
}

void use_tables(const std::string& path, Diagnostics& diagnostics,
                const std::function<void(const std::string& tables, Diagnostics& of_tables)>& use) {
  if (!is_archive(path)) return use(path, diagnostics);
  const UnpackedArchive unpacked(path);
  const std::string folder = unpacked.folder().string();
  Diagnostics of_tables;
  try {
    use(unpacked.tables().string(), of_tables);
  } catch (const Error& error) {
    throw Error(outside(error.what(), folder, path));
  }
  for (const std::string& warning : of_tables.warnings()) {
    diagnostics.warn(outside(warning, folder, path));
  }
}

ReadsAndPoses read_tables(const TableSources& sources, Diagnostics& diagnostics) {
  ReadsAndPoses tables;
  use_tables(sources.reads, diagnostics, [&](const std::string& path, Diagnostics& of_tables) {
    TableSources plain = sources;
    plain.reads = path;
    tables = read_plain_tables(plain, of_tables);
  });
  return tables;
}

}  // namespace tagfield
