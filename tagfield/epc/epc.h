// SPDX-License-Identifier: Apache-2.0
/// @file
/// Electronic product codes that fit into 96 bits, by the GS1 EPC Tag Data Standard 1.13: as pure
/// identity URIs, tag URIs, and the bits of a tag.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tagfield {

/// The scheme of an EPC. GSRNP identifies the provider of a service, GSRN its recipient.
enum class EpcScheme {
  kSgtin,
  kSscc,
  kSgln,
  kGrai,
  kGiai,
  kGsrn,
  kGsrnp,
  kGdti,
  kCpi,
  kGid,
  kUsdod
};

/// An EPC, with the fields of its URI.
struct Epc {
  EpcScheme scheme = EpcScheme::kSgtin;
  int filter = 0;  ///< 0 to 7, for USDoD 0 to 15; GID has none.
  /// The fields between the dots, without the filter: {"0614141", "812345", "6789"}.
  std::vector<std::string> fields;
  friend bool operator==(const Epc&, const Epc&) = default;
};

/// The bits of a tag, the first byte being the header.
using EpcBytes = std::array<std::uint8_t, 12>;

/// Whether the text is meant to be an EPC URI: it begins with "urn:epc:".
bool is_epc_uri(std::string_view text);

/// Parses "urn:epc:id:sgtin:0614141.812345.6789", whose filter is 0 ("all others"), or
/// "urn:epc:tag:sgtin-96:3.0614141.812345.6789". Throws Error that names the URI if it is
/// malformed, of another scheme, or doesn't fit into 96 bits.
Epc epc_from_uri(const std::string& uri);

/// "urn:epc:id:sgtin:0614141.812345.6789".
std::string id_uri(const Epc& epc);
/// "urn:epc:tag:sgtin-96:3.0614141.812345.6789".
std::string tag_uri(const Epc& epc);
/// "urn:epc:raw:96.x3074257BF7194E4000001A85", for any bits; `hex` must have an even number of
/// digits.
std::string raw_uri(const std::string& hex);

/// Throws Error that names the EPC if a field doesn't fit.
EpcBytes epc_bytes(const Epc& epc);
/// Throws Error that names the bits if their header belongs to no scheme or a field holds a number
/// that the scheme doesn't allow.
Epc epc_from_bytes(const EpcBytes& bytes);

/// 24 upper-case hexadecimal digits, and back from digits of any case. Throws Error on anything
/// else.
std::string hex_of(const EpcBytes& bytes);
EpcBytes bytes_of_hex(const std::string& hex);

/// Whether all characters are hexadecimal digits, of any case.
bool is_hexadecimal(std::string_view text);

/// The bits given by a tag's ID, as upper-case hexadecimal digits: those of an EPC URI, or the ID
/// itself if it is hexadecimal digits in a multiple of 4, as tags store 16-bit words. "" for
/// anything else.
std::string bits_of_id(const std::string& id);

/// The bits that a tag with this ID sends, as upper-case hexadecimal digits: those of bits_of_id(),
/// if they are at most 62 bytes, the capacity of a tag. Any other ID of at most 62 bytes is sent as
/// its bytes, padded with zeros to a whole word and at least 96 bits; a longer one as a 96-bit
/// hash.
std::string sent_bits(const std::string& id);

/// The EPC given by a tag's ID: a URI, or 24 hexadecimal digits of one of the schemes. None for
/// anything else.
std::optional<Epc> epc_of(const std::string& id);

}  // namespace tagfield
