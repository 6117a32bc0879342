// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/tag_epc.h"

#include <fmt/format.h>

#include "tagfield/epc/epc.h"

namespace tagfield {

Words epc_of_id(const std::string& id) {
  constexpr std::size_t kDigits = 4;
  const std::string hex = sent_bits(id);
  Words words;
  for (std::size_t i = 0; i < hex.size(); i += kDigits) {
    words.push_back(static_cast<std::uint16_t>(std::stoul(hex.substr(i, kDigits), nullptr, 16)));
  }
  return words;
}

std::string to_hex(const Words& words) {
  std::string text;
  for (const std::uint16_t word : words) text += fmt::format("{:04X}", word);
  return text;
}

}  // namespace tagfield
