// SPDX-License-Identifier: Apache-2.0
/// @file
/// Sessions of EPC Gen2: four readers, or four ways of asking, that don't spoil one another's
/// count.
#pragma once

#include <cstdint>

namespace tagfield {

/// A session, which an inventory keeps to (Gen2 v2, section 6.3.2.2).
enum class Session : std::uint8_t { kS0 = 0, kS1 = 1, kS2 = 2, kS3 = 3 };

/// State of a tag's inventoried flag in one session; a tag begins in A.
enum class Flag : std::uint8_t { kA = 0, kB = 1 };

inline Flag inverted(Flag flag) { return flag == Flag::kA ? Flag::kB : Flag::kA; }

}  // namespace tagfield
