// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/command_reference.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_line.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/output_file.h"
#include "tagfield/base/error.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

using Strings = std::vector<std::string>;

constexpr std::size_t kDescriptionWidth = 72;

/// The first clause of a help text, for a list with one line per entry.
std::string short_description(const std::string& text) {
  std::string first = text.substr(0, text.find('\n'));
  for (const char* end : {". ", ": ", "; "}) first = first.substr(0, first.find(end));
  if (first.size() <= kDescriptionWidth) return first;
  return first.substr(0, first.rfind(' ', kDescriptionWidth)) + " …";
}

/// A word in single quotes for bash and zsh; fish accepts this form too, except for backslashes.
std::string shell_quoted(const std::string& text) {
  std::string result = "'";
  for (const char character : text) {
    if (character == '\'') {
      result += "'\\''";
    } else {
      result += character;
    }
  }
  return result + "'";
}

Strings names_of(const CLI::Option& option) {
  Strings names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

Strings names_of(const std::vector<const CLI::Option*>& options) {
  Strings names;
  for (const CLI::Option* option : options) {
    for (const std::string& name : names_of(*option)) names.push_back(name);
  }
  return names;
}

Strings names_of(const std::vector<const CLI::App*>& commands) {
  Strings names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

/// Whether a shell should offer the commands for an argument, as for `man`.
bool takes_command(const CLI::Option& argument) { return argument.get_name() == "COMMAND"; }

// --- bash --------------------------------------------------------------------

std::string bash_offer(const ValueWords& words) {
  if (!words.choices.empty())
    return fmt::format("_tagfield_words {}",
                       shell_quoted(fmt::format("{}", fmt::join(words.choices, " "))));
  if (words.is_file) return fmt::format("_tagfield_files {}", fmt::join(words.endings, " "));
  return ":";
}

std::string bash_case(const CLI::App& app, const CLI::App& command) {
  std::string text = fmt::format("    {})\n      case $previous in\n", command.get_name());
  for (const CLI::Option* option : named_options(command)) {
    const ValueWords words = value_words(*option);
    if (!words.is_taken) continue;
    text += fmt::format("        {}) {}; return ;;\n", fmt::join(names_of(*option), "|"),
                        bash_offer(words));
  }
  text += "      esac\n";
  text += fmt::format(
      "      [[ $current != -* ]] || {{ _tagfield_words {}; return; }}\n",
      shell_quoted(fmt::format("{}", fmt::join(names_of(named_options(command)), " "))));
  for (const CLI::Option* argument : arguments_of(command)) {
    text += fmt::format(
        "      {}\n",
        takes_command(*argument)
            ? "_tagfield_words " +
                  shell_quoted(fmt::format("{}", fmt::join(names_of(commands_of(app)), " ")))
            : bash_offer(value_words(*argument)));
  }
  return text + "      ;;\n";
}

constexpr const char* kBashHead =
    R"(# Completion of tagfield for bash, made by 'tagfield completion bash'.
_tagfield_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}

# Folders, and files with one of these endings, or all.
_tagfield_files() {
  compopt -o filenames 2>/dev/null
  local ending
  if (($# == 0)); then
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
    return
  fi
  mapfile -t COMPREPLY < <(
    compgen -d -- "$current"
    for ending in "$@"; do compgen -f -X "!*.$ending" -- "$current"; done
  )
}

_tagfield() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command= i
  COMPREPLY=()
  # KEY=FILE comes as three words.
  [[ $current != = ]] || current=
  [[ $previous != = ]] || previous=${COMP_WORDS[COMP_CWORD - 3]:-}
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] || { command=${COMP_WORDS[i]}; break; }
  done
  case $command in
)";

std::string bash_completion(const CLI::App& app) {
  std::string text = kBashHead;
  Strings first = names_of(commands_of(app));
  for (const std::string& name : names_of(named_options(app))) first.push_back(name);
  text += fmt::format("    '')\n      _tagfield_words {}\n      ;;\n",
                      shell_quoted(fmt::format("{}", fmt::join(first, " "))));
  for (const CLI::App* command : commands_of(app)) text += bash_case(app, *command);
  return text + "  esac\n}\n\ncomplete -F _tagfield tagfield\n";
}

// --- zsh ---------------------------------------------------------------------

/// Text in a specification of _arguments, in which brackets and colons are special.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char character : short_description(text)) {
    if (character == '[' || character == ']' || character == ':' || character == '\\')
      result += '\\';
    result += character;
  }
  return result;
}

