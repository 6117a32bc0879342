// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/command_reference.h"

#include <algorithm>
#include <cctype>

namespace tagfield {
namespace {

/// Kinds of files named in help texts, and their extensions.
const std::vector<std::pair<std::string, std::vector<std::string>>>& file_kinds() {
  static const std::vector<std::pair<std::string, std::vector<std::string>>> kKinds = {
      {"YAML", {"yaml", "yml"}}, {"CSV", {"csv"}},    {".sdf", {"sdf"}},     {".world", {"world"}},
      {".bag", {"bag"}},         {".mcap", {"mcap"}}, {".db3", {"db3"}},     {".csv.gz", {"gz"}},
      {".tar.zst", {"zst"}},     {".json", {"json"}}, {".jsonl", {"jsonl"}}, {".xml", {"xml"}}};
  return kKinds;
}

bool has(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

/// The words of "{above,below}".
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}', open);
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

}  // namespace

ValueWords value_words(const CLI::Option& option) {
  ValueWords words;
  const std::string type = option.get_type_name();
  words.is_taken = option.get_items_expected_max() > 0;
  if (!words.is_taken) return words;
  words.choices = choices_in(type);
  const std::string& about = option.get_description();
  const bool is_text = type.empty() || type.rfind("TEXT", 0) == 0 || type == "DIR";
  if (!is_text || !words.choices.empty()) return words;
  for (const auto& [kind, endings] : file_kinds()) {
    if (has(about, kind.c_str())) {
      words.endings.insert(words.endings.end(), endings.begin(), endings.end());
    }
  }
  words.is_file = !words.endings.empty() || type == "DIR" || has(about, "older") ||
                  has(about, "file") || has(about, "File") || has(about, "FILE");
  return words;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> named_options(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) {
    return option->nonpositional() && !option->get_group().empty();  // Others are hidden.
  });
}

std::vector<const CLI::Option*> arguments_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

}  // namespace tagfield
