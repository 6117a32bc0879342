// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/usage_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "tagfield/base/spelling.h"

namespace tagfield {
namespace {

/// Whether a word looks like an option; neither "-", which often means standard input, nor -0.5
/// does.
bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         std::isdigit(static_cast<unsigned char>(word[1])) == 0 && word[1] != '.';
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  return nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest);
}

}  // namespace

std::string usage_fault(const CLI::App& app, const std::string& what) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::string prefix = chosen.empty() ? "" : command.get_name() + ": ";
  const std::string more =
      fmt::format("see tagfield {}--help", chosen.empty() ? "" : command.get_name() + " ");
  const std::vector<std::string> extras = command.remaining();
  // Words after a misspelt option may have been misinterpreted, so the option is reported first.
  const auto option = std::find_if(extras.begin(), extras.end(), looks_like_option);
  if (option != extras.end()) {
    const std::string name = option->substr(0, option->find('='));
    return fmt::format("{}there is no option '{}'{}; {}", prefix, name,
                       did_you_mean(name, option_names(command)), more);
  }
  if (!extras.empty() && chosen.empty()) {
    return fmt::format("there is no command '{}'{}; {}", extras.front(),
                       did_you_mean(extras.front(), command_names(app)), more);
  }
  if (!extras.empty()) {
    return fmt::format("{}'{}' is one argument too many; {}", prefix, extras.front(), more);
  }
  return fmt::format("{}{}; {}", prefix, what, more);
}

}  // namespace tagfield
