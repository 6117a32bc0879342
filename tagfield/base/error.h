// SPDX-License-Identifier: Apache-2.0
/// @file
/// Errors and warnings. Bad input throws Error with one line that says what is wrong, where, and
/// what was expected; odd but usable input adds a warning to a Diagnostics that the caller passes.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace tagfield {

/// The message as one line of bounded length, whatever external names and values it quotes: control
/// characters are escaped ("\n", "\x1b"), and the middle of a message over 4000 bytes is left out.
std::string as_one_line(const std::string& message);

/// Bad input: a file, a parameter, an external message. `what()` is one human-readable line.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(as_one_line(message)) {}
};

/// A position in a file, for messages.
struct Location {
  std::string file;
  int line = 0;  ///< 1-based; 0 where only the file is known.
};

/// "FILE:LINE", "FILE", or "" where neither is known.
std::string to_string(const Location& location);

/// Throws Error "FILE:LINE: MESSAGE".
[[noreturn]] void fail(const Location& location, const std::string& message);

/// Warnings collected in order of occurrence, one line each, without duplicates.
class Diagnostics {
 public:
  void warn(const std::string& message);
  void warn(const Location& location, const std::string& message);
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::string> warnings_;
};

/// The warnings with similar ones merged: where three or more lines of a file have the same warning
/// except for numbers in brackets, the first stands for all: "FILE:12: … (and 15 more like it, to
/// line 90)".
std::vector<std::string> alike_as_one(const std::vector<std::string>& warnings);

}  // namespace tagfield
