// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/staged_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "tagfield/base/error.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/files/files.h"
#include "tagfield/files/internal/own_files.h"
#include "tagfield/files/test/no_more_files.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
using Files = std::map<std::string, std::string>;

/// One commit of these files.
void commit(const fs::path& folder, const Files& files, const std::vector<fs::path>& stale = {}) {
  StagedFolder staged(folder);
  for (const auto& [name, text] : files) staged.add(name, text);
  staged.commit(stale);
}

/// All files of a folder except the list, read by the standard library only.
Files files_of(const TemporaryFolder& folder) {
  Files files;
  for (const std::string& name : folder.names()) {
    const bool is_file = fs::is_regular_file(folder.path() / name);
    if (is_file && name.find(".tagfield") == std::string::npos) files[name] = folder.text_of(name);
  }
  return files;
}

TEST(StagedFolder, ShowsNothingBeforeCommit) {
  const TemporaryFolder folder;
  commit(folder.path() / "out", {{"a", "old"}});
  StagedFolder staged(folder.path() / "out");
  staged.add("a", "new");
  staged.add("deep/b", "b");
  EXPECT_EQ(folder.text_of("out/a"), "old");
  EXPECT_FALSE(fs::exists(folder.path() / "out/deep"));
  EXPECT_EQ(read_text_file((staged.staging() / "deep/b").string()), "b");
}

TEST(StagedFolder, MovesAllIntoPlace) {
  const TemporaryFolder folder;
  (void)folder.with("out/other", "kept");
  commit(folder.path() / "out", {{"a", "old"}});
  commit(folder.path() / "out", {{"a", "new"}, {"deep/er/b", "b"}});
  EXPECT_EQ(folder.names(), (Names{"out", "out/.tagfield", "out/a", "out/deep", "out/deep/er",
                                   "out/deep/er/b", "out/other"}));
  EXPECT_EQ(files_of(folder),
            (Files{{"out/a", "new"}, {"out/deep/er/b", "b"}, {"out/other", "kept"}}));
}

TEST(StagedFolder, ListsItsOwnFiles) {
  const TemporaryFolder folder;
  commit(folder.path(), {{"a", ""}, {"b/c", ""}});
  EXPECT_EQ(own_files(folder.path()), (OwnFiles{"a", "b/c"}));
  commit(folder.path(), {{"d", ""}}, {"b"});
  EXPECT_EQ(own_files(folder.path()), (OwnFiles{"a", "d"}));
  EXPECT_EQ(files_of(folder), (Files{{"a", ""}, {"d", ""}}));
}

TEST(StagedFolder, LeavesNoFileWithoutCommit) {
  const TemporaryFolder folder;
  (void)folder.with("out/other", "old");
  {
    StagedFolder staged(folder.path() / "out");
    staged.add("a", "new");
    staged.add("deep/b", "b");
  }
  EXPECT_EQ(folder.names(), (Names{"out", "out/other"}));
}

TEST(StagedFolder, DeletesItsOwnStaleFilesAtCommit) {
  const TemporaryFolder folder;
  commit(folder.path(), {{"stale", ""}, {"figures/old.svg", ""}, {"kept", ""}, {"again", ""}});
  {
    StagedFolder staged(folder.path());
    staged.add("figures/new.svg", "new");
    staged.add("again", "new");
    EXPECT_TRUE(fs::exists(folder.path() / "stale"));
    staged.commit({"stale", "figures", "again", "was never there"});
  }
  EXPECT_EQ(files_of(folder), (Files{{"again", "new"}, {"figures/new.svg", "new"}, {"kept", ""}}));
  commit(folder.path(), {}, {"figures"});
  EXPECT_FALSE(fs::exists(folder.path() / "figures"));
}

TEST(StagedFolder, NeverDeletesWhatOthersWrote) {
  const TemporaryFolder folder;
  const Files others = {{"figures/mine.svg", "x"}, {"map.pgm", "y"}, {"truth/notes/n", "z"}};
  for (const auto& [name, text] : others) (void)folder.with(name, text);
  commit(folder.path(), {{"a", "1"}}, {"figures", "map.pgm", "truth", "."});
  commit(folder.path(), {{"figures/own.svg", "1"}}, {"figures", "map.pgm", "truth", "a"});
  commit(folder.path(), {{"b", "1"}}, {"figures", "map.pgm", "truth", "a"});
  Files all = others;
  all["b"] = "1";
  EXPECT_EQ(files_of(folder), all);
}

