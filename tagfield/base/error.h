// SPDX-License-Identifier: Apache-2.0
/// @file
/// Errors and warnings. Bad input throws Error with one line that says what, where and what was
/// expected; odd but usable input becomes a warning in a Diagnostics that the caller hands in.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace tagfield {

/// The message as one line of bounded length, whatever names and values from outside it quotes:
/// control characters are escaped ("\n", "\x1b"), and of more than 4000 bytes the middle is left
/// out.
std::string as_one_line(const std::string& message);

/// Bad input: a file, a parameter, a message from outside. `what()` is one line for a person.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(as_one_line(message)) {}
};

/// A place in a file that a person can go to.
struct Location {
  std::string file;
  int line = 0;  ///< 1-based; 0 where only the file is known.
};

/// "FILE:LINE", "FILE", or "" where nothing is known.
std::string to_string(const Location& location);

/// Throws Error "FILE:LINE: MESSAGE".
[[noreturn]] void fail(const Location& location, const std::string& message);

/// Warnings gathered on the way, in order, each one line and each only once.
class Diagnostics {
 public:
  void warn(const std::string& message);
  void warn(const Location& location, const std::string& message);
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::string> warnings_;
};

/// The warnings, those of three and more lines of a file that say the same but for numbers in
/// brackets as one, in the place of the first: "FILE:12: … (and 15 more like it, to line 90)".
std::vector<std::string> alike_as_one(const std::vector<std::string>& warnings);

}  // namespace tagfield
