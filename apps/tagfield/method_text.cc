// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/method_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

std::string setting_line(const SettingHelp& help) {
  const std::string unit = help.unit.empty() ? "" : fmt::format(" [{}]", help.unit);
  const std::string range = help.range.empty() ? "" : help.range + ", ";
  return fmt::format("    {:<26} {} ({}else {})\n", help.key + unit, help.meaning, range,
                     help.otherwise);
}

bool is_of_another(const std::vector<Method>& methods, const std::string& key) {
  return std::any_of(methods.begin(), methods.end(), [&](const Method& method) {
    return method.name != "auto" && has_key(method.settings, key);
  });
}

}  // namespace

std::string methods_help() {
  std::string text;
  const std::vector<Method> methods = built_in_methods();
  for (const Method& method : methods) {
    text += fmt::format("{:<16} {}\n", method.name, method.summary);
    for (const SettingHelp& help : method.settings) {
      // Settings of the methods that "auto" chooses among are listed there.
      if (method.name == "auto" && is_of_another(methods, help.key)) continue;
      text += setting_line(help);
    }
  }
  return text;
}

}  // namespace tagfield
