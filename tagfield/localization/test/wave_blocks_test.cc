// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/wave_blocks.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "made_search_reads.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;

CellBlock some_block(made::Rng& rng) {
  return {made::some(rng, 12.0), made::some(rng, 12.0),
          static_cast<float>(made::uniform(rng, 0.005, 0.05))};
}

double metres(const SearchRead& read, double x, double y) {
  return std::hypot(x - static_cast<double>(read.x), y - static_cast<double>(read.y),
                    static_cast<double>(read.z));
}

double turns(const SearchRead& read, double r) {
  return static_cast<double>(read.turns) - static_cast<double>(read.turns_per_metre) * r;
}

/// Offset of a cell from its block's middle along one axis [m].
double from_middle(const CellBlock& block, int k) {
  return (k - 0.5 * (kBlock - 1)) * static_cast<double>(block.cell_m);
}
double middle_x(const CellBlock& block) {
  return static_cast<double>(block.x) - from_middle(block, 0);
}
double middle_y(const CellBlock& block) {
  return static_cast<double>(block.y) - from_middle(block, 0);
}

/// Result of block_sums() for a cell.
Complex at(const BlockSums& sums, int i, int j) {
  return {static_cast<double>(sums.in_phase(i, j)), static_cast<double>(sums.quadrature(i, j))};
}

/// Compares each cell of a random block with the sum over the reads of phasors for the distance
/// `metres_at(read, x, y, u, v)`, with (x, y) the block's middle and (u, v) the cell relative to
/// it. The tolerance is the sum of `allowed` over the reads.
template <class MetresAt, class Allowed>
void hold_sums_against(const MetresAt& metres_at, const Allowed& allowed) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const std::vector<SearchRead> reads = made::search_reads(rng, 80);
  const CellBlock block = some_block(rng);
  const BlockSums sums = block_sums(reads.data(), reads.size(), block);
  const double x = middle_x(block);
  const double y = middle_y(block);
  for (int i = 0; i < kBlock; ++i) {
    for (int j = 0; j < kBlock; ++j) {
      const double u = from_middle(block, i);
      const double v = from_middle(block, j);
      Complex sum = 0.0;
      double most = 0.0;
      for (const SearchRead& read : reads) {
        sum += std::polar(1.0, kTwoPi * turns(read, metres_at(read, x, y, u, v)));
        most += allowed(read, block, u, v);
      }
      RC_ASSERT(std::abs(at(sums, i, j) - sum) < most);
    }
  }
}

/// Single precision represents 100 cycles to 4·10⁻⁶ of a cycle, and three such terms are combined.
constexpr double kRounding = 6e-4;

RC_GTEST_PROP(WaveBlocks, AreThoseOfDistancesPutTogetherFromRowAndColumn, ()) {
  hold_sums_against(
      [](const SearchRead& read, double x, double y, double u, double v) {
        return metres(read, x + u, y) + metres(read, x, y + v) - metres(read, x, y);
      },
      [](const SearchRead&, const CellBlock&, double, double) { return kRounding; });
}

/// |∂²r/∂x∂y| = |x y|/r³ is at most 1/2r, with r the least distance in the block.
RC_GTEST_PROP(WaveBlocks, AreNearThoseOfTheDistances, ()) {
  hold_sums_against([](const SearchRead& read, double x, double y, double u,
                       double v) { return metres(read, x + u, y + v); },
                    [](const SearchRead& read, const CellBlock& block, double u, double v) {
                      const double to_corner = std::sqrt(2.0) * from_middle(block, kBlock - 1);
                      const double nearest = std::max(
                          metres(read, middle_x(block), middle_y(block)) - to_corner, 1e-3);
                      const double off_m = std::abs(u * v) / (2.0 * nearest);
                      const double turned =
                          kTwoPi * static_cast<double>(read.turns_per_metre) * off_m;
                      return kRounding + std::min(2.0, turned);
                    });
}

RC_GTEST_PROP(WaveBlocks, AreTheSameBitsInEachSetOfInstructions, ()) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const std::vector<SearchRead> reads = made::search_reads(rng, 80);
  const CellBlock block = some_block(rng);
  const BlockSums sums = block_sums(reads.data(), reads.size(), block, InstructionSet::kBaseline);
  const InstructionSet set = *rc::gen::elementOf(instruction_sets());
  const BlockSums others = block_sums(reads.data(), reads.size(), block, set);
  RC_ASSERT((sums.in_phase == others.in_phase).all());
  RC_ASSERT((sums.quadrature == others.quadrature).all());
}

RC_GTEST_PROP(WaveBlocks, AmplitudesAreThoseOfEachAperture, ()) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const SearchReads reads = made::with_apertures(rng, made::search_reads(rng, 80));
  const CellBlock block = some_block(rng);
  BlockLight expected = BlockLight::Zero();
  for (const Aperture& aperture : reads.apertures) {
    const BlockSums sums = block_sums(&reads.reads[static_cast<std::size_t>(aperture.begin)],
                                      static_cast<std::size_t>(aperture.count), block);
    for (Eigen::Index k = 0; k < expected.size(); ++k) {
      expected(k) += made::amplitude(aperture, sums.in_phase(k), sums.quadrature(k));
    }
  }
  const InstructionSet set = *rc::gen::elementOf(instruction_sets());
  RC_ASSERT((block_amplitudes(reads, block, set) == expected).all());
}

}  // namespace
}  // namespace tagfield
