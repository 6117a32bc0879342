// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/json_line.h"

#include <fmt/format.h>

namespace tagfield {

void print_json_line(const nlohmann::ordered_json& json) {
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace tagfield
