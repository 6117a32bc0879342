// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/lanes.h"

namespace tagfield {

const std::vector<InstructionSet>& instruction_sets() {
  static const std::vector<InstructionSet> sets = [] {
    std::vector<InstructionSet> found = {InstructionSet::kBaseline};
#if defined(__x86_64__) && defined(__GNUC__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")) {
      found.push_back(InstructionSet::kAvx2);
      const bool has_all = __builtin_cpu_supports("avx512f") &&
                           __builtin_cpu_supports("avx512dq") &&
                           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
      if (has_all) found.push_back(InstructionSet::kAvx512);
    }
#endif
    return found;
  }();
  return sets;
}

}  // namespace tagfield
