// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/folder_entries.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tagfield/base/error.h"
#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/files/test/no_more_files.h"

namespace tagfield {
namespace {

TEST(FolderEntries, AreSortedAndNoneWhereThereIsNoFolder) {
  const TemporaryFolder folder;
  static_cast<void>(folder.with("b.csv", "x"));
  static_cast<void>(folder.with("a.csv", "x"));
  const std::vector<std::filesystem::path> expected = {folder.path() / "a.csv",
                                                       folder.path() / "b.csv"};
  EXPECT_EQ(entries_of(folder.path()), expected);
  EXPECT_TRUE(entries_of(folder.path() / "none").empty());
  EXPECT_TRUE(entries_of(folder.path() / "a.csv").empty());
}

TEST(FolderEntries, AreNotNoneWhereTheFolderCannotBeOpened) {
  const TemporaryFolder folder;
  std::string complaint;
  try {
    const NoMoreFiles limit;
    entries_of(folder.path());
  } catch (const Error& error) {
    complaint = error.what();
  }
  EXPECT_EQ(complaint, folder.path().string() + ": can't be listed: Too many open files");
}

TEST(FolderEntries, AreNotNoneWhereTheWayThereIsBarred) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may look everywhere";
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "a/b");
  std::filesystem::permissions(folder.path() / "a", std::filesystem::perms::none);
  EXPECT_THROW(entries_of(folder.path() / "a/b"), Error);
  std::filesystem::permissions(folder.path() / "a", std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace tagfield
