// SPDX-License-Identifier: Apache-2.0
// A scenario's YAML, without loading a world.
#include "fuzz/input.h"
#include "tagfield/scenario/scenario_yaml.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  return fuzz::refused_or_taken([&] {
    Diagnostics unheard;
    load_scenario(fuzz::folder().write("scenario.yaml", fuzz::text_of(data, size)), {}, unheard);
  });
}
