// SPDX-License-Identifier: Apache-2.0
/// @file
/// Electronic product codes that fit into 96 bits, by the GS1 EPC Tag Data Standard 1.13: as a pure
/// identity URI, as a tag URI, and as the bits of a tag.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tagfield {

/// What is numbered. GSRNP is of a provider, GSRN of a recipient of a service.
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

/// An EPC, as its URI has it.
struct Epc {
  EpcScheme scheme = EpcScheme::kSgtin;
  int filter = 0;  ///< 0 to 7, of USDoD 0 to 15; GID has none.
  /// What stands between the dots, without the filter: {"0614141", "812345", "6789"}.
  std::vector<std::string> fields;
  friend bool operator==(const Epc&, const Epc&) = default;
};

/// The bits of a tag, the first byte being the header.
using EpcBytes = std::array<std::uint8_t, 12>;

/// Whether it is meant for a URI of an EPC: it begins with "urn:epc:".
bool is_epc_uri(std::string_view text);

/// Of "urn:epc:id:sgtin:0614141.812345.6789", whose filter is 0 ("all others"), or
/// "urn:epc:tag:sgtin-96:3.0614141.812345.6789". Throws Error that names the URI where it is
/// malformed, of another scheme, or doesn't fit into 96 bits.
Epc epc_from_uri(const std::string& uri);

/// "urn:epc:id:sgtin:0614141.812345.6789".
std::string id_uri(const Epc& epc);
/// "urn:epc:tag:sgtin-96:3.0614141.812345.6789".
std::string tag_uri(const Epc& epc);
/// "urn:epc:raw:96.x3074257BF7194E4000001A85", of any bits; `hex` has an even number of digits.
std::string raw_uri(const std::string& hex);

/// Throws Error that names the EPC where a field doesn't fit.
EpcBytes epc_bytes(const Epc& epc);
/// Throws Error that names the bits where their header is no scheme's or a field holds a number
/// that the scheme doesn't allow.
Epc epc_from_bytes(const EpcBytes& bytes);

/// 24 upper-case digits, and back; any case. Throws Error on anything else.
std::string hex_of(const EpcBytes& bytes);
EpcBytes bytes_of_hex(const std::string& hex);

/// Whether all of it is hexadecimal digits, of any case.
bool is_hexadecimal(std::string_view text);

/// The bits that a tag's ID tells, as upper-case hexadecimal digits: of an EPC's URI, or digits
/// whose number is a multiple of 4, as bits of tags come in words of 16. "" for all else.
std::string bits_of_id(const std::string& id);

/// The bits that a tag of this ID sends, as upper-case hexadecimal digits: those that bits_of_id()
/// tells, of at most 62 bytes, which is what a tag has room for. Any other ID of at most 62 bytes
/// is these bytes, with zeros after them up to a whole word and 96 bits; a longer one has 96 bits
/// of a hash. Throws Error on a URI that is malformed.
std::string sent_bits(const std::string& id);

/// What a tag's ID says that is its EPC: a URI, or 24 hexadecimal digits of one of the schemes.
/// None for all else.
std::optional<Epc> epc_of(const std::string& id);

}  // namespace tagfield