TEST(StagedFolder, NeverReplacesWhatOthersWrote) {
  const TemporaryFolder folder;
  const std::string path = folder.with("map.pgm", "mine");
  StagedFolder staged(folder.path());
  const std::string start = path + ": was not written by Tagfield";
  EXPECT_TRUE(contains(error_of([&] { staged.add("map.pgm", "x"); }), start));
  EXPECT_TRUE(contains(error_of([&] { staged.grow("map.pgm"); }), start));
  staged.add("map.yaml", "x");
  // During the run.
  (void)folder.with("map.yaml", "mine too");
  EXPECT_TRUE(contains(error_of([&] { staged.commit(); }), "map.yaml: was not written by"));
  EXPECT_EQ(folder.text_of("map.pgm"), "mine");
  EXPECT_EQ(folder.text_of("map.yaml"), "mine too");
}

TEST(StagedFolder, FollowsNoLinkOutOfTheFolder) {
  const TemporaryFolder folder;
  commit(folder.path() / "out", {{"figures/a.svg", "a"}});
  (void)folder.with("elsewhere/a.svg", "outside");
  fs::remove_all(folder.path() / "out/figures");
  fs::create_directory_symlink(folder.path() / "elsewhere", folder.path() / "out/figures");
  EXPECT_TRUE(contains(error_of([&] {
                         commit(folder.path() / "out", {{"figures/b.svg", "b"}});
                       }),
                       "figures: is a symbolic link"));
  EXPECT_TRUE(contains(error_of([&] { commit(folder.path() / "out", {}, {"figures"}); }),
                       "figures: is a symbolic link"));
  EXPECT_EQ(folder.text_of("elsewhere/a.svg"), "outside");
  EXPECT_FALSE(fs::exists(folder.path() / "elsewhere/b.svg"));
}

TEST(StagedFolder, RefusesAListThatNamesPlacesOutside) {
  for (const char* name : {"/etc/passwd", "../x", "a/../../x", "./a", "a//b", "a/"}) {
    const TemporaryFolder folder;
    (void)folder.with(".tagfield", "# comment\n" + std::string(name) + "\n");
    EXPECT_TRUE(contains(error_of([&] { const StagedFolder staged(folder.path()); }),
                         ".tagfield:2: expected a file below this folder"))
        << name;
  }
}

TEST(StagedFolder, MakesTheFolderAndItsParents) {
  const TemporaryFolder folder;
  commit(folder.path() / "a/b/", {{"c", "c"}});
  EXPECT_EQ(folder.names(), (Names{"a", "a/b", "a/b/.tagfield", "a/b/c"}));
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
  EXPECT_TRUE(contains(error_of([&] {
                         commit(folder.path() / "out", {{"a", "new"}});
                       }),
                       "out/a: is a folder, expected a file"));
  EXPECT_EQ(folder.names(), (Names{"out", "out/a", "out/a/inner"}));
}

TEST(StagedFolder, RemovesWhatAKilledRunLeftOnceAnotherIsWhole) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    StagedFolder staged(folder.path());
    staged.add("a", "half");
    _exit(0);  // As if killed: no destructor runs.
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  const std::string left = "incomplete-" + std::to_string(child);
  EXPECT_EQ(folder.text_of(left + "/a"), "half");
  (void)folder.with("incomplete-by-hand/a", "somebody's");
  StagedFolder running(folder.path());
  commit(folder.path(), {{"b", "whole"}});
  EXPECT_FALSE(fs::exists(folder.path() / left));
  EXPECT_TRUE(fs::exists(folder.path() / "incomplete-by-hand/a"));
  EXPECT_TRUE(fs::exists(running.staging()));
}

