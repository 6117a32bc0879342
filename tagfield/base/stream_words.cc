// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/stream_words.h"

#include <Random123/philox.h>

namespace tagfield {

void first_words(std::uint64_t seed, Purpose purpose, std::uint64_t a,
                 std::span<const std::uint64_t> b, std::uint64_t c, std::span<std::uint64_t> first,
                 std::span<std::uint64_t> second) {
  using Philox = r123::Philox4x64;
  const Philox::key_type key{{seed, static_cast<std::uint64_t>(purpose)}};
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Philox::ctr_type block = Philox{}({{a, b[i], c, 0}}, key);
    first[i] = block.v[0];
    second[i] = block.v[1];
  }
}

}  // namespace tagfield
