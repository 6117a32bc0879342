// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/store/result_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>

#include "tagfield/base/number.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kHeadWord = "tagfield-results";
constexpr std::size_t kCrcDigits = 8;
constexpr std::size_t kMaxWaiting = std::size_t{1} << 22U;  // Bytes buffered before a write.
constexpr const char* kOk = "ok";
constexpr const char* kFailed = "failed";

std::string head_line(const LogHead& head) {
  return fmt::format("{} {} {}", kHeadWord, head.program, head.work);
}

std::uint32_t crc_of(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
}

std::string line_of(const LoggedRun& run) {
  const std::string rest = fmt::format("{} {} {:.6f} {}", to_string(run.key),
                                       run.failed ? kFailed : kOk, run.cpu_s, run.body);
  return fmt::format("{:08x} {}\n", crc_of(rest), rest);
}

/// Removes and returns the text up to the next space.
std::string_view next_word(std::string_view& text) {
  const std::size_t end = text.find(' ');
  const std::string_view word = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  return word;
}

template <typename Whole>
std::optional<Whole> whole_of(std::string_view text, int base = 10) {
  Whole number{};
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number, base);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return number;
}

std::optional<RunKey> key_of(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto point = whole_of<std::uint64_t>(text.substr(0, colon));
  const auto seed = whole_of<std::uint64_t>(text.substr(colon + 1));
  if (!point || !seed) return std::nullopt;
  return RunKey{*point, *seed};
}

std::optional<LoggedRun> parsed(std::string_view line) {
  const auto crc = whole_of<std::uint32_t>(next_word(line), 16);
  if (!crc || *crc != crc_of(line)) return std::nullopt;
  const auto key = key_of(next_word(line));
  const std::string_view state = next_word(line);
  const auto seconds = parse_number(std::string(next_word(line)));
  if (!key || !seconds || (state != kOk && state != kFailed)) return std::nullopt;
  return LoggedRun{*key, state == kFailed, *seconds, line};
}

/// Throws Error unless a log that begins with `line` is of this work.
void require_head(const std::string& path, std::string_view line, const LogHead& expected) {
  std::string_view rest = line;
  if (next_word(rest) != kHeadWord) fail({path, 1}, "is not a log of results");
  const LogHead head{std::string(next_word(rest)), std::string(rest)};
  if (head == expected) return;
  if (head.program != expected.program) {
    fail({path, 1},
         fmt::format("has results of tagfield {}, and this is {}", head.program, expected.program));
  }
  fail({path, 1}, fmt::format("has results of another suite or scenario, or of one that was "
                              "changed since (its hash is {}, this one's {})",
                              head.work, expected.work));
}

/// Calls `take` with each complete line and its offset; a last one without a line break is ignored.
void read_lines(const std::string& path,
                const std::function<void(std::string_view, std::uint64_t)>& take) {
  std::string rest;
  std::uint64_t offset = 0;
  read_in_blocks(path, [&](std::string_view bytes) {
    rest += bytes;
    std::size_t begin = 0;
    for (std::size_t end = rest.find('\n'); end != std::string::npos;
         end = rest.find('\n', begin)) {
      take(std::string_view(rest).substr(begin, end - begin), offset + begin);
      begin = end + 1;
    }
    rest.erase(0, begin);
    offset += begin;
  });
}

/// Size of a log up to its last complete line. Throws Error if it is of other work.
std::uint64_t whole_size(const std::string& path, const LogHead& head) {
  std::uint64_t size = 0;
  read_lines(path, [&](std::string_view line, std::uint64_t offset) {
    if (offset == 0) require_head(path, line, head);
    size = offset + line.size() + 1;
  });
  return size;
}

}  // namespace

std::string to_string(const RunKey& key) { return fmt::format("{}:{}", key.point, key.seed); }

LoggedRun logged_run_in(std::string_view line, const Location& location) {
  const std::optional<LoggedRun> run = parsed(line);
  if (!run) fail(location, "is damaged");
  return *run;
}

void read_result_log(const std::string& path, const LogHead& head, Diagnostics& diagnostics,
                     const std::function<void(const LoggedRun&, const LogLocation&)>& take) {
  int number = 0;
  read_lines(path, [&](std::string_view line, std::uint64_t offset) {
    if (++number == 1) {
      require_head(path, line, head);
    } else if (const std::optional<LoggedRun> run = parsed(line)) {
      take(*run, {offset, line.size()});
    } else {
      diagnostics.warn({path, number}, "is damaged: this run counts as not done");
    }
  });
}

ResultLog::ResultLog(const std::string& path, const LogHead& head, double save_every_s,
                     LogStart start)
    : path_(path), save_every_s_(save_every_s) {
  open_and_lock();
  try {
    begin(head, start);
  } catch (const Error&) {
    ::close(file_);
    throw;
  }
}

ResultLog::~ResultLog() {
  try {
    finish();
  } catch (const Error&) {  // Callers that need the error call finish() themselves.
  }
  ::close(file_);
}

void ResultLog::open_and_lock() {
  std::error_code error;
  fs::create_directories(fs::path(path_).parent_path(), error);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) fail({path_, 0}, fmt::format("can't be written: {}", std::strerror(errno)));
  // If the file system doesn't support locks, checksums still identify complete lines.
  int refused = 0;
  do {
    refused = ::flock(file_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  } while (refused == EINTR);
  if (refused != EWOULDBLOCK) return;
  ::close(file_);
  fail({path_, 0}, "is being written by another process, which does the same runs; let it finish");
}

void ResultLog::begin(const LogHead& head, LogStart start) {
  if (start == LogStart::kGoOn) {
    size_ = whole_size(path_, head);
  } else {
    read_lines(path_, [&](std::string_view line, std::uint64_t offset) {
      if (offset > 0) dropped_ += line.size();
    });
  }
  if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) {
    fail({path_, 0}, fmt::format("can't be written: {}", std::strerror(errno)));
  }
  if (size_ > 0) return;
  waiting_ = head_line(head) + "\n";
  save();
}

void ResultLog::add(const LoggedRun& run) {
  const std::string line = line_of(run);
  const std::lock_guard lock(mutex_);
  waiting_ += line;
  const std::chrono::duration<double> since = Clock::now() - saved_;
  if (since.count() >= save_every_s_ || waiting_.size() >= kMaxWaiting) save();
}

void ResultLog::finish() {
  const std::lock_guard lock(mutex_);
  save();
}

void ResultLog::save() {
  static_cast<void>(::lseek(file_, static_cast<off_t>(size_), SEEK_SET));
  std::size_t done = 0;
  while (done < waiting_.size()) {
    const ssize_t count = ::write(file_, waiting_.data() + done, waiting_.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int why = count < 0 ? errno : ENOSPC;
      // A later resume would drop the partial line as well.
      // A variable, as Ubuntu's GCC does not let a cast ignore the result.
      [[maybe_unused]] const int ignored = ::ftruncate(file_, static_cast<off_t>(size_));
      fail({path_, 0}, fmt::format("can't be written: {}; what is in it is whole, run it again "
                                   "once there is room",
                                   std::strerror(why)));
    }
    done += static_cast<std::size_t>(count);
  }
  size_ += done;
  waiting_.clear();
  saved_ = Clock::now();
  if (done > 0) static_cast<void>(::fdatasync(file_));
}

}  // namespace tagfield
