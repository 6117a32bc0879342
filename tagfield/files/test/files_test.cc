// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <thread>

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
  // Replaces the temporary file of write_text_file by a disk that is always full.
  fs::create_symlink("/dev/full", path + "." + std::to_string(getpid()) + ".partial");
  EXPECT_TRUE(contains(error_of([&] { write_text_file(path, "x"); }), path + ": can't be written"));
  EXPECT_EQ(folder.names(), Names{});
}

TEST(ReadTextFile, RefusesDevices) {
  EXPECT_TRUE(contains(error_of([] { read_text_file("/dev/zero"); }), "/dev/zero: is a device"));
}

TEST(ReadTextFile, RefusesWhatIsTooLong) {
  const TemporaryFolder folder;
  const std::string path = folder.with("f", std::string(2'000'001, 'x'));
  EXPECT_TRUE(
      contains(error_of([&] { read_text_file(path, 2'000'000); }), "is longer than 2000000 bytes"));
  EXPECT_EQ(read_text_file(path, 2'000'001).size(), 2'000'001U);
}

TEST(ReadTextFile, AnErrorIsNoEnd) {
  // Reading at address 0 of a process is an input/output error for any user.
  EXPECT_TRUE(contains(error_of([] { read_text_file("/proc/self/mem"); }), "can't be read: "));
}

TEST(ReadTextFile, ReadsPipes) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(300'000, 'x');
  std::thread writer([&] { std::ofstream(pipe) << text; });
  EXPECT_EQ(read_text_file(pipe), text);
  writer.join();
}

TEST(WriteTextFile, DeletesWhatKilledProgramsLeftBesideIt) {
  const TemporaryFolder folder;
  const pid_t gone = fork();
  if (gone == 0) _exit(0);
  ASSERT_EQ(waitpid(gone, nullptr, 0), gone);
  const std::string of_gone = "f." + std::to_string(gone) + ".partial";
  (void)folder.with(of_gone, "half");
  const std::set<std::string> others = {"f." + std::to_string(getppid()) + ".partial",
                                        "f.x.partial", "f.partial", "g" + of_gone, of_gone + "x"};
  for (const std::string& name : others) (void)folder.with(name, "somebody's");
  write_text_file(folder.file("f"), "whole");
  std::set<std::string> expected = others;
  expected.insert("f");
  EXPECT_EQ(folder.names(), expected);
}

TEST(WriteTextFile, WritesThroughLinksAndPipes) {
  const TemporaryFolder folder;
  (void)folder.with("target", "old");
  fs::create_symlink("target", folder.path() / "link");
  write_text_file(folder.file("link"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(folder.text_of("target"), "new");

  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = read_text_file(pipe); });
  write_text_file(pipe, "text");
  reader.join();
  EXPECT_EQ(read, "text");
  EXPECT_TRUE(fs::is_fifo(pipe));
  write_text_file("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteTextFiles, ReplacesNoneBeforeAllAreWritten) {
  const TemporaryFolder folder;
  (void)folder.with("a", "old");
  EXPECT_THROW(write_text_files({{folder.file("a"), "new"}, {folder.file("no/b"), "new"}}), Error);
  EXPECT_EQ(folder.text_of("a"), "old");
  write_text_files({{folder.file("a"), "new"}, {folder.file("b"), "too"}});
  EXPECT_EQ(folder.text_of("a") + folder.text_of("b"), "newtoo");
  EXPECT_EQ(folder.names(), (Names{"a", "b"}));
}

}  // namespace
}  // namespace tagfield
