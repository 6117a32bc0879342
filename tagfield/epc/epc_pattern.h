// SPDX-License-Identifier: Apache-2.0
/// @file
/// Patterns of EPCs, as the GS1 standards ALE 1.1 and Tag Data Standard write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/epc/epc.h"

namespace tagfield {

/// What a field of a pattern asks for.
struct EpcFieldPattern {
  enum class Kind {
    kAny,    ///< `*`: all are one group.
    kEach,   ///< `X`: any, each value being a group of its own.
    kRange,  ///< `[lo-hi]`: a number, both ends included.
    kText,   ///< Itself.
  };
  Kind kind = Kind::kAny;
  std::uint64_t least = 0;
  std::uint64_t most = 0;
  std::string text;  ///< Of kText.
};

/// Which tags are meant: by fields of a scheme, or by the first hexadecimal digits.
struct EpcPattern {
  std::string text;                 ///< As it was written.
  std::optional<EpcScheme> scheme;  ///< None for hexadecimal digits and `*`.
  bool has_filter = false;          ///< The first field is the filter value.
  std::vector<EpcFieldPattern> fields;
  std::string hex;        ///< Upper case, where there is no scheme.
  bool is_whole = false;  ///< `hex` is all of the ID, not its beginning.
};

/// Of `urn:epc:pat:sgtin-96:3.0614141.[100000-199999].*`, `urn:epc:idpat:sgtin:0614141.*.*`, an
/// EPC's own URI, hexadecimal digits (`30742*`, or all 24), or `*` for all tags. Throws Error that
/// names the pattern where it is malformed.
EpcPattern parse_epc_pattern(const std::string& text);

/// A tag, made ready to be held against patterns.
struct EpcToMatch {
  std::optional<Epc> epc;  ///< epc_of() its ID.
  std::string hex;         ///< Upper case; "" where the ID is neither digits nor a URI.
};

/// Of a tag's ID: a URI, hexadecimal digits, or any other text, which only `*` matches.
EpcToMatch epc_to_match(const std::string& id);

/// Whether the tag is meant.
bool matches(const EpcPattern& pattern, const EpcToMatch& tag);

/// The group that a tag which matches is in: the pattern with each `X` replaced by the tag's own.
std::string group_of(const EpcPattern& pattern, const EpcToMatch& tag);

}  // namespace tagfield
