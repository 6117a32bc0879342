// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/tagfield/build_info.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/command_reference.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_line.h"
#include "apps/tagfield/json_option.h"
#include "tagfield/base/error.h"
#include "tagfield/base/spelling.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

struct ManArguments {
  std::string command;
  std::string folder;
  bool as_json = false;
};

const CLI::App& page_of(const CLI::App& app, const std::string& name) {
  if (name.empty()) return app;
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) {
    if (command->get_name() == name) return *command;
    names.push_back(command->get_name());
  }
  throw Error(fmt::format("man: there is no command '{}'{}", name, suggestion(name, names)));
}

int print_or_write(const CLI::App& app, const ManArguments& arguments) {
  const BuildInfo build = build_info();
  if (arguments.folder.empty()) {
    const std::string page = man_page(page_of(app, arguments.command), build.version, build.date);
    arguments.as_json ? print_json_line({{"page", page}}) : fmt::print("{}", page);
    return kExitOk;
  }
  std::vector<const CLI::App*> pages = commands_of(app);
  pages.push_back(&app);
  std::vector<std::pair<std::string, std::string>> files;
  files.reserve(pages.size());
  for (const CLI::App* page : pages) {
    files.emplace_back(std::filesystem::path(arguments.folder) / (page_name(*page) + ".1"),
                       man_page(*page, build.version, build.date));
  }
  write_text_files(files);
  if (!arguments.as_json) return kExitOk;
  nlohmann::ordered_json json = {{"files", nlohmann::ordered_json::array()}};
  for (const auto& [path, text] : files) json["files"].push_back(path);
  print_json_line(json);
  return kExitOk;
}

}  // namespace

void add_man_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<ManArguments>();
  CLI::App* command =
      app.add_subcommand("man", "Print a page of the manual, of tagfield or of a command");
  CLI::Option* name =
      command->add_option("COMMAND", arguments->command, "Command that it describes");
  command->add_option("--out", arguments->folder, "Write all pages into this folder instead")
      ->excludes(name);
  add_json_option(*command, arguments->as_json, "{\"page\": TEXT}, or with --out {\"files\": […]}");
  command->footer(
      "Installed packages include the pages: man tagfield-run. Otherwise:\n"
      "  tagfield man run | man -l -");
  command->callback([arguments, &app, &chosen] {
    chosen = [arguments, &app] { return print_or_write(app, *arguments); };
  });
}

}  // namespace tagfield
