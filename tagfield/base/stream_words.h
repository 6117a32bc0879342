// SPDX-License-Identifier: Apache-2.0
/// @file
/// Words of many random streams in one batch.
#pragma once

#include <cstdint>
#include <span>

#include "tagfield/base/random.h"

namespace tagfield {

/// Writes the first two words of each stream (seed, purpose, a, b[i], c) to `first` and `second`,
/// which are as long as `b`.
void first_words(std::uint64_t seed, Purpose purpose, std::uint64_t a,
                 std::span<const std::uint64_t> b, std::uint64_t c, std::span<std::uint64_t> first,
                 std::span<std::uint64_t> second);

}  // namespace tagfield
