// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <set>

#include "apps/tagfield/command_reference.h"

namespace tagfield {
namespace {

/// A line of text for roff, escaped so that it contains neither requests nor escapes.
std::string escaped(const std::string& line) {
  std::string result;
  if (!line.empty() && (line[0] == '.' || line[0] == '\'')) result = "\\&";
  for (const char character : line) {
    if (character == '\\') {
      result += "\\e";
    } else if (character == '-') {
      result += "\\-";  // So that it is copied from a page as an ASCII hyphen.
    } else if (character == '\'') {
      result += "\\(aq";
    } else if (character == '`') {
      result += "\\(ga";
    } else if (character == '^') {
      result += "\\(ha";
    } else if (character == '~') {
      result += "\\(ti";
    } else {
      result += character;
    }
  }
  return result;
}

std::string joined_name(const CLI::App& command, const char* between) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : parent->get_name() + between + command.get_name();
}

std::string upper(std::string text) {
  for (char& character : text) {
    if (character >= 'a' && character <= 'z') character = static_cast<char>(character - 'a' + 'A');
  }
  return text;
}

/// Whether a line is kept verbatim, as in tables, examples and files; other lines are filled.
bool is_as_it_stands(const std::string& line) {
  return line.rfind(' ', 0) == 0 || line.find("  ") != std::string::npos;
}

/// Paragraphs of a section.
std::string paragraphs(const std::string& text) {
  std::string page;
  bool example = false;
  bool fresh = true;
  for (const std::string& line : CLI::detail::split(text, '\n')) {
    if (line.empty()) {
      if (example) page += ".EE\n";
      example = false;
      fresh = true;
      continue;
    }
    if (is_as_it_stands(line) != example || fresh) {
      if (example) page += ".EE\n";
      example = is_as_it_stands(line);
      if (!page.empty()) page += ".PP\n";
      if (example) page += ".EX\n";
    }
    fresh = false;
    page += escaped(line) + "\n";
  }
  return example ? page + ".EE\n" : page;
}

std::string bold_names(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) {
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", escaped("-" + name));
  }
  for (const std::string& name : option.get_lnames()) {
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", escaped("--" + name));
  }
  return names;
}

/// The type's name alone, "UINT" from "UINT:UINT in [1 - 1000]", and the description of its values.
std::pair<std::string, std::string> type_and_values(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  if (colon == std::string::npos) return {type, ""};
  return {type.substr(0, colon), type.substr(colon + 1)};
}

/// Names in an order that does not depend on memory addresses.
std::set<std::string> sorted_names(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* option : options) names.insert(option->get_name());
  return names;
}

std::string relations_of(const CLI::Option& option) {
  std::string text;
  const auto add = [&](const char* what, const std::set<CLI::Option*>& others) {
    if (others.empty()) return;
    text += std::string(" ") + what;
    bool first = true;
    for (const std::string& name : sorted_names(others)) {
      text += (first ? " \\fB" : ", \\fB") + escaped(name) + "\\fR";
      first = false;
    }
    text += ".";
  };
  add("Needs", option.get_needs());
  add("Not with", option.get_excludes());
  return text;
}

std::string option_entry(const CLI::Option& option) {
  const auto [type, values] = type_and_values(option);
  std::string page = ".TP\n";
  page += option.nonpositional() ? bold_names(option)
                                 : fmt::format("\\fI{}\\fR", escaped(option.get_name()));
  if (option.nonpositional() && option.get_items_expected_max() > 0) {
    page += fmt::format(" \\fI{}\\fR", escaped(type));
  }
  page += "\n" + escaped(option.get_description());
  if (!values.empty()) page += fmt::format(" ({})", escaped(values));
  const std::string relations = relations_of(option);
  if (!relations.empty()) page += "." + relations;
  return page + "\n";
}

std::string synopsis(const CLI::App& command) {
  std::string page = fmt::format("\\fB{}\\fR", escaped(joined_name(command, " ")));
  if (command.get_parent() == nullptr && !commands_of(command).empty()) {
    page += " \\fICOMMAND\\fR";
  }
  page += " [\\fIOPTIONS\\fR]";
  for (const CLI::Option* argument : arguments_of(command)) {
    page += argument->get_required() ? fmt::format(" \\fI{}\\fR", escaped(argument->get_name()))
                                     : fmt::format(" [\\fI{}\\fR]", escaped(argument->get_name()));
  }
  return page + "\n";
}

std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.substr(0, line.find(": "));
}

/// A command's own footer; "" if it only inherits the program's.
std::string own_footer(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  const std::string footer = command.get_footer();
  return parent != nullptr && parent->get_footer() == footer ? "" : footer;
}

std::string options_section(const CLI::App& command) {
  std::string page;
  if (!arguments_of(command).empty()) page += ".SH ARGUMENTS\n";
  for (const CLI::Option* argument : arguments_of(command)) page += option_entry(*argument);
  page += ".SH OPTIONS\n";
  for (const CLI::Option* option : named_options(command)) page += option_entry(*option);
  return page;
}

std::string commands_section(const CLI::App& app) {
  std::string page;
  if (!commands_of(app).empty()) page += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) {
    page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", escaped(command->get_name()),
                        escaped(command->get_description()));
  }
  return page;
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n0\nAll went well.\n"
    ".TP\n1\nAn internal error of the program.\n"
    ".TP\n2\nAn input is wrong: a file, a value or an option; standard error has one line that "
    "says which.\n"
    ".TP\n3\nSome runs failed, or are not done yet.\n"
    ".TP\n130\nInterrupted; the results so far are kept and marked as incomplete.\n";

std::string see_also(const CLI::App& command) {
  std::string page = ".SH SEE ALSO\n";
  if (command.get_parent() != nullptr) return page + ".BR tagfield (1)\n";
  const std::vector<const CLI::App*> commands = commands_of(command);
  if (commands.empty()) return page + ".BR tagfield (1)\n";
  for (const CLI::App* other : commands) {
    page += fmt::format(".BR {} (1){}\n", escaped(joined_name(*other, "-")),
                        other == commands.back() ? "" : ",");
  }
  return page;
}

}  // namespace

std::string page_name(const CLI::App& command) { return joined_name(command, "-"); }

std::string man_page(const CLI::App& command, const std::string& version, const std::string& date) {
  const std::string name = page_name(command);
  std::string page = fmt::format(".TH {} 1 \"{}\" \"Tagfield {}\" \"User Commands\"\n",
                                 escaped(upper(name)), date, version);
  page += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}", escaped(name),
                      escaped(first_line(command.get_description())), synopsis(command));
  page +=
      ".SH DESCRIPTION\n" + paragraphs(command.get_description() + "\n\n" + own_footer(command));
  return page + commands_section(command) + options_section(command) + kExitStatus +
         see_also(command);
}

}  // namespace tagfield
