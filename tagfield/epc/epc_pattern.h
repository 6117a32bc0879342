// SPDX-License-Identifier: Apache-2.0
/// @file
/// EPC patterns, in the syntax of the GS1 standards ALE 1.1 and Tag Data Standard.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/epc/epc.h"

namespace tagfield {

/// What a field of a pattern matches.
struct EpcFieldPattern {
  enum class Kind {
    kAny,    ///< `*`: all are one group.
    kEach,   ///< `X`: anything, each value being a separate group.
    kRange,  ///< `[lo-hi]`: a number, both ends included.
    kText,   ///< The exact text.
  };
  Kind kind = Kind::kAny;
  std::uint64_t least = 0;
  std::uint64_t most = 0;
  std::string text;  ///< For kText.
};

/// A pattern of tags: by the fields of a scheme, or by leading hexadecimal digits.
struct EpcPattern {
  std::string text;                 ///< As it was written.
  std::optional<EpcScheme> scheme;  ///< None for hexadecimal digits and `*`.
  bool has_filter = false;          ///< The first field is the filter value.
  std::vector<EpcFieldPattern> fields;
  std::string hex;        ///< Upper case; used without a scheme.
  bool is_whole = false;  ///< `hex` is the whole ID, not a prefix.
};

/// Parses `urn:epc:pat:sgtin-96:3.0614141.[100000-199999].*`, `urn:epc:idpat:sgtin:0614141.*.*`,
/// the URI of an EPC, hexadecimal digits (`30742*`, or all 24), or `*` for all tags. Throws Error
/// that names the pattern if it is malformed.
EpcPattern parse_epc_pattern(const std::string& text);

/// A tag, prepared for matching against patterns.
struct EpcToMatch {
  std::optional<Epc> epc;  ///< epc_of() the tag's ID.
  std::string hex;         ///< Upper case; "" if the ID is neither digits nor a URI.
};

/// Prepares a tag's ID: a URI, hexadecimal digits, or any other text, which only `*` matches.
EpcToMatch epc_to_match(const std::string& id);

/// Whether the tag matches the pattern.
bool matches(const EpcPattern& pattern, const EpcToMatch& tag);

/// The group of a matching tag: the pattern with each `X` replaced by the tag's value.
std::string group_of(const EpcPattern& pattern, const EpcToMatch& tag);

}  // namespace tagfield