/// The state after `moved` moves of an interrupted commit of `after`.
void cut_off_commit(const fs::path& folder, const Files& after, std::size_t moved) {
  const pid_t child = fork();
  if (child == 0) {
    StagedFolder staged(folder);
    for (const auto& [name, text] : after) staged.add(name, text);
    std::string list;
    for (const auto& [name, text] : after) list += name + "\n";
    std::ofstream(staged.staging() / ".tagfield") << list;
    fs::rename(staged.staging(), folder / ".tagfield-commit");
    for (const auto& [name, text] : after) {
      if (moved-- == 0) break;
      fs::create_directories((folder / name).parent_path());
      fs::rename(folder / ".tagfield-commit" / name, folder / name);
    }
    _exit(0);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
}

TEST(StagedFolder, CommitThatWasCutOffIsFinished) {
  const Files before = {{"a", "old"}, {"b/c", "old"}, {"figures/stale.svg", "old"}};
  const Files after = {{"a", "new"}, {"b/c", "new"}, {"d", "new"}};
  for (std::size_t moved = 0; moved <= after.size(); ++moved) {
    const TemporaryFolder folder;
    commit(folder.path(), before);
    cut_off_commit(folder.path(), after, moved);
    finish_commit(folder.path());
    EXPECT_EQ(files_of(folder), after) << moved << " moved";
    EXPECT_EQ(folder.names(), (Names{".tagfield", "a", "b", "b/c", "d"})) << moved << " moved";
  }
}

TEST(StagedFolder, NextOneFinishesACommitThatWasCutOff) {
  const TemporaryFolder folder;
  cut_off_commit(folder.path(), {{"a", "1"}, {"b", "1"}}, 1);
  commit(folder.path(), {{"b", "2"}});
  EXPECT_EQ(files_of(folder), (Files{{"a", "1"}, {"b", "2"}}));
}

ino_t inode_of(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

TEST(StagedFolder, IsSwappedForAnotherWhereAllInItIsItsOwn) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  commit(out, {{"a", "old"}, {"kept/b", "old"}, {"stale", "old"}});
  ASSERT_EQ(::chmod(out.c_str(), 0750), 0);
  const ino_t before = inode_of(out);
  const ino_t kept = inode_of(out / "kept/b");
  commit(out, {{"a", "new"}, {"c/d", "new"}}, {"stale"});
  EXPECT_NE(inode_of(out), before);
  EXPECT_EQ(inode_of(out / "kept/b"), kept);
  EXPECT_EQ(fs::status(out).permissions(), fs::perms(0750));
  EXPECT_EQ(folder.names(),
            (Names{"out", "out/.tagfield", "out/a", "out/c", "out/c/d", "out/kept", "out/kept/b"}));
  EXPECT_EQ(files_of(folder), (Files{{"out/a", "new"}, {"out/c/d", "new"}, {"out/kept/b", "old"}}));
}

TEST(StagedFolder, IsSwappedBesideWhatTheWorkKeepsThere) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  commit(out, {{"a", "old"}});
  const ino_t before = inode_of(out);
  StagedFolder staged(out);
  std::ofstream log(out / "log");
  log << "half" << std::flush;
  staged.keep("log");
  staged.keep("not_there");
  staged.add("a", "new");
  staged.commit();
  log << " done" << std::flush;
  EXPECT_NE(inode_of(out), before);
  EXPECT_EQ(folder.names(), (Names{"out", "out/.tagfield", "out/a", "out/log"}));
  EXPECT_EQ(files_of(folder), (Files{{"out/a", "new"}, {"out/log", "half done"}}));
  // It is not a result: the next commit leaves it, and the folder, unchanged.
  commit(out, {{"a", "newer"}}, {"log"});
  EXPECT_EQ(folder.text_of("out/log"), "half done");
}

TEST(StagedFolder, StaysTheSameFolderWhereOthersAreInIt) {
  using Prepare = std::function<void(const fs::path&)>;
  const std::map<std::string, Prepare> others = {
      {"a file", [](const fs::path& out) { std::ofstream(out / "mine") << "mine"; }},
      {"a file among ours", [](const fs::path& out) { std::ofstream(out / "b/mine") << "mine"; }},
      {"an empty folder", [](const fs::path& out) { fs::create_directory(out / "mine"); }},
      {"a link", [](const fs::path& out) { fs::create_symlink("nowhere", out / "mine"); }}};
  for (const auto& [what, prepare] : others) {
    const TemporaryFolder folder;
    const fs::path out = folder.path() / "out";
    commit(out, {{"a", "old"}, {"b/c", "old"}});
    prepare(out);
    const ino_t before = inode_of(out);
    commit(out, {{"a", "new"}, {"d", "new"}}, {"b"});
    EXPECT_EQ(inode_of(out), before) << what;
    EXPECT_EQ(folder.text_of("out/a") + folder.text_of("out/d"), "newnew") << what;
    EXPECT_FALSE(fs::exists(out / "b/c")) << what;
    const bool is_left = fs::exists(fs::symlink_status(out / "mine")) || fs::exists(out / "b/mine");
    EXPECT_TRUE(is_left) << what;
  }
}

