// SPDX-License-Identifier: Apache-2.0
// Tables: the first byte selects the kind.
#include "fuzz/input.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/files/tag_positions_csv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  if (size == 0) return 0;
  const std::string path = fuzz::folder().write("table.csv", fuzz::text_of(data + 1, size - 1));
  return fuzz::refused_or_taken([&] {
    switch (data[0] % 4) {
      case 0: {
        // A table that was read can be written and read again.
        const std::string again =
            fuzz::folder().write("again.csv", reads_to_csv(read_reads_csv(path)));
        read_reads_csv(again);
        break;
      }
      case 1:
        read_poses_csv(path);
        break;
      case 2:
        read_tag_positions_csv(path);
        break;
      default:
        read_tag_heights_csv(path);
    }
  });
}
