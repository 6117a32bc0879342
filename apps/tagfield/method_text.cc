// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/method_text.h"

#include <fmt/format.h>

#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

std::string told_of(const SettingHelp& help) {
  const std::string unit = help.unit.empty() ? "" : fmt::format(" [{}]", help.unit);
  const std::string range = help.range.empty() ? "" : help.range + ", ";
  return fmt::format("    {:<26} {} ({}else {})\n", help.key + unit, help.meaning, range,
                     help.otherwise);
}

}  // namespace

std::string told_of_methods() {
  std::string text;
  for (const Method& method : built_in_methods()) {
    text += fmt::format("{:<16} {}\n", method.name, method.summary);
    // What it chooses among says it.
    if (method.name == "auto") continue;
    for (const SettingHelp& help : method.settings) text += told_of(help);
  }
  return text;
}

}  // namespace tagfield
