// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/store/result_log.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "tagfield/files/files.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

const LogHead kLogHead{"1.2.3", "0123456789abcdef"};

struct Kept {
  RunKey key;
  bool failed = false;
  std::string body;
  bool operator==(const Kept&) const = default;
};

/// A log in a folder of its own.
class LogFile {
 public:
  LogFile() : folder_(fs::temp_directory_path() / "tagfield_result_log_test") {
    fs::remove_all(folder_);
  }
  ~LogFile() { fs::remove_all(folder_); }
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  [[nodiscard]] std::string path() const { return (folder_ / "of_3" / "1.log").string(); }

  void write(const std::vector<Kept>& runs, double save_every_s = 0.0) const {
    ResultLog log(path(), kLogHead, save_every_s);
    for (const Kept& run : runs) log.add({run.key, run.failed, 0.5, run.body});
    log.finish();
  }

  [[nodiscard]] std::vector<Kept> read(Diagnostics& diagnostics) const {
    std::vector<Kept> runs;
    read_result_log(
        path(), kLogHead, diagnostics, [&](const LoggedRun& run, const LogLocation& place) {
          EXPECT_EQ(run.cpu_s, 0.5);
          const std::string line = read_text_file(path()).substr(place.offset, place.length);
          EXPECT_EQ(logged_run_in(line, {}).key, run.key);
          runs.push_back({run.key, run.failed, std::string(run.body)});
        });
    return runs;
  }

  [[nodiscard]] std::vector<Kept> read() const {
    Diagnostics diagnostics;
    std::vector<Kept> runs = read(diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty());
    return runs;
  }

 private:
  fs::path folder_;
};

std::string complaint_of_opening(const std::string& path, const LogHead& head) {
  try {
    const ResultLog log(path, head);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::vector<Kept> kLoggedRuns = {{{0, 1}, false, "{\"a\": 1}"},
                                       {{7, 18446744073709551615U}, true, "why: it failed"},
                                       {{1, 1}, false, ""}};

TEST(ResultLog, GivesBackWhatWasAdded) {
  const LogFile file;
  file.write(kLoggedRuns);
  EXPECT_EQ(file.read(), kLoggedRuns);
  file.write({{{3, 3}, false, "more"}}, 1000.0);
  ASSERT_EQ(file.read().size(), 4U);
  EXPECT_EQ(file.read().back().body, "more");
}

/// Wherever a kill truncates the file, complete lines remain, and the rest can be added again.
RC_GTEST_PROP(ResultLog, IsWholeWhereverItIsCut, ()) {
  const LogFile file;
  file.write(kLoggedRuns);
  const std::string whole = read_text_file(file.path());
  const auto size = *rc::gen::inRange<std::size_t>(0, whole.size());
  fs::resize_file(file.path(), size);
  const std::size_t ends = static_cast<std::size_t>(
      std::count(whole.begin(), whole.begin() + static_cast<long>(size), '\n'));
  const std::size_t left = ends == 0 ? 0 : ends - 1;  // The first line is the head.
  file.write({kLoggedRuns.begin() + static_cast<long>(left), kLoggedRuns.end()});
  RC_ASSERT(file.read() == kLoggedRuns);
}

/// No byte of a line can change unnoticed.
RC_GTEST_PROP(ResultLog, LeavesOutDamagedLines, ()) {
  const LogFile file;
  file.write(kLoggedRuns);
  std::string text = read_text_file(file.path());
  const std::size_t head_end = text.find('\n');
  const auto place = *rc::gen::inRange(head_end + 1, text.size() - 1);
  RC_PRE(text[place] != '\n');
  const char other = *rc::gen::suchThat(rc::gen::inRange<char>(32, 126), [&](char c) {
    // The checksum's digits are read in upper case, too.
    return std::tolower(c) != std::tolower(text[place]);
  });
  text[place] = other;
  write_text_file(file.path(), text);
  Diagnostics diagnostics;
  const std::vector<Kept> left = file.read(diagnostics);
  RC_ASSERT(left.size() == kLoggedRuns.size() - 1);
  RC_ASSERT(diagnostics.warnings().size() == 1U);
}

TEST(ResultLog, RefusesOtherWork) {
  const LogFile file;
  file.write(kLoggedRuns);
  EXPECT_EQ(complaint_of_opening(file.path(), {"1.2.4", kLogHead.work}),
            file.path() + ":1: has results of tagfield 1.2.3, and this is 1.2.4");
  const std::string other = complaint_of_opening(file.path(), {kLogHead.program, "f"});
  EXPECT_NE(other.find(":1: has results of another suite"), std::string::npos) << other;
  write_text_file(file.path(), "x,y\n1,2\n");
  EXPECT_EQ(complaint_of_opening(file.path(), kLogHead),
            file.path() + ":1: is not a log of results");
  EXPECT_EQ(read_text_file(file.path()), "x,y\n1,2\n");
}

TEST(ResultLog, IsOneProcessAtATime) {
  const LogFile file;
  {
    const ResultLog log(file.path(), kLogHead);
    EXPECT_NE(
        complaint_of_opening(file.path(), kLogHead).find("is being written by another process"),
        std::string::npos);
  }
  EXPECT_EQ(complaint_of_opening(file.path(), kLogHead), "");
}

TEST(ResultLog, BeginsAnewWhereAsked) {
  const LogFile file;
  file.write(kLoggedRuns);
  {
    const ResultLog log(file.path(), {"2", "other"}, 0.0, LogStart::kAnew);
    EXPECT_GT(log.dropped(), 0U);
  }
  const ResultLog log(file.path(), {"2", "other"});
  EXPECT_EQ(log.dropped(), 0U);
}

}  // namespace
}  // namespace tagfield
