#include "tagfield/gen2/tag_epc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tagfield/base/random.h"
#include "tagfield/epc/epc.h"

namespace tagfield {
namespace {

constexpr std::size_t kWords = 6;
constexpr std::size_t kMostDigits = 124;

bool is_hex(const std::string& id) {
  return !id.empty() && id.size() % 4 == 0 && id.size() <= kMostDigits &&
         std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
}

Words words_of(const EpcBytes& bytes) {
  Words words;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    words.push_back(static_cast<std::uint16_t>(unsigned{bytes[i]} << 8U | bytes[i + 1]));
  }
  return words;
}

}  // namespace

Words epc_of_id(const std::string& id) {
  Words words;
  if (is_hex(id)) {
    for (std::size_t i = 0; i < id.size(); i += 4) {
      words.push_back(static_cast<std::uint16_t>(std::stoul(id.substr(i, 4), nullptr, 16)));
    }
    return words;
  }
  if (is_epc_uri(id)) return words_of(epc_bytes(epc_from_uri(id)));
  words.assign(kWords, 0);
  if (id.size() <= 2 * kWords) {
    for (std::size_t i = 0; i < id.size(); ++i) {
      const unsigned byte = static_cast<unsigned char>(id[i]);
      words[i / 2] = static_cast<std::uint16_t>(words[i / 2] | byte << (i % 2 == 0 ? 8U : 0U));
    }
    return words;
  }
  const std::uint64_t high = stream_key(id);
  const std::uint64_t low = stream_key(id + "#");
  for (std::size_t i = 0; i < 4; ++i)
    words[i] = static_cast<std::uint16_t>(high >> (48U - 16U * i));
  words[4] = static_cast<std::uint16_t>(low >> 16U);
  words[5] = static_cast<std::uint16_t>(low);
  return words;
}

std::string to_hex(const Words& words) {
  std::string text;
  for (const std::uint16_t word : words) text += fmt::format("{:04X}", word);
  return text;
}

}  // namespace tagfield
