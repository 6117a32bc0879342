// SPDX-License-Identifier: Apache-2.0
// An MCAP file, all of its messages.
#include "adapters/mcap/mcap_reader.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  const std::string path = fuzz::folder().write("file.mcap", fuzz::text_of(data, size));
  return fuzz::refused_or_taken([&] {
    Diagnostics unheard;
    McapReader reader(path, unheard);
    std::size_t bytes = 0;
    reader.read([&](const McapMessage& message) { bytes += message.bytes.size(); });
  });
}