TEST(StagedFolder, StaysTheSameFolderUnderTheFeetOfWhoStandsInIt) {
  const TemporaryFolder folder;
  commit(folder.path() / "out", {{"a", "old"}, {"b/c", "old"}});
  const ino_t before = inode_of(folder.path() / "out");
  const fs::path here = fs::current_path();
  fs::current_path(folder.path() / "out/b");
  commit("..", {{"a", "new"}});
  fs::current_path(here);
  EXPECT_EQ(inode_of(folder.path() / "out"), before);
  EXPECT_EQ(files_of(folder), (Files{{"out/a", "new"}, {"out/b/c", "old"}}));
}

TEST(StagedFolder, ALinkToItStaysALink) {
  const TemporaryFolder folder;
  commit(folder.path() / "real", {{"a", "old"}});
  fs::create_directory_symlink("real", folder.path() / "out");
  commit(folder.path() / "out", {{"a", "new"}});
  EXPECT_TRUE(fs::is_symlink(folder.path() / "out"));
  EXPECT_EQ(folder.text_of("real/a"), "new");
}

/// Kills a child that commits two versions in turn, and continues with what is left.
TEST(StagedFolder, KilledAtAnyMomentHoldsTheOneOrTheOther) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const Files one = {{"out/a", "1"}, {"out/b/c", "1"}, {"out/stale/d", "1"}};
  const Files other = {{"out/a", "2"}, {"out/b/c", "2"}, {"out/e", "2"}};
  const auto commit_one = [&] { commit(out, {{"a", "1"}, {"b/c", "1"}, {"stale/d", "1"}}, {"e"}); };
  const auto commit_other = [&] { commit(out, {{"a", "2"}, {"b/c", "2"}, {"e", "2"}}, {"stale"}); };
  commit_one();
  std::mt19937 random(1);
  for (int kill_number = 0; kill_number < 40; ++kill_number) {
    const pid_t child = fork();
    if (child == 0) {
      for (;;) {
        commit_other();
        commit_one();
      }
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 20'000));
    ::kill(child, SIGKILL);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    Files found;
    for (const auto& [name, text] : files_of(folder)) {
      // The child's work in progress, which another commit removes.
      if (name.rfind("out/incomplete-", 0) != 0 && name.rfind("out/", 0) == 0) found[name] = text;
    }
    EXPECT_TRUE(found == one || found == other) << "kill " << kill_number;
  }
  commit_one();
  EXPECT_EQ(folder.names(), (Names{"out", "out/.tagfield", "out/a", "out/b", "out/b/c", "out/stale",
                                   "out/stale/d"}));
}

/// A folder that can't be read must not be considered empty and deleted.
TEST(FinishCommit, WithoutFilesToOpenLosesNothing) {
  const TemporaryFolder folder;
  cut_off_commit(folder.path(), {{"a", "1"}, {"b/c", "1"}}, 1);
  const pid_t child = fork();
  if (child == 0) {
    for (rlim_t files = 0; files < 12; ++files) {
      const rlimit few{files, 100};
      ::setrlimit(RLIMIT_NOFILE, &few);
      try {
        finish_commit(folder.path());
      } catch (const std::exception&) {
        continue;
      }
    }
    _exit(0);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  finish_commit(folder.path());
  EXPECT_EQ(files_of(folder), (Files{{"a", "1"}, {"b/c", "1"}}));
}

TEST(FinishCommit, LeavesOtherFoldersAlone) {
  const TemporaryFolder folder;
  (void)folder.with(".tagfield-commit/a", "no list, so none of ours");
  finish_commit(folder.path());
  EXPECT_EQ(folder.names(), (Names{".tagfield-commit", ".tagfield-commit/a"}));
  finish_commit(folder.path() / "missing");
}

TEST(StagedFolder, LeavesItsListWhereNoMoreFilesCanBeOpened) {
  const TemporaryFolder folder;
  const fs::path own = folder.path() / "incomplete-1";
  fs::create_directories(own / "truth");
  write_text_file((own / ".tagfield").string(), "# Tagfield\n");
  write_text_file((own / "truth/tags.csv").string(), "x\n");
  {
    const NoMoreFiles limit;
    files_internal::delete_own_folder(own);
  }
  // Everything that marks the folder as deletable is kept for the next result.
  EXPECT_TRUE(files_internal::is_own_folder(own));
  EXPECT_TRUE(fs::exists(own / "truth/tags.csv"));
  files_internal::delete_own_folder(own);
  EXPECT_FALSE(fs::exists(own));
}

}  // namespace
}  // namespace tagfield
