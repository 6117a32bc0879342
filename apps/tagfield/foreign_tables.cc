// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/foreign_tables.h"

#include <fmt/format.h>

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
#include "tagfield/scenario/dataset_format.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

/// The file of a format given by name, such as "adarf".
std::string format_file(const std::string& command, const std::string& format) {
  const fs::path path(format);
  if (path.has_extension() || path.has_parent_path() || is_there(path)) return format;
  const fs::path folder = shared_folder("profiles") / "datasets";
  const fs::path file = folder / (format + ".yaml");
  if (is_there(file)) return file.string();
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    names.push_back(entry.path().stem().string());
  }
  throw Error(fmt::format("{}: --format: there is no format '{}' in {}{}", command, format,
                          folder.string(), suggestion(format, names)));
}

std::vector<AntennaPose> poses_of(const std::string& command, const std::string& poses,
                                  const std::string& format, const DatasetForm& form,
                                  std::vector<AntennaPose> own) {
  if (poses.empty() && own.empty()) {
    throw Error(
        fmt::format("{}: tables in the format {} have no antenna positions: they need --poses FILE",
                    command, format));
  }
  if (poses.empty()) return own;
  if (!own.empty()) {
    throw Error(fmt::format(
        "{}: tables in the format {} have the antennas' positions already: leave out --poses",
        command, format));
  }
  return form.poses ? read_dataset_poses_csv(poses, *form.poses) : read_poses_csv(poses);
}

/// Tables that are not in an archive.
ReadsAndPoses read_plain_tables(const std::string& command, const std::string& reads,
                                const std::string& poses, const std::string& format) {
  if (!format.empty()) {
    const DatasetForm form = read_dataset_form(format_file(command, format));
    Dataset dataset = read_dataset_csv(reads, form);
    return {std::move(dataset.reads),
            poses_of(command, poses, format, form, std::move(dataset.poses))};
  }
  const TableFiles files = own_tables(command, reads, poses);
  ProgressBar bar("reading");
  return {read_reads_csv(files.reads, [&](double share) { bar.show(share); }),
          read_poses_csv(files.poses)};
}

}  // namespace

TableFiles own_tables(const std::string& command, const std::string& reads,
                      const std::string& poses) {
  const bool of_run = is_run(reads);
  const fs::path folder = of_run ? fs::path(reads) : fs::path(reads).parent_path();
  TableFiles files{of_run ? (folder / "reads.csv").string() : reads, poses};
  if (poses.empty() && of_run) files.poses = (folder / "antenna_poses.csv").string();
  if (files.poses.empty()) {
    throw Error(command +
                ": reads as CSV need --poses FILE, the poses of their antennas, or a --format that "
                "has them in the same table (docs/datasets.md)");
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

ReadsAndPoses read_tables(const std::string& command, const std::string& reads,
                          const std::string& poses, const std::string& format) {
  if (!is_archive(reads)) return read_plain_tables(command, reads, poses, format);
  const UnpackedArchive unpacked(reads);
  try {
    return read_plain_tables(command, unpacked.tables().string(), poses, format);
  } catch (const Error& error) {
    // For users, the table in the error message is in the archive.
    std::string said = error.what();
    const std::string folder = unpacked.folder().string();
    if (said.rfind(folder, 0) == 0) said.replace(0, folder.size(), reads);
    throw Error(said);
  }
}

}  // namespace tagfield
