// SPDX-License-Identifier: Apache-2.0
#include "tagfield/epc/epc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tagfield/base/error.h"
#include "tagfield/base/random.h"
#include "tagfield/epc/internal/scheme_layout.h"

namespace tagfield {
namespace {

/// A tag gives the length of its EPC in 5 bits, in 16-bit words.
constexpr std::size_t kMaxBytes = 62;

constexpr std::string_view kUrn = "urn:epc:";
constexpr std::string_view kIdUrn = "urn:epc:id:";
constexpr std::string_view kTagUrn = "urn:epc:tag:";

bool begins_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

std::vector<std::string> split_at_dots(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t dot = text.find('.', begin);
    parts.emplace_back(text.substr(begin, dot - begin));
    if (dot == std::string_view::npos) return parts;
    begin = dot + 1;
  }
}

std::string joined(const std::vector<std::string>& fields) {
  return fmt::format("{}", fmt::join(fields, "."));
}

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// Removes the scheme's name and its colon from the front of `rest`.
EpcScheme take_scheme(std::string_view& rest, std::string_view suffix) {
  const std::size_t colon = rest.find(':');
  std::string_view name = rest.substr(0, colon);
  const bool has_suffix =
      name.size() > suffix.size() && name.substr(name.size() - suffix.size()) == suffix;
  const SchemeLayout* layout =
      has_suffix ? layout_named(name.substr(0, name.size() - suffix.size())) : nullptr;
  if (layout == nullptr || colon == std::string_view::npos) {
    throw Error(fmt::format("'{}' is not a scheme of 96 bits: expected one of {}{}", name,
                            scheme_names(),
                            suffix.empty() ? "" : fmt::format(", with {}", suffix)));
  }
  rest.remove_prefix(colon + 1);
  return layout->scheme;
}

int take_filter(std::vector<std::string>& fields) {
  const std::string text = fields.front();
  fields.erase(fields.begin());
  return static_cast<int>(number_of({"filter", 4, 2, false}, text));
}

Epc parsed(std::string_view uri) {
  Epc epc;
  if (begins_with(uri, kIdUrn)) {
    uri.remove_prefix(kIdUrn.size());
    epc.scheme = take_scheme(uri, "");
    epc.fields = split_at_dots(uri);
  } else if (begins_with(uri, kTagUrn)) {
    uri.remove_prefix(kTagUrn.size());
    epc.scheme = take_scheme(uri, "-96");
    epc.fields = split_at_dots(uri);
    if (epc.scheme != EpcScheme::kGid) epc.filter = take_filter(epc.fields);
  } else {
    throw Error("must begin with urn:epc:id: or urn:epc:tag:");
  }
  return epc;
}

}  // namespace

bool is_epc_uri(std::string_view text) { return begins_with(text, kUrn); }

Epc epc_from_uri(const std::string& uri) {
  Epc epc;
  try {
    epc = parsed(uri);
  } catch (const Error& error) {
    throw Error(fmt::format("EPC '{}': {}", uri, error.what()));
  }
  epc_bytes(epc);
  return epc;
}

std::string id_uri(const Epc& epc) {
  return fmt::format("{}{}:{}", kIdUrn, layout_of(epc.scheme).name, joined(epc.fields));
}

std::string tag_uri(const Epc& epc) {
  const std::string filter =
      epc.scheme == EpcScheme::kGid ? std::string() : fmt::format("{}.", epc.filter);
  return fmt::format("{}{}-96:{}{}", kTagUrn, layout_of(epc.scheme).name, filter,
                     joined(epc.fields));
}

std::string raw_uri(const std::string& hex) {
  return fmt::format("urn:epc:raw:{}.x{}", 4 * hex.size(), upper_case(hex));
}

std::string hex_of(const EpcBytes& bytes) {
  std::string hex;
  for (const std::uint8_t byte : bytes) hex += fmt::format("{:02X}", byte);
  return hex;
}

EpcBytes bytes_of_hex(const std::string& hex) {
  EpcBytes bytes{};
  if (hex.size() != 2 * bytes.size() || !is_hexadecimal(hex)) {
    throw Error(fmt::format("EPC '{}' must be 24 hexadecimal digits", hex));
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(std::stoi(hex.substr(2 * i, 2), nullptr, 16));
  }
  return bytes;
}

bool is_hexadecimal(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isxdigit(c) != 0; });
}

std::string bits_of_id(const std::string& id) {
  if (!id.empty() && id.size() % 4 == 0 && is_hexadecimal(id)) return upper_case(id);
  const std::optional<Epc> epc = is_epc_uri(id) ? epc_of(id) : std::nullopt;
  return epc ? hex_of(epc_bytes(*epc)) : "";
}

std::string sent_bits(const std::string& id) {
  std::string bits = bits_of_id(id);
  if (!bits.empty() && bits.size() <= 2 * kMaxBytes) return bits;
  if (id.size() > kMaxBytes) {
    return fmt::format("{:016X}{:08X}", stream_key(id), stream_key(id + "#") & 0xffff'ffffU);
  }
  std::string hex;
  for (const char c : id) hex += fmt::format("{:02X}", static_cast<unsigned char>(c));
  const std::size_t bytes = std::max(std::tuple_size_v<EpcBytes>, (id.size() + 1) / 2 * 2);
  hex.resize(2 * bytes, '0');
  return hex;
}

std::optional<Epc> epc_of(const std::string& id) {
  try {
    return is_epc_uri(id) ? epc_from_uri(id) : epc_from_bytes(bytes_of_hex(id));
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace tagfield
