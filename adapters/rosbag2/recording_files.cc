// SPDX-License-Identifier: Apache-2.0
#include "adapters/rosbag2/recording_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <utility>

#include "tagfield/scenario/yaml_map.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMetadata = "metadata.yaml";
constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
constexpr std::string_view kDatabaseMagic = "SQLite format 3";

bool begins_with(const std::string& path, std::string_view magic) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(magic.size(), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file && bytes == magic;
}

bool is_mcap(const std::string& path) {
  return fs::path(path).extension() == ".mcap" || begins_with(path, kMcapMagic);
}

bool is_database(const std::string& path) {
  return fs::path(path).extension() == ".db3" || begins_with(path, kDatabaseMagic);
}

/// "run_10" → ("run_", 10), so that the tenth follows the ninth.
std::pair<std::string, std::string> numbered(const fs::path& path) {
  const std::string stem = path.stem().string();
  std::size_t digits = stem.size();
  while (digits > 0 && std::isdigit(static_cast<unsigned char>(stem[digits - 1])) != 0) --digits;
  const std::string number = stem.substr(digits);
  const std::string zeros(std::max<std::size_t>(number.size(), 20) - number.size(), '0');
  return {stem.substr(0, digits), zeros + number};
}

/// Files of either kind, by their names.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  if (!fs::is_directory(folder, error)) return files;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string end = entry->path().extension().string();
    if (end == ".db3" || end == ".mcap") files.push_back(entry->path().string());
  }
  if (error) fail({folder.string(), 0}, "can't be listed: " + error.message());
  std::sort(files.begin(), files.end(), [](const std::string& a, const std::string& b) {
    return std::pair(numbered(a), a) < std::pair(numbered(b), b);
  });
  return files;
}

/// The file in `folder` that is named in a metadata.yaml.
std::string file_named(const fs::path& folder, const YamlValue& name) {
  const fs::path relative = name.text();
  std::error_code error;
  const fs::path inside = fs::weakly_canonical(folder / relative, error)
                              .lexically_relative(fs::weakly_canonical(folder));
  if (error) name.fail("can't be looked for: " + error.message());
  if (relative.is_absolute() || inside.empty() || *inside.begin() == "..") {
    name.fail(fmt::format("is '{}', which is not in this folder", relative.string()));
  }
  if (relative.extension() == ".zstd") {
    name.fail(fmt::format("is '{}', compressed as a whole: decompress it first (zstd -d)",
                          relative.string()));
  }
  return (folder / relative).string();
}

std::vector<std::string> files_by_metadata(const fs::path& folder, Diagnostics& diagnostics) {
  const std::string path = (folder / kMetadata).string();
  YamlMap root(YamlValue(read_yaml(path), path, ""));
  YamlMap information(root.at("rosbag2_bagfile_information"));
  if (information.has("compression_mode")) {
    const YamlValue mode = information.at("compression_mode");
    const auto text = mode.node().as<std::string>("");
    if (text == "MESSAGE" || text == "message") {
      mode.fail("is 'message', expected files whose messages are not compressed one by one");
    }
  }
  std::vector<std::string> files;
  for (const YamlValue& name : information.list("relative_file_paths")) {
    const std::string file = file_named(folder, name);
    std::error_code error;
    if (fs::exists(file, error)) {
      files.push_back(file);
    } else {
      diagnostics.warn(name.location(), fmt::format("{} is not there", file));
    }
  }
  return files;
}

}  // namespace

std::string decompressor_of(const std::string& path) {
  static const std::map<std::string, std::string> kDecompressors = {
      {".zst", "zstd -d"}, {".zstd", "zstd -d"}, {".gz", "gunzip"},
      {".bz2", "bunzip2"}, {".xz", "xz -d"},     {".lz4", "lz4 -d"}};
  const fs::path name = path;
  const std::string inner = name.stem().extension().string();
  if (inner != ".bag" && inner != ".mcap" && inner != ".db3") return "";
  const auto found = kDecompressors.find(name.extension().string());
  return found == kDecompressors.end() ? "" : found->second;
}

bool is_ros2_recording(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return is_mcap(path) || is_database(path);
  return fs::exists(fs::path(path) / kMetadata, error) || !files_in(path).empty();
}

std::vector<std::string> files_of_recording(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  if (!fs::exists(fs::path(path) / kMetadata, error)) {
    diagnostics.warn({path, 0}, fmt::format("has no {}, as after a recording that was cut off: its "
                                            "files are read in the order of their numbers",
                                            kMetadata));
    return files_in(path);
  }
  std::vector<std::string> files = files_by_metadata(path, diagnostics);
  if (files.empty()) fail({path, 0}, "has none of the files that its metadata.yaml lists");
  return files;
}

std::unique_ptr<RecordedFile> open_recorded_file(const std::string& path,
                                                 Diagnostics& diagnostics) {
  if (is_mcap(path)) return open_recorded_mcap(path, diagnostics);
  return open_recorded_database(path, diagnostics);
}

}  // namespace tagfield
