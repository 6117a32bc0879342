// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/command_line.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>

namespace tagfield {
namespace {

// A signal handler can only access static variables.
std::atomic<bool> interrupt_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int signal) {
  if (interrupt_flag) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  interrupt_flag = true;
}

}  // namespace

void print_warnings(const Diagnostics& diagnostics) {
  for (const std::string& warning : alike_as_one(diagnostics.warnings())) {
    fmt::print(stderr, "tagfield: warning: {}\n", warning);
  }
}

const std::atomic<bool>& interrupted() { return interrupt_flag; }

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

std::string output_fault() {
  constexpr const char* kFault = "the standard output can't be written";
  if (std::fflush(stdout) != 0) return fmt::format("{}: {}", kFault, std::strerror(errno));
  // An earlier write failed, whose errno other calls have overwritten since.
  return std::ferror(stdout) != 0 ? kFault : "";
}

void flush_output() {
  const std::string fault = output_fault();
  if (!fault.empty()) throw Error(fault);
}

int default_threads() {
  const unsigned threads = std::thread::hardware_concurrency();
  return threads == 0 ? 1 : static_cast<int>(threads);
}

}  // namespace tagfield
