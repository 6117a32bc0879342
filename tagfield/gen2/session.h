// SPDX-License-Identifier: Apache-2.0
/// @file
/// Sessions of EPC Gen2: up to four readers can inventory the same tags without disturbing each
/// other's flags.
#pragma once

#include <cstdint>

namespace tagfield {

/// The session of an inventory (Gen2 v2, section 6.3.2.2).
enum class Session : std::uint8_t { kS0 = 0, kS1 = 1, kS2 = 2, kS3 = 3 };

/// State of a tag's inventoried flag in one session; initially A.
enum class Flag : std::uint8_t { kA = 0, kB = 1 };

inline Flag inverted(Flag flag) { return flag == Flag::kA ? Flag::kB : Flag::kA; }

}  // namespace tagfield
