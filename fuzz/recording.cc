// SPDX-License-Identifier: Apache-2.0
// Recordings of ROS: the first byte says of which kind.
#include <array>

#include "adapters/ros1/bag_recording.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  if (size == 0) return 0;
  constexpr std::array<const char*, 3> kNames = {"run.bag", "run.mcap", "run.db3"};
  const std::string path =
      fuzz::folder().write(kNames.at(data[0] % kNames.size()), fuzz::text_of(data + 1, size - 1));
  return fuzz::refused_or_taken([&] {
    Diagnostics unheard;
    read_bag(path, {}, unheard);
  });
}
