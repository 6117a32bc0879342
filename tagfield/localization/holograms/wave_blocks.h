// SPDX-License-Identifier: Apache-2.0
/// @file
/// Waves of many reads added up over blocks of cells: rougher than wave_sums.h, and faster.
#pragma once

#include <cstddef>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/grid_search.h"
#include "tagfield/localization/holograms/wave_sums.h"

namespace tagfield {

/// Σ cos and Σ sin of the residuals φ − 2r/λ at each cell of a block.
struct BlockSums {
  BlockLight in_phase;
  BlockLight quadrature;
};

/// Of `count` reads. About the block's middle the distance r(u, v) is taken for
/// r(u, 0) + r(0, v) − r(0, 0), so that a wave is the product of one for its column and one for its
/// row, and their sum over the reads one of matrices. That leaves out −u v x y/r³ and terms of
/// third order: at most |u v|/2r, 2 cm/r at the corners of blocks of 44 cm and a third of it in the
/// mean (rms). The same to the last bit for each set of instructions.
BlockSums block_sums(const SearchRead* reads, std::size_t count, const CellBlock& block,
                     InstructionSet set = instruction_sets().back());

/// As wave_amplitudes(), by such sums.
BlockLight block_amplitudes(const SearchReads& reads, const CellBlock& block,
                            InstructionSet set = instruction_sets().back());

}  // namespace tagfield
