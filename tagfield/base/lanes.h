// SPDX-License-Identifier: Apache-2.0
/// @file
/// Loops over arrays in the widest vector instructions that the machine has. See
/// docs/architecture.md.
#pragma once

#include <vector>

namespace tagfield {

/// Sets of instructions that loops are compiled for.
enum class InstructionSet {
  kBaseline,  ///< Of every machine that the program runs on: SSE2, NEON.
  kAvx2,
  kAvx512,
};

/// Those of this machine, the widest last.
const std::vector<InstructionSet>& instruction_sets();

namespace lane_internal {

#if defined(__x86_64__) && defined(__GNUC__)
template <class Loops>
[[gnu::target("avx2,bmi2"), gnu::flatten]] void run_avx2(const Loops& loops) {
  loops();
}
#if defined(__clang__)  // It has no such preference, and warns of it.
template <class Loops>
[[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,bmi2"), gnu::flatten]] void run_avx512(
    const Loops& loops) {
  loops();
}
#else
template <class Loops>
[[gnu::target("avx512f,avx512dq,avx512vl,avx512bw,bmi2,prefer-vector-width=512"),
  gnu::flatten]] void
run_avx512(const Loops& loops) {
  loops();
}
#endif
#endif

}  // namespace lane_internal

/// Calls `loops()`, compiled for the instruction set with all that it calls and that is visible.
/// What has no branches (lane_math.h) goes several lanes at once; results are the same bits for
/// each set in rooms that tagfield_plain_arithmetic() is told of.
template <class Loops>
void in_lanes(InstructionSet set, const Loops& loops) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (set == InstructionSet::kAvx512) return lane_internal::run_avx512(loops);
  if (set == InstructionSet::kAvx2) return lane_internal::run_avx2(loops);
#endif
  static_cast<void>(set);
  loops();
}

}  // namespace tagfield
