// SPDX-License-Identifier: Apache-2.0
// Settings files other than scenarios: the first byte selects the kind.
#include "fuzz/input.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/scenario/calibration_profile.h"
#include "tagfield/scenario/dataset_format.h"
#include "tagfield/scenario/profile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  if (size == 0) return 0;
  const std::string path = fuzz::folder().write("settings.yaml", fuzz::text_of(data + 1, size - 1));
  return fuzz::refused_or_taken([&] {
    switch (data[0] % 4) {
      case 0:
        load_suite(path);
        break;
      case 1:
        read_profile(path);
        break;
      case 2:
        read_dataset_form(path);
        break;
      default:
        read_calibration(path);
    }
  });
}
