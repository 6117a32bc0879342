// SPDX-License-Identifier: Apache-2.0
/// @file
/// Shared by all subcommands: exit codes, warnings, interruption.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

inline constexpr int kExitOk = 0;
inline constexpr int kExitFailure = 1;        ///< Internal error.
inline constexpr int kExitBadInput = 2;       ///< Bad input or usage.
inline constexpr int kExitIncomplete = 3;     ///< Some runs failed, or are not finished.
inline constexpr int kExitInterrupted = 130;  ///< By SIGINT or SIGTERM, as in shells.

/// Prints each warning as a line on standard error.
void print_warnings(const Diagnostics& diagnostics);

/// Set by SIGINT and SIGTERM once catch_interrupts() was called; a second signal ends the process.
const std::atomic<bool>& interrupted();
void catch_interrupts();

/// Flushes the standard output; returns what is wrong if not all that was printed could be written,
/// else "".
std::string output_fault();
/// Flushes the standard output, where somebody waits for what was printed. Throws Error if it can't
/// be written.
void flush_output();

/// Default number of threads: all of the machine's.
int default_threads();

}  // namespace tagfield
