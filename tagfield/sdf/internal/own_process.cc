#include "tagfield/sdf/internal/own_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>

#include "tagfield/base/error.h"

// Sanitizers reserve memory by the terabyte.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TAGFIELD_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TAGFIELD_SANITIZED 1
#endif
#endif

namespace tagfield {
namespace {

/// First byte of what the process says.
constexpr char kResult = 'R';
constexpr char kComplaint = 'C';

/// Writable memory that this process has taken [bytes].
std::optional<std::uint64_t> taken_memory() {
  std::FILE* const file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return std::nullopt;
  unsigned long long pages = 0;
  const int read = std::fscanf(file, "%*u %*u %*u %*u %*u %llu", &pages);
  std::fclose(file);
  if (read != 1) return std::nullopt;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void set_limit(int resource, std::uint64_t most) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, most);
  (void)::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

void take_limits(const ProcessLimits& limits) {
  set_limit(RLIMIT_CPU, limits.seconds);
  set_limit(RLIMIT_CORE, 0);
#ifndef TAGFIELD_SANITIZED
  if (const auto taken = taken_memory()) set_limit(RLIMIT_DATA, *taken + limits.memory_bytes);
#endif
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) {
    (void)std::signal(number, SIG_DFL);
  }
}

std::string too_much_memory(const std::string& what, const ProcessLimits& limits) {
  return fmt::format("{}: takes more than {} MB of memory", what, limits.memory_bytes / 1'000'000);
}

std::string said_of(const std::string& what, const ProcessLimits& limits,
                    const std::function<std::string()>& work) {
  try {
    return kResult + work();
  } catch (const std::bad_alloc&) {
    return kComplaint + too_much_memory(what, limits);
  } catch (const std::exception& error) {
    return std::string(1, kComplaint) + error.what();
  }
}

bool write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  return true;
}

std::string read_all(int file) {
  std::string text;
  std::array<char, 65536> part{};
  while (true) {
    const ssize_t count = ::read(file, part.data(), part.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
    if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
  }
}

/// How it ended; none where it came to its end.
std::optional<std::string> end_of(pid_t child, const ProcessLimits& limits) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return std::nullopt;  // Somebody else has waited for it.
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  if (!WIFSIGNALED(status)) return "the library that reads it ended";
  if (WTERMSIG(status) == SIGXCPU) {
    return fmt::format("takes more than {} s of processor time", limits.seconds);
  }
  return fmt::format("the library that reads it broke down ({})", ::strsignal(WTERMSIG(status)));
}

[[noreturn]] void throw_system_error(const std::string& what) {
  throw Error(fmt::format("{}: no process of its own to read it: {}", what, std::strerror(errno)));
}

}  // namespace

std::string from_own_process(const std::string& what, const ProcessLimits& limits,
                             const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_system_error(what);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    take_limits(limits);
    ::_exit(write_all(ends[1], said_of(what, limits, work)) ? 0 : 1);
  }
  const int error = errno;
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    errno = error;
    throw_system_error(what);
  }
  const std::string said = read_all(ends[0]);
  ::close(ends[0]);
  if (const auto end = end_of(child, limits)) throw Error(what + ": " + *end);
  if (said.empty() || said.front() != kResult) throw Error(said.empty() ? what : said.substr(1));
  return said.substr(1);
}

}  // namespace tagfield
