// SPDX-License-Identifier: Apache-2.0
#include "tagfield/epc/epc_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "tagfield/base/error.h"
#include "tagfield/epc/internal/scheme_layout.h"

namespace tagfield {
namespace {

using Kind = EpcFieldPattern::Kind;
constexpr std::string_view kTagPattern = "urn:epc:pat:";
constexpr std::string_view kIdPattern = "urn:epc:idpat:";

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_all = result.ec == std::errc{} && result.ptr == text.data() + text.size();
  return is_all ? std::optional(number) : std::nullopt;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

EpcFieldPattern range_of(const std::string& text) {
  const std::size_t dash = text.find('-');
  if (text.size() < 2 || text.back() != ']' || dash == std::string::npos) {
    throw Error(fmt::format("'{}' must be a range [LEAST-MOST]", text));
  }
  const auto least = whole_number(std::string_view(text).substr(1, dash - 1));
  const auto most = whole_number(std::string_view(text).substr(dash + 1, text.size() - dash - 2));
  if (!least || !most || *least > *most) {
    throw Error(
        fmt::format("'{}' must be a range [LEAST-MOST] of whole numbers in rising order", text));
  }
  return {Kind::kRange, *least, *most, text};
}

bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0; });
}

EpcFieldPattern field_of(const std::string& text) {
  if (text == "*") return {Kind::kAny, 0, 0, text};
  if (text == "X") return {Kind::kEach, 0, 0, text};
  if (!text.empty() && text.front() == '[') return range_of(text);
  if (is_plain(text)) return {Kind::kText, 0, 0, text};
  throw Error(fmt::format("'{}' must be digits, '*', 'X' or [LEAST-MOST]", text));
}

/// Number of fields in URIs of the scheme, excluding the filter.
std::size_t field_count(const SchemeLayout& layout) {
  if (layout.scheme == EpcScheme::kGid) return 3;
  return layout.serial.empty() || layout.scheme == EpcScheme::kUsdod ? 2 : 3;
}

void parse_fields(std::string_view text, EpcPattern& pattern) {
  for (std::size_t begin = 0;;) {
    const std::size_t dot = text.find('.', begin);
    pattern.fields.push_back(field_of(std::string(text.substr(begin, dot - begin))));
    if (dot == std::string_view::npos) return;
    begin = dot + 1;
  }
}

/// `rest` is what follows "urn:epc:pat:" or "urn:epc:idpat:".
void parse_scheme_pattern(std::string_view rest, bool is_tag, EpcPattern& pattern) {
  const std::size_t colon = rest.find(':');
  std::string_view name = rest.substr(0, colon);
  if (is_tag && name.size() > 3 && name.substr(name.size() - 3) == "-96")
    name.remove_suffix(3);
  else if (is_tag)
    name = "";
  const SchemeLayout* layout = layout_named(name);
  if (layout == nullptr || colon == std::string_view::npos) {
    throw Error(fmt::format("'{}' is not a scheme of 96 bits: expected one of {}{}",
                            rest.substr(0, colon), scheme_names(), is_tag ? ", with -96" : ""));
  }
  pattern.scheme = layout->scheme;
  pattern.has_filter = is_tag && layout->scheme != EpcScheme::kGid;
  parse_fields(rest.substr(colon + 1), pattern);
  const std::size_t expected = field_count(*layout) + (pattern.has_filter ? 1 : 0);
  if (pattern.fields.size() != expected) {
    throw Error(
        fmt::format("needs {} fields between dots, has {}", expected, pattern.fields.size()));
  }
}

/// Parses the URI of a single EPC.
void parse_epc_uri(const std::string& text, EpcPattern& pattern) {
  const Epc epc = epc_from_uri(text);
  pattern.scheme = epc.scheme;
  pattern.has_filter = text.find(":tag:") != std::string::npos && epc.scheme != EpcScheme::kGid;
  if (pattern.has_filter) {
    pattern.fields.push_back({Kind::kText, 0, 0, fmt::format("{}", epc.filter)});
  }
  for (const std::string& field : epc.fields) {
    pattern.fields.push_back({Kind::kText, 0, 0, field});
  }
}

void parse_hexadecimal(const std::string& text, EpcPattern& pattern) {
  pattern.is_whole = text.empty() || text.back() != '*';
  pattern.hex = upper(pattern.is_whole ? text : text.substr(0, text.size() - 1));
  if (!is_hexadecimal(pattern.hex) || text.empty()) {
    throw Error(
        "must be urn:epc:pat:…, urn:epc:idpat:…, an EPC's URI, hexadecimal digits that may end in "
        "'*', or '*'");
  }
}

bool begins(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

bool field_matches(const EpcFieldPattern& field, const std::string& value) {
  if (field.kind == Kind::kText) return field.text == value;
  if (field.kind != Kind::kRange) return true;
  const auto number = whole_number(value);
  return number && *number >= field.least && *number <= field.most;
}

/// The fields of an EPC that correspond to the pattern's.
std::vector<std::string> beside(const EpcPattern& pattern, const Epc& epc) {
  std::vector<std::string> values = epc.fields;
  if (pattern.has_filter) values.insert(values.begin(), fmt::format("{}", epc.filter));
  return values;
}

}  // namespace

EpcPattern parse_epc_pattern(const std::string& text) {
  EpcPattern pattern;
  pattern.text = text;
  const std::string_view view = text;
  try {
    if (begins(view, kTagPattern)) {
      parse_scheme_pattern(view.substr(kTagPattern.size()), true, pattern);
    } else if (begins(view, kIdPattern)) {
      parse_scheme_pattern(view.substr(kIdPattern.size()), false, pattern);
    } else if (is_epc_uri(view)) {
      parse_epc_uri(text, pattern);
    } else {
      parse_hexadecimal(text, pattern);
    }
  } catch (const Error& error) {
    throw Error(fmt::format("EPC pattern '{}': {}", text, error.what()));
  }
  return pattern;
}

EpcToMatch epc_to_match(const std::string& id) {
  EpcToMatch tag;
  tag.epc = epc_of(id);
  if (is_epc_uri(id)) {
    if (tag.epc) tag.hex = hex_of(epc_bytes(*tag.epc));
  } else if (is_hexadecimal(id)) {
    tag.hex = upper(id);
  }
  return tag;
}

bool matches(const EpcPattern& pattern, const EpcToMatch& tag) {
  if (!pattern.scheme) {
    return pattern.is_whole ? tag.hex == pattern.hex : begins(tag.hex, pattern.hex);
  }
  if (!tag.epc || tag.epc->scheme != *pattern.scheme) return false;
  const std::vector<std::string> values = beside(pattern, *tag.epc);
  return std::equal(pattern.fields.begin(), pattern.fields.end(), values.begin(), values.end(),
                    field_matches);
}

std::string group_of(const EpcPattern& pattern, const EpcToMatch& tag) {
  const auto is_each = [](const EpcFieldPattern& field) { return field.kind == Kind::kEach; };
  if (std::none_of(pattern.fields.begin(), pattern.fields.end(), is_each)) return pattern.text;
  std::vector<std::string> values = beside(pattern, *tag.epc);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_each(pattern.fields[i])) values[i] = pattern.fields[i].text;
  }
  const std::size_t colon = pattern.text.rfind(':');
  return fmt::format("{}:{}", pattern.text.substr(0, colon), fmt::join(values, "."));
}

}  // namespace tagfield
