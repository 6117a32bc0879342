// SPDX-License-Identifier: Apache-2.0
// Archives of tables: the first byte selects the kind.
#include <array>

#include "adapters/archive/unpacked_archive.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  if (size == 0) return 0;
  constexpr std::array<const char*, 4> kNames = {"a.tar", "a.tar.gz", "a.tar.zst", "a.csv.xz"};
  const std::string path =
      fuzz::folder().write(kNames.at(data[0] % kNames.size()), fuzz::text_of(data + 1, size - 1));
  return fuzz::refused_or_taken([&] {
    // Small limits, as decompression bombs would only fill the disk.
    const ArchiveLimits limits = {.bytes = std::uint64_t{1} << 20U, .entries = 100};
    const UnpackedArchive unpacked(path, limits);
    const std::filesystem::path tables = unpacked.tables();
    if (tables.lexically_relative(unpacked.folder()).string().starts_with("..")) std::abort();
  });
}
