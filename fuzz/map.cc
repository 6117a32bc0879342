// SPDX-License-Identifier: Apache-2.0
// A map: its YAML, a NUL, its image.
#include "fuzz/input.h"
#include "tagfield/map/map_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  const std::string_view text = fuzz::text_of(data, size);
  const std::size_t end = std::min(text.find('\0'), text.size());
  fuzz::folder().write("map.pgm", text.substr(std::min(text.size(), end + 1)));
  const std::string path = fuzz::folder().write("map.yaml", text.substr(0, end));
  return fuzz::refused_or_taken([&] {
    Diagnostics unheard;
    const OccupancyGrid grid = read_map(path, unheard);
    if (grid.cells.size() !=
        static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height)) {
      std::abort();
    }
  });
}
