// SPDX-License-Identifier: Apache-2.0
/// @file
/// A folder for one test, deleted after it. No two tests share one, even if they run in parallel.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>

namespace tagfield {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tagfield-XXXXXX").string();
    path_ = mkdtemp(pattern.data()) == nullptr ? "" : pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

  /// Writes a file with the standard library alone; returns its path.
  [[nodiscard]] std::string with(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }
  /// The whole content of a file, read with the standard library alone.
  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream stream(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// All files and folders inside, by relative path.
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_)) {
      all.insert(std::filesystem::relative(entry.path(), path_).string());
    }
    return all;
  }

 private:
  std::filesystem::path path_;
};

/// The running test's own folder; deleted when the next test requests one, or when the program
/// ends.
inline const TemporaryFolder& folder_of_test() {
  static const testing::TestInfo* owner = nullptr;
  static std::optional<TemporaryFolder> folder;
  const testing::TestInfo* const now = testing::UnitTest::GetInstance()->current_test_info();
  if (!folder || now != owner) folder.emplace();
  owner = now;
  return *folder;
}

}  // namespace tagfield
