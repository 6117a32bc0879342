// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_line.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/shared_folder.h"
#include "tagfield/base/error.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaceholder = "NAME";

std::string filled_in(std::string text, const std::string& name) {
  const std::string placeholder = kPlaceholder;
  for (std::size_t at = text.find(placeholder); at != std::string::npos;
       at = text.find(placeholder, at + name.size())) {
    text.replace(at, placeholder.size(), name);
  }
  return text;
}

/// Throws Error unless the name is valid for a folder, a scenario and a world.
void check_name(const std::string& name) {
  if (name.empty() || folder_name(name) != name || name[0] == '-' || name[0] == '.') {
    throw Error(
        fmt::format("new: '{}' is not a valid name: expected letters, digits, '-', '_' and '.', as "
                    "in 'my_hall'",
                    name));
  }
}

int make_new(const std::string& path, bool as_json) {
  const fs::path folder = fs::path(path).lexically_normal();
  const std::string name =
      (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  check_name(name);
  std::error_code error;
  if (fs::exists(folder, error)) {
    throw Error(fmt::format("new: {} exists already and is not changed", folder.string()));
  }
  const fs::path from = shared_folder("templates") / "new";
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& [source, target] :
       {std::pair<const char*, std::string>{"scenario.yaml", name + ".yaml"},
        {"world.sdf", name + ".sdf"},
        {"analyse.py", "analyse.py"}}) {
    files.emplace_back(folder / target, filled_in(read_text_file((from / source).string()), name));
  }
  if (!fs::create_directories(folder, error) && error) {
    throw Error(fmt::format("new: can't make the folder {}: {}", folder.string(), error.message()));
  }
  write_text_files(files);
  if (as_json) {
    nlohmann::ordered_json all = {{"folder", folder.string()}};
    for (const auto& [file, text] : files) all["files"].push_back(file);
    print_json_line(all);
    return kExitOk;
  }
  const std::string scenario = (folder / (name + ".yaml")).string();
  fmt::print(
      "{}: a cart drives past two racks and finds four tags\n\n"
      "  {}.yaml   the scenario: robots, antennas and tags\n"
      "  {}.sdf    the hall, a world in Gazebo's format\n"
      "  analyse.py{}   many seeds in Python, with figures\n\n"
      "Next:\n  tagfield check {}\n  tagfield run {}\n  python3 {}\n",
      folder.string(), name, name, std::string(name.size() > 5 ? name.size() - 5 : 0, ' '),
      scenario, scenario, (folder / "analyse.py").string());
  return kExitOk;
}

}  // namespace

void add_new_command(CLI::App& app, Action& chosen) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "new", "Begin your own scenario: a folder with scenario, world and script");
  command->add_option("NAME", *name, "Folder to make; its last part names scenario and world")
      ->required();
  command->footer(
      "The files are commented and run as they are:\n"
      "  tagfield new my_hall\n"
      "  tagfield run my_hall/my_hall.yaml\n"
      "docs/scenario.md lists all keys of a scenario.");
  const auto as_json = std::make_shared<bool>(false);
  add_json_option(*command, *as_json, "{\"folder\": …, \"files\": […]}");
  command->callback(
      [name, as_json, &chosen] { chosen = [name, as_json] { return make_new(*name, *as_json); }; });
}

}  // namespace tagfield
