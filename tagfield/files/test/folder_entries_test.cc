// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/folder_entries.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tagfield/base/error.h"
#include "tagfield/base/test/temporary_folder.h"

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
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::dup(STDERR_FILENO);  // The lowest one that is free.
  ::close(next);
  rlimit none = before;
  none.rlim_cur = static_cast<rlim_t>(next);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  std::string complaint;
  try {
    entries_of(folder.path());
  } catch (const Error& error) {
    complaint = error.what();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(complaint, folder.path().string() + ": can't be looked through: Too many open files");
}

}  // namespace
}  // namespace tagfield
