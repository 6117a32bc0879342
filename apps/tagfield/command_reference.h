// SPDX-License-Identifier: Apache-2.0
/// @file
/// The contents of --help as shell completions and man pages.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tagfield {

/// Completions for the value of an option or argument.
struct ValueWords {
  bool is_taken = false;               ///< False for a flag.
  bool is_file = false;                ///< A file or folder.
  std::vector<std::string> endings{};  ///< Extensions of the files, such as "csv"; empty for any.
  std::vector<std::string> choices{};  ///< The only valid values.
};

/// Derived from the type and the description that --help prints.
ValueWords value_words(const CLI::Option& option);

/// All of a program's commands, in order of definition.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// Options with a name, and arguments without one.
std::vector<const CLI::Option*> named_options(const CLI::App& command);
std::vector<const CLI::Option*> arguments_of(const CLI::App& command);

/// Completion script of this program for a shell: "bash", "zsh" or "fish".
std::string completion_script(const CLI::App& app, const std::string& shell);

/// The name of a command's manual page: "tagfield-run".
std::string page_name(const CLI::App& command);

/// The manual page of `command`, or of the program itself, for section 1. `version` is "0.1.0",
/// `date` that of the sources, or "".
std::string man_page(const CLI::App& command, const std::string& version, const std::string& date);

}  // namespace tagfield
