// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/worker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <new>
#include <sstream>

#include "tagfield/base/error.h"
#include "tagfield/base/sanitized.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

/// The header of a request and of an answer.
struct Head {
  std::uint64_t size = 0;  ///< Size of the data that follows.
  WorkLimits limits{};     ///< For a request.
  bool is_complaint = false;
};

/// During its lifetime, a closed pipe makes write() fail instead of raising a signal.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    (void)::sigemptyset(&set_);
    (void)::sigaddset(&set_, SIGPIPE);
    (void)::pthread_sigmask(SIG_BLOCK, &set_, &before_);
  }
  ~NoPipeSignal() {
    const timespec at_once{};
    while (::sigtimedwait(&set_, nullptr, &at_once) > 0) {
    }
    (void)::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t set_{}, before_{};
};

bool send_all(int pipe, const void* data, std::size_t size) {
  const NoPipeSignal quiet;
  const char* left = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t count = ::write(pipe, left, size);
    if (count < 0 && errno != EINTR) return false;
    if (count <= 0) continue;
    left += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool receive_all(int pipe, void* data, std::size_t size) {
  char* left = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t count = ::read(pipe, left, size);
    if (count == 0 || (count < 0 && errno != EINTR)) return false;
    if (count < 0) continue;
    left += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool send_message(int pipe, Head head, const std::string& text) {
  head.size = text.size();
  return send_all(pipe, &head, sizeof(head)) && send_all(pipe, text.data(), text.size());
}

bool receive_message(int pipe, Head& head, std::string& text) {
  if (!receive_all(pipe, &head, sizeof(head))) return false;
  text.resize(head.size);
  return receive_all(pipe, text.data(), text.size());
}

/// Writable memory used by this process [bytes]: the sixth number of statm, in pages.
std::optional<std::uint64_t> taken_memory() {
  std::istringstream numbers(read_text_file("/proc/self/statm", 1000));
  std::uint64_t pages = 0;
  for (int i = 0; i < 6; ++i) numbers >> pages;
  if (!numbers) return std::nullopt;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

rlim_t taken_seconds() {
  rusage usage{};
  (void)::getrusage(RUSAGE_SELF, &usage);
  return static_cast<rlim_t>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) + 1;
}

/// Sets `most`, or the process's existing limit if that is lower.
void set_limit(__rlimit_resource resource, rlimit limit, rlim_t most) {
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  (void)::setrlimit(resource, &limit);
}

rlimit limit_of(__rlimit_resource resource) {
  rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
  (void)::getrlimit(resource, &limit);
  return limit;
}

[[noreturn]] void throw_system_error(const std::string& what, int error) {
  throw Error(fmt::format("{}: a separate process to read it can't be started: {}", what,
                          std::strerror(error)));
}

}  // namespace

WorkerProcess::~WorkerProcess() {
  if (child_ < 0) return;
  close_pipes();
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void WorkerProcess::close_pipes() const {
  ::close(requests_);
  ::close(answers_);
}

void WorkerProcess::start(const std::string& what) {
  std::array<int, 2> requests{};
  std::array<int, 2> answers{};
  if (::pipe2(requests.data(), O_CLOEXEC) != 0) throw_system_error(what, errno);
  if (::pipe2(answers.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    ::close(requests[0]);
    ::close(requests[1]);
    throw_system_error(what, error);
  }
  child_ = ::fork();
  const int error = errno;
  if (child_ == 0) {
    ::close(requests[1]);
    ::close(answers[0]);
    answer_all(requests[0], answers[1]);
  }
  ::close(requests[0]);
  ::close(answers[1]);
  requests_ = requests[1];
  answers_ = answers[0];
  if (child_ >= 0) return;
  close_pipes();
  throw_system_error(what, error);
}

void WorkerProcess::answer_all(int requests, int answers) const {
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGXCPU}) {
    (void)std::signal(number, SIG_DFL);
  }
  set_limit(RLIMIT_CORE, limit_of(RLIMIT_CORE), 0);
  const rlimit seconds = limit_of(RLIMIT_CPU);
  const rlimit memory = limit_of(RLIMIT_DATA);
  Head head;
  std::string text;
  while (receive_message(requests, head, text)) {
    set_limit(RLIMIT_CPU, seconds, taken_seconds() + head.limits.seconds);
    head.is_complaint = false;
    try {
      if (const auto taken = taken_memory(); taken && !kSanitized) {
        set_limit(RLIMIT_DATA, memory, *taken + head.limits.memory_bytes);
      }
      text = work_(text);
    } catch (const std::bad_alloc&) {
      text.clear();  // An empty message stands for this.
      head.is_complaint = true;
    } catch (const std::exception& error) {
      text = error.what();
      head.is_complaint = true;
    }
    set_limit(RLIMIT_DATA, memory, memory.rlim_cur);
    if (!send_message(answers, head, text)) break;
  }
  ::_exit(0);
}

std::string WorkerProcess::how_it_ended(const WorkLimits& limits) {
  int status = 0;
  pid_t ended = 0;
  close_pipes();
  do {
    ended = ::waitpid(child_, &status, 0);
  } while (ended < 0 && errno == EINTR);
  child_ = -1;
  if (ended < 0 || !WIFSIGNALED(status)) return "the library that reads it ended";
  if (WTERMSIG(status) == SIGXCPU) {
    return fmt::format("takes more than {} s of processor time", limits.seconds);
  }
  return fmt::format("the library that reads it crashed ({})", ::strsignal(WTERMSIG(status)));
}

std::string WorkerProcess::ask(const std::string& what, const WorkLimits& limits,
                               const std::string& request) {
  if (child_ < 0) start(what);
  Head head;
  head.limits = limits;
  std::string answer;
  if (!send_message(requests_, head, request) || !receive_message(answers_, head, answer)) {
    throw Error(what + ": " + how_it_ended(limits));
  }
  if (!head.is_complaint) return answer;
  throw Error(!answer.empty() ? answer
                              : fmt::format("{}: takes more than {} MB of memory", what,
                                            limits.memory_bytes / 1'000'000));
}

}  // namespace tagfield
