// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/speed_option.h"

namespace tagfield {

CLI::Option* add_speed_option(CLI::App& command, std::optional<double>& speed,
                              const std::string& otherwise, const std::string& names) {
  return command
      .add_option(names, speed,
                  "Multiple of real time to run at; 0 or max for as fast as it can (default: " +
                      otherwise + ")")
      ->transform([](std::string word) { return word == "max" ? std::string("0") : word; })
      ->check(CLI::Range(0.0, 1e6));
}

}  // namespace tagfield
