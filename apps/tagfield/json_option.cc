// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/json_option.h"

namespace tagfield {

CLI::Option* add_json_option(CLI::App& command, bool& as_json, const std::string& form) {
  const std::string what = "Print JSON for machines instead of text";
  return command.add_flag("--json", as_json, form.empty() ? what : what + ": " + form);
}

}  // namespace tagfield
