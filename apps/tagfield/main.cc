// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/first_steps.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/memory_limit.h"
#include "apps/tagfield/number_checks.h"
#include "apps/tagfield/usage_fault.h"
#include "apps/tagfield/version.h"
#include "tagfield/base/error.h"

namespace {

constexpr const char* kDescription =
    "Tagfield simulates UHF RFID: tags and reader antennas anywhere in a world, fixed or moving,\n"
    "with the phase and RSSI of each read, and locates the tags from them.\n\n"
    "Begin with:  tagfield run scenarios/paper_warehouse.yaml";

int parse_and_run(int argc, char** argv) {
  CLI::App app(kDescription, "tagfield");
  app.footer("'tagfield COMMAND --help' says more. Exit code 2 means that an input is wrong.");
  app.require_subcommand(0, 1);  // Otherwise 'man run' would be two commands.
  bool version = false;
  bool as_json = false;
  CLI::Option* version_flag =
      app.add_flag("--version", version, "Print the version, its commit, and what was compiled in");
  tagfield::add_json_option(app, as_json, "with --version")->needs(version_flag);
  tagfield::Action chosen;
  tagfield::add_commands(app, chosen);
  tagfield::refuse_nan(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "tagfield: {}\n", tagfield::usage_fault(app, error.what()));
    return tagfield::kExitBadInput;
  }
  if (version) {
    const tagfield::BuildInfo build = tagfield::build_info();
    fmt::print("{}", as_json ? tagfield::version_json(build) : tagfield::version_text(build));
    return tagfield::kExitOk;
  }
  if (!chosen) {
    fmt::print("{}", tagfield::first_steps());
    return tagfield::kExitOk;
  }
  return chosen();
}

/// If standard input, output or error is closed, the next opened file would take its descriptor,
/// and output would be written to that file.
void open_standard_streams() {
  for (int file = STDIN_FILENO; file <= STDERR_FILENO; ++file) {
    if (::fcntl(file, F_GETFD) < 0) (void)::open("/dev/null", O_RDWR);
  }
}

// Handlers that receive no arguments can only access static variables.
std::atomic<bool> memory_ran_out{false};

/// Throws as operator new does without a handler.
[[noreturn]] void throw_without_memory() {
  memory_ran_out = true;
  throw std::bad_alloc();
}

/// Without memory an exception may be thrown where none may escape: in destructors of libraries,
/// and in the C++ library's iterator over folders. In that case GCC 12 does not tell which
/// exception it was.
[[noreturn]] void end_without_exception() {
  constexpr std::string_view kNoMemory = "tagfield: there is not enough memory for this\n";
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    if (memory_ran_out) throw std::bad_alloc();
  } catch (const std::bad_alloc&) {
    // The program's state is unknown, so it exits immediately.
    if (::write(STDERR_FILENO, kNoMemory.data(), kNoMemory.size()) >= 0) {
      ::_exit(tagfield::kExitBadInput);
    }
  } catch (...) {
    std::abort();
  }
  std::abort();
}

/// Runs before objects with static storage duration are constructed, for which memory may already
/// be insufficient.
[[gnu::constructor(101)]] void be_ready_for_no_memory() {
  std::set_new_handler(throw_without_memory);
  std::set_terminate(end_without_exception);
}

/// Checks that all output was written: its last part is flushed only now.
int with_output_checked(int code) {
  const std::string fault = tagfield::output_fault();
  if (fault.empty()) return code;
  fmt::print(stderr, "tagfield: {}\n", fault);
  return tagfield::kExitBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  // Beyond the file size limit (ulimit -f), writing then fails and is reported, as on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    tagfield::limit_memory_to_what_is_left();
    return with_output_checked(parse_and_run(argc, argv));
  } catch (const tagfield::Error& error) {
    fmt::print(stderr, "tagfield: {}\n", error.what());
    return tagfield::kExitBadInput;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "tagfield: there is not enough memory for this\n");
    return tagfield::kExitBadInput;
  } catch (const std::system_error& error) {
    // Out of threads or open files, a folder that vanished: Tagfield's own checks have better
    // messages.
    fmt::print(stderr, "tagfield: system error: {}\n", tagfield::as_one_line(error.what()));
    return tagfield::kExitBadInput;
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return with_output_checked(tagfield::kExitBadInput);
    fmt::print(stderr, "tagfield: internal error: {}\n", error.what());
    return tagfield::kExitFailure;
  }
}
