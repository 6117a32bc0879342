#include "tagfield/files/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tagfield/base/error.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

TEST(ReadTextFile, GivesEveryByte) {
  const TemporaryFolder folder;
  const std::string text("a\r\n\0\xff\n", 6);
  EXPECT_EQ(read_text_file(folder.with("f", text)), text);
  EXPECT_EQ(read_text_file(folder.with("empty", "")), "");
}

TEST(ReadTextFile, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(error_of([&] { read_text_file(folder.file("no")); }), "no: no such file"));
  EXPECT_TRUE(contains(error_of([&] { read_text_file(folder.path().string()); }), "is a folder"));
  const std::string below_a_file = folder.with("f", "") + "/g";
  EXPECT_THROW(read_text_file(below_a_file), Error);
}

TEST(WriteTextFile, MakesAndReplaces) {
  const TemporaryFolder folder;
  write_text_file(folder.file("f"), "a longer text");
  write_text_file(folder.file("f"), "short\n");
  EXPECT_EQ(folder.text_of("f"), "short\n");
  EXPECT_EQ(folder.names(), Names{"f"});
}

TEST(WriteTextFile, FailsCleanlyIntoAMissingFolder) {
  const TemporaryFolder folder;
  const std::string path = folder.file("missing/f");
  EXPECT_TRUE(contains(error_of([&] { write_text_file(path, "x"); }), path + ": can't be written"));
  EXPECT_EQ(folder.names(), Names{});
}

TEST(WriteTextFile, FailsCleanlyOverAFolder) {
  const TemporaryFolder folder;
  (void)folder.with("sub/inner", "kept");
  EXPECT_THROW(write_text_file(folder.file("sub"), "x"), Error);
  EXPECT_EQ(folder.names(), (Names{"sub", "sub/inner"}));
}

TEST(WriteTextFile, FailsCleanlyIntoAReadOnlyFolder) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(write_text_file(folder.file("f"), "x"), Error);
  EXPECT_EQ(folder.names(), Names{});
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(WriteTextFile, SaysThatTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const TemporaryFolder folder;
  const std::string path = folder.file("f");
  // Where write_text_file writes first, a disk that is always full.
  fs::create_symlink("/dev/full", path + "." + std::to_string(getpid()) + ".partial");
  EXPECT_TRUE(contains(error_of([&] { write_text_file(path, "x"); }), path + ": can't be written"));
  EXPECT_EQ(folder.names(), Names{});
}

TEST(StagedFolder, ShowsNothingBeforeCommit) {
  const TemporaryFolder folder;
  (void)folder.with("out/a", "old");
  StagedFolder staged(folder.path() / "out");
  staged.add("a", "new");
  staged.add("deep/b", "b");
  EXPECT_EQ(folder.text_of("out/a"), "old");
  EXPECT_FALSE(fs::exists(folder.path() / "out/deep"));
  EXPECT_EQ(read_text_file((staged.staging() / "deep/b").string()), "b");
}

TEST(StagedFolder, MovesAllIntoPlace) {
  const TemporaryFolder folder;
  (void)folder.with("out/a", "old");
  (void)folder.with("out/other", "kept");
  {
    StagedFolder staged(folder.path() / "out");
    staged.add("a", "new");
    staged.add("deep/er/b", "b");
    staged.commit();
  }
  EXPECT_EQ(folder.names(),
            (Names{"out", "out/a", "out/deep", "out/deep/er", "out/deep/er/b", "out/other"}));
  EXPECT_EQ(folder.text_of("out/a"), "new");
  EXPECT_EQ(folder.text_of("out/deep/er/b"), "b");
  EXPECT_EQ(folder.text_of("out/other"), "kept");
}

TEST(StagedFolder, LeavesNoFileWithoutCommit) {
  const TemporaryFolder folder;
  (void)folder.with("out/a", "old");
  {
    StagedFolder staged(folder.path() / "out");
    staged.add("a", "new");
    staged.add("deep/b", "b");
  }
  EXPECT_EQ(folder.names(), (Names{"out", "out/a"}));
  EXPECT_EQ(folder.text_of("out/a"), "old");
}

TEST(StagedFolder, DeletesStaleFilesAndFoldersAtCommit) {
  const TemporaryFolder folder;
  (void)folder.with("out/stale", "");
  (void)folder.with("out/figures/old.svg", "");
  (void)folder.with("out/kept", "");
  {
    StagedFolder staged(folder.path() / "out");
    staged.add("figures/new.svg", "new");
    staged.add("again", "new");
    EXPECT_TRUE(fs::exists(folder.path() / "out/stale"));
    staged.commit({"stale", "figures", "again", "was never there"});
  }
  EXPECT_EQ(folder.names(),
            (Names{"out", "out/again", "out/figures", "out/figures/new.svg", "out/kept"}));
  EXPECT_EQ(folder.text_of("out/again"), "new");
}

TEST(StagedFolder, MakesTheFolderAndItsParents) {
  const TemporaryFolder folder;
  {
    StagedFolder staged(folder.path() / "a/b/");
    staged.add("c", "c");
    staged.commit();
  }
  EXPECT_EQ(folder.names(), (Names{"a", "a/b", "a/b/c"}));
}

TEST(StagedFolder, RefusesAPathThatIsAFile) {
  const TemporaryFolder folder;
  const std::string path = folder.with("f", "kept");
  EXPECT_TRUE(contains(error_of([&] { const StagedFolder staged(path); }), path + ": can't"));
  EXPECT_THROW(StagedFolder(path + "/below"), Error);
  EXPECT_EQ(folder.text_of("f"), "kept");
}

TEST(StagedFolder, SaysWhenAFolderStandsWhereAFileGoes) {
  const TemporaryFolder folder;
  (void)folder.with("out/a/inner", "kept");
  {
    StagedFolder staged(folder.path() / "out");
    staged.add("a", "new");
    EXPECT_TRUE(contains(error_of([&] { staged.commit(); }), "out/a: can't be replaced"));
  }
  EXPECT_EQ(folder.names(), (Names{"out", "out/a", "out/a/inner"}));
}

}  // namespace
}  // namespace tagfield
