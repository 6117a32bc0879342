// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/speed_option.h"

namespace tagfield {

CLI::Option* add_speed_option(CLI::App& command, std::optional<double>& speed,
                              const std::string& otherwise, const std::string& names) {
  return command
      .add_option(names, speed,
                  "Multiple of real time to run at; 0 or max for as fast as it can (default: " +
                      otherwise + ")")
      ->transform([](const std::string& word) { return word == "max" ? std::string("0") : word; })
      ->check([](const std::string& word) -> std::string {
        double multiple = -1.0;
        const bool is_number = CLI::detail::lexical_cast(word, multiple);
        if (is_number && multiple >= 0.0 && multiple <= 1e6) return "";
        return "'" + word + "': expected a multiple of real time up to 1e6, or max";
      });
}

}  // namespace tagfield
