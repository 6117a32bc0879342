// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/file_kind.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tagfield {
namespace {

namespace fs = std::filesystem;

TEST(FileKind, IsThatOfWhatALinkLeadsTo) {
  const fs::path folder = fs::path(testing::TempDir()) / "file_kind";
  fs::remove_all(folder);
  fs::create_directories(folder / "inner");
  std::ofstream(folder / "file") << "text";
  fs::create_symlink("file", folder / "to_file");
  fs::create_symlink("inner", folder / "to_folder");
  fs::create_symlink("nothing", folder / "to_nothing");
  for (const char* name : {"file", "to_file"}) {
    EXPECT_TRUE(is_file(folder / name) && is_there(folder / name)) << name;
    EXPECT_FALSE(is_folder(folder / name)) << name;
  }
  for (const char* name : {"inner", "to_folder"}) {
    EXPECT_TRUE(is_folder(folder / name) && is_there(folder / name)) << name;
    EXPECT_FALSE(is_file(folder / name)) << name;
  }
  for (const char* name : {"none", "to_nothing"}) {
    EXPECT_FALSE(is_there(folder / name) || is_file(folder / name) || is_folder(folder / name));
  }
  EXPECT_TRUE(is_there("/dev/null"));
  EXPECT_FALSE(is_file("/dev/null"));
  fs::remove_all(folder);
}

TEST(FileKind, IsNoneWhereTheSystemCantTell) {
  const fs::path folder = fs::path(testing::TempDir()) / "file_kind_loop";
  fs::remove_all(folder);
  fs::create_directories(folder);
  fs::create_symlink("loop", folder / "loop");
  for (const fs::path& path : {folder / std::string(300, 'a'), folder / "loop",
                               fs::path(std::string(5000, 'a')), fs::path("/dev/null/file")}) {
    EXPECT_FALSE(is_there(path) || is_file(path) || is_folder(path)) << path;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace tagfield
