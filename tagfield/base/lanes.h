// SPDX-License-Identifier: Apache-2.0
/// @file
/// Loops over arrays with the widest vector instructions of the machine. See docs/architecture.md.
#pragma once

#include <vector>

namespace tagfield {

/// Instruction sets that loops are compiled for.
enum class InstructionSet {
  kBaseline,  ///< On every machine that the program runs on: SSE2, NEON.
  kAvx2,
  kAvx512,
};

/// The sets that this machine supports, the widest last.
const std::vector<InstructionSet>& instruction_sets();

namespace lane_internal {

#if defined(__x86_64__) && defined(__GNUC__)
template <class Loops>
[[gnu::target("avx2,bmi2"), gnu::flatten]] void run_avx2(const Loops& loops) {
  loops();
}
#if defined(__clang__)  // Clang has no such preference, and would warn.
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

/// Calls `loops()`, compiled for the instruction set together with every visible function that it
/// calls. Branch-free code (lane_math.h) is vectorized. Results are bit-identical for all sets in
/// rooms built with tagfield_plain_arithmetic().
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