std::string zsh_action(const ValueWords& words) {
  if (!words.choices.empty()) return fmt::format("({})", fmt::join(words.choices, " "));
  if (!words.is_file) return "";
  if (words.endings.empty()) return "_files";
  return fmt::format("_files -g \"*.({})(-.)\"", fmt::join(words.endings, "|"));
}

std::string zsh_option(const CLI::Option& option) {
  const ValueWords words = value_words(option);
  std::string text;
  for (const std::string& name : names_of(option)) {
    std::string spec = fmt::format("*{}[{}]", name, zsh_text(option.get_description()));
    if (words.is_taken) spec += fmt::format(":value:{}", zsh_action(words));
    text += fmt::format("        {} \\\n", shell_quoted(spec));
  }
  return text;
}

std::string zsh_case(const CLI::App& command) {
  std::string text = fmt::format("      ({})\n        _arguments \\\n", command.get_name());
  for (const CLI::Option* option : named_options(command)) {
    text.insert(text.size(), zsh_option(*option));
  }
  for (const CLI::Option* argument : arguments_of(command)) {
    const std::string action =
        takes_command(*argument) ? "_tagfield_commands" : zsh_action(value_words(*argument));
    text += fmt::format("        {} \\\n",
                        shell_quoted(fmt::format("::{}:{}", argument->get_name(), action)));
  }
  return text + "        && return 0\n        ;;\n";
}

std::string zsh_completion(const CLI::App& app) {
  std::string text =
      "#compdef tagfield\n# Completion of tagfield for zsh, made by 'tagfield completion zsh'.\n"
      "_tagfield_commands() {\n  local -a commands\n  commands=(\n";
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format(
        "    {}\n", shell_quoted(command->get_name() + ":" + zsh_text(command->get_description())));
  }
  text +=
      "  )\n  _describe -t commands command commands\n}\n\n"
      "_tagfield() {\n  local curcontext=$curcontext state line\n  _arguments -C \\\n";
  for (const CLI::Option* option : named_options(app)) text += zsh_option(*option);
  text +=
      "    '1: :_tagfield_commands' \\\n    '*:: :->rest' && return 0\n"
      "  case $state in\n  (rest)\n    curcontext=\"${curcontext%:*:*}:tagfield-$line[1]:\"\n"
      "    case $line[1] in\n";
  for (const CLI::App* command : commands_of(app)) text += zsh_case(*command);
  return text +
         "    esac\n    ;;\n  esac\n  return 1\n}\n\n"
         "if [[ $funcstack[1] == _tagfield ]]; then\n  _tagfield \"$@\"\nelse\n"
         "  compdef _tagfield tagfield\nfi\n";
}

// --- fish --------------------------------------------------------------------

std::string fish_text(const std::string& text) {
  std::string result = "'";
  for (const char character : short_description(text)) {
    if (character == '\'' || character == '\\') result += '\\';
    result += character;
  }
  return result + "'";
}

std::string fish_files(const ValueWords& words) {
  if (words.endings.empty()) return "__fish_complete_path";
  std::string text;
  for (const std::string& ending : words.endings) {
    text += fmt::format("{}__fish_complete_suffix .{}", text.empty() ? "" : "; ", ending);
  }
  return text;
}

