// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/message_location.h"

#include <fmt/format.h>

#include "tagfield/base/error.h"

namespace tagfield {

std::string to_string(const MessageLocation& place) {
  return fmt::format("{}: topic {}, message {}", place.file, place.topic, place.number);
}

void fail_at(const MessageLocation& place, const std::string& message) {
  throw Error(fmt::format("{}: {}", to_string(place), message));
}

}  // namespace tagfield
