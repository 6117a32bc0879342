// SPDX-License-Identifier: Apache-2.0
// ROS recordings: the first byte selects the kind, and whether reads are held or read again.
#include <array>
#include <cstdlib>

#include "adapters/bags/bag_recording.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  if (size == 0) return 0;
  constexpr std::array<const char*, 3> kNames = {"run.bag", "run.mcap", "run.db3"};
  const std::string path =
      fuzz::folder().write(kNames.at(data[0] % kNames.size()), fuzz::text_of(data + 1, size - 1));
  return fuzz::refused_or_taken([&] {
    Diagnostics unheard;
    BagOptions options;
    if (data[0] >= 128) options.max_reads = 0;
    const BagRecording bag = read_bag(path, options, unheard);
    if (!bag.unreported) return;
    std::size_t reads = 0;
    bag.unreported->tell({[&reads](const TagRead& /*read*/) { ++reads; }, {}, {}});
    if (reads != bag.unreported->overview.count) std::abort();
  });
}