std::string fish_value(const ValueWords& words) {
  if (!words.is_taken) return "";
  if (!words.choices.empty()) return fmt::format(" -x -a '{}'", fmt::join(words.choices, " "));
  if (words.is_file) return fmt::format(" -r -a '({})'", fish_files(words));
  return " -x";
}

std::string fish_option(const CLI::Option& option, const std::string& where) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += " -s " + name;
  for (const std::string& name : option.get_lnames()) names += " -l " + name;
  return fmt::format("complete -c tagfield -n '{}'{}{} -d {}\n", where, names,
                     fish_value(value_words(option)), fish_text(option.get_description()));
}

std::string fish_argument(const CLI::App& app, const CLI::Option& argument,
                          const std::string& where) {
  const ValueWords words = value_words(argument);
  if (takes_command(argument)) {
    return fmt::format("complete -c tagfield -n '{}' -a '{}'\n", where,
                       fmt::join(names_of(commands_of(app)), " "));
  }
  if (!words.choices.empty()) {
    return fmt::format("complete -c tagfield -n '{}' -a '{}'\n", where,
                       fmt::join(words.choices, " "));
  }
  if (!words.is_file) return "";
  return fmt::format("complete -c tagfield -n '{}' -k -a '({})'\n", where, fish_files(words));
}

std::string fish_completion(const CLI::App& app) {
  const std::string first = "__fish_use_subcommand";
  std::string text =
      "# Completion of tagfield for fish, made by 'tagfield completion fish'.\ncomplete -c "
      "tagfield -f\n";
  for (const CLI::Option* option : named_options(app)) text += fish_option(*option, first);
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format("complete -c tagfield -n '{}' -a {} -d {}\n", first, command->get_name(),
                        fish_text(command->get_description()));
  }
  for (const CLI::App* command : commands_of(app)) {
    const std::string where = "__fish_seen_subcommand_from " + command->get_name();
    for (const CLI::Option* option : named_options(*command)) text += fish_option(*option, where);
    for (const CLI::Option* argument : arguments_of(*command)) {
      text += fish_argument(app, *argument, where);
    }
  }
  return text;
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash_completion(app);
  if (shell == "zsh") return zsh_completion(app);
  if (shell == "fish") return fish_completion(app);
  throw Error(fmt::format("completion: there is none for '{}'; expected bash, zsh or fish", shell));
}

namespace {

int print_or_write_script(const std::string& script, const std::string& shell,
                          const std::string& file, bool as_json) {
  if (file.empty()) {
    as_json ? print_json_line({{"shell", shell}, {"script", script}}) : fmt::print("{}", script);
    return kExitOk;
  }
  catch_interrupts();
  write_text_file(file, script);
  if (as_json) print_json_line({{"shell", shell}, {"file", file}});
  return kExitOk;
}

}  // namespace

void add_completion_command(CLI::App& app, Action& chosen) {
  const auto shell = std::make_shared<std::string>();
  const auto file = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  const auto force = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "completion", "Print a script that completes commands, options and files in a shell");
  command->add_option("SHELL", *shell, "Shell to print it for")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->add_option("--out", *file, "File to write it to instead");
  add_json_option(
      *command, *as_json,
      "{\"shell\": SHELL, \"script\": TEXT}, or with --out {\"shell\": SHELL, \"file\": FILE}");
  add_force_option(*command, *force);
  command->footer(
      "Installed packages include it. Otherwise, for this shell alone or in its start-up file:\n"
      "  bash:  source <(tagfield completion bash)\n"
      "  zsh:   source <(tagfield completion zsh)\n"
      "  fish:  tagfield completion fish | source");
  command->callback([shell, file, as_json, force, &app, &chosen] {
    chosen = [shell, file, as_json, force, &app] {
      if (!file->empty()) {
        require_replaceable({"--out", *file, "a completion", {"made by 'tagfield completion"}}, {},
                            *force);
      }
      return print_or_write_script(completion_script(app, *shell), *shell, *file, *as_json);
    };
  });
}

}  // namespace tagfield
