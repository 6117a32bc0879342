// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/random.h"

#include <Random123/philox.h>

#include <Random123/boxmuller.hpp>

namespace tagfield {

std::uint64_t stream_key(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char character : name) {
    hash ^= static_cast<unsigned char>(character);
    hash *= 0x100000001b3U;
  }
  return hash;
}

RandomStream::RandomStream(std::uint64_t seed, Purpose purpose, std::uint64_t a, std::uint64_t b,
                           std::uint64_t c)
    : key_{seed, static_cast<std::uint64_t>(purpose)}, counter_{a, b, c, 0} {}

RandomStream::result_type RandomStream::operator()() {
  if (used_ == block_.size()) refill();
  return block_[used_++];
}

void RandomStream::refill() {
  using Philox = r123::Philox4x64;
  const Philox::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
  const Philox::key_type key{{key_[0], key_[1]}};
  const Philox::ctr_type block = Philox{}(counter, key);
  for (std::size_t i = 0; i < block_.size(); ++i) block_[i] = block.v[i];
  ++counter_[3];
  used_ = 0;
}

std::array<double, 2> standard_normal_pair(RandomStream& stream) {
  const std::uint64_t first = stream();
  const std::uint64_t second = stream();
  const r123::double2 pair = r123::boxmuller(first, second);
  return {pair.x, pair.y};
}

}  // namespace tagfield
