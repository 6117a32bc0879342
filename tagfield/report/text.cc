// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tagfield {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// Length of the UTF-8 sequence that begins with `lead`; 0 if none does.
std::size_t sequence_size(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

char32_t code_point(std::string_view sequence) {
  if (sequence.size() == 1) return static_cast<unsigned char>(sequence[0]);
  const unsigned lead_mask = 0x7FU >> sequence.size();
  char32_t code = static_cast<unsigned char>(sequence[0]) & lead_mask;
  for (const char byte : sequence.substr(1)) {
    code = (code << 6U) | (static_cast<unsigned char>(byte) & 0x3FU);
  }
  return code;
}

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// Whether the character is not overlong, a surrogate, beyond Unicode, forbidden in XML, or one of
/// the marks that change the text direction.
bool is_harmless(char32_t code, std::size_t size) {
  constexpr char32_t kLeast[] = {0, 0x20, 0x80, 0x800, 0x10000};
  const bool control = code == 0x7F || (code >= 0x80 && code < 0xA0);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  const bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return code >= kLeast[size] && code <= 0x10FFFF && !control && !surrogate && !turns &&
         (code & 0xFFFEU) != 0xFFFE;
}

/// The well-formed, harmless character at the front of `text`, if there is one.
std::optional<std::string_view> front_character(std::string_view text) {
  const std::size_t size = sequence_size(static_cast<unsigned char>(text.front()));
  if (size == 0 || size > text.size()) return std::nullopt;
  const std::string_view sequence = text.substr(0, size);
  if (!std::all_of(sequence.begin() + 1, sequence.end(), continues)) return std::nullopt;
  if (!is_harmless(code_point(sequence), size)) return std::nullopt;
  return sequence;
}

std::string_view entity(char character) {
  switch (character) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return "";
  }
}

/// Byte offset of the character with this index in well-formed UTF-8.
std::size_t offset_of(std::string_view text, std::size_t index) {
  std::size_t offset = 0;
  for (; index > 0; --index) offset += sequence_size(static_cast<unsigned char>(text[offset]));
  return offset;
}

unsigned char byte_of(char character) { return static_cast<unsigned char>(character); }

bool is_digit(char character) { return character >= '0' && character <= '9'; }

/// Removes the digits at the front of `text` and returns them without leading zeros.
std::string_view take_number(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  std::string_view digits = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

}  // namespace

std::string clean_text(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const bool blank = text.front() == '\t' || text.front() == '\n' || text.front() == '\r';
    const auto character = front_character(text);
    clean += blank ? " " : character.value_or(kReplacement);
    text.remove_prefix(character ? character->size() : 1);
  }
  return clean;
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char character : clean_text(text)) {
    const std::string_view name = entity(character);
    if (name.empty()) {
      safe += character;
    } else {
      safe += name;
    }
  }
  return safe;
}

std::string breakable(std::string_view text) {
  std::string safe;
  for (const char character : clean_text(text)) {
    const std::string_view name = entity(character);
    safe += name.empty() ? std::string_view(&character, 1) : name;
    if (character == '_' || character == '-' || character == '/' || character == '.') {
      safe += "<wbr>";
    }
  }
  return safe;
}

std::size_t length_of(std::string_view text) {
  const auto inner = std::count_if(text.begin(), text.end(), continues);
  return text.size() - static_cast<std::size_t>(inner);
}

std::string shortened(std::string_view text, std::size_t most) {
  std::string clean = clean_text(text);
  const std::size_t length = length_of(clean);
  if (length <= most) return clean;
  const std::size_t head = (most - 1) / 2;
  const std::size_t tail = most - 1 - head;
  return fmt::format("{}…{}", clean.substr(0, offset_of(clean, head)),
                     clean.substr(offset_of(clean, length - tail)));
}

bool natural_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view number_a = take_number(a);
      const std::string_view number_b = take_number(b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
    } else {
      if (a.front() != b.front()) return byte_of(a.front()) < byte_of(b.front());
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // Such as 7 and 07.
}

std::string spoken_length(double length_m) {
  if (length_m < 0.00995) return fmt::format("{:.1f} mm", length_m * 1e3);
  if (length_m < 0.9995) return fmt::format("{:.0f} mm", length_m * 1e3);
  return fmt::format("{:.2f} m", length_m);
}

std::string grouped(std::size_t number) {
  std::string digits = fmt::format("{}", number);
  for (std::size_t place = digits.size(); place > 3;) {
    place -= 3;
    digits.insert(place, 1, ',');
  }
  return digits;
}

std::string tally(double number) {
  const double whole = std::round(number);
  if (std::abs(number - whole) < 0.005) return grouped(static_cast<std::size_t>(whole));
  return fmt::format("{:.1f}", number);
}

std::string percent_of(double part, double all) {
  if (all <= 0.0) return "–";
  const double share = part / all;
  if (share == 0.0 || share == 1.0) return fmt::format("{:.0f} %", 100.0 * share);
  return fmt::format("{:.1f} %", std::clamp(100.0 * share, 0.1, 99.9));
}

std::string counted(std::size_t number, const std::string& noun) {
  return fmt::format("{} {}{}", grouped(number), noun, number == 1 ? "" : "s");
}

}  // namespace tagfield
