// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/wave_blocks.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/wave_lanes.h"

namespace tagfield {
namespace {

constexpr int kRows = 4;
static_assert(kBlock % kRows == 0 && kBlock == kWaveLanes);
constexpr std::size_t kAtOnce = 32;  ///< Reads whose phasors are kept.

/// A read's phasors along the block's middle row, and the factors that rotate them to the other
/// rows. The third array of each is the sum of both parts: a complex product then takes three
/// multiplications instead of four.
struct BlockWaves {
  float cosine[kBlock], sine[kBlock], both[kBlock];
  float row_cosine[kBlock], row_sine[kBlock], row_both[kBlock];
};

/// Sums of products, by rows.
struct ProductSums {
  float cosines[kBlock][kBlock] = {};
  float sines[kBlock][kBlock] = {};
  float both[kBlock][kBlock] = {};
};

inline void make_waves(const SearchRead& read, const CellBlock& block, BlockWaves& waves) {
  constexpr float kMiddle = 0.5f * static_cast<float>(kBlock - 1);
  const float dx = block.x + kMiddle * block.cell_m - read.x;
  const float dy = block.y + kMiddle * block.cell_m - read.y;
  const float beside_x = dy * dy + read.height_squared;
  const float beside_y = dx * dx + read.height_squared;
  const float middle = std::sqrt(dx * dx + beside_x);
  for (int k = 0; k < kBlock; ++k) {
    const float away = (static_cast<float>(k) - kMiddle) * block.cell_m;
    const float column = std::sqrt((dx + away) * (dx + away) + beside_x);
    wave_of(read.turns - read.turns_per_metre * column, waves.cosine[k], waves.sine[k]);
    waves.both[k] = waves.cosine[k] + waves.sine[k];
    const float row = std::sqrt((dy + away) * (dy + away) + beside_y);
    wave_of(read.turns_per_metre * (middle - row), waves.row_cosine[k], waves.row_sine[k]);
    waves.row_both[k] = waves.row_cosine[k] + waves.row_sine[k];
  }
}

/// Adds kRows rows starting at `row`, whose sums stay in registers.
inline void add_products(const BlockWaves* waves, std::size_t count, int row, ProductSums& all) {
  LaneRow cosines[kRows];
  LaneRow sines[kRows];
  LaneRow both[kRows];
  for (int j = 0; j < kRows; ++j) {
    load(all.cosines[row + j], cosines[j]);
    load(all.sines[row + j], sines[j]);
    load(all.both[row + j], both[j]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const BlockWaves& of = waves[i];
    LaneRow cosine;
    LaneRow sine;
    LaneRow sum;
    load(of.cosine, cosine);
    load(of.sine, sine);
    load(of.both, sum);
#pragma GCC unroll 8
    for (int j = 0; j < kRows; ++j) {
      cosines[j] += cosine * of.row_cosine[row + j];
      sines[j] += sine * of.row_sine[row + j];
      both[j] += sum * of.row_both[row + j];
    }
  }
  for (int j = 0; j < kRows; ++j) {
    store(cosines[j], all.cosines[row + j]);
    store(sines[j], all.sines[row + j]);
    store(both[j], all.both[row + j]);
  }
}

/// `in_phase` and `quadrature` by rows.
inline void sum_up(const SearchRead* reads, std::size_t count, const CellBlock& block,
                   float* in_phase, float* quadrature) {
  ProductSums all;
  BlockWaves waves[kAtOnce];
  for (std::size_t begin = 0; begin < count; begin += kAtOnce) {
    const std::size_t some = std::min(kAtOnce, count - begin);
    for (std::size_t i = 0; i < some; ++i) make_waves(reads[begin + i], block, waves[i]);
    for (int row = 0; row < kBlock; row += kRows) add_products(waves, some, row, all);
  }
  for (int row = 0; row < kBlock; ++row) {
    for (int k = 0; k < kBlock; ++k) {
      const float cosines = all.cosines[row][k];
      const float sines = all.sines[row][k];
      in_phase[row * kBlock + k] = cosines - sines;
      quadrature[row * kBlock + k] = all.both[row][k] - cosines - sines;
    }
  }
}

}  // namespace

BlockSums block_sums(const SearchRead* reads, std::size_t count, const CellBlock& block,
                     InstructionSet set) {
  BlockSums sums;
  in_lanes(set, [&] { sum_up(reads, count, block, sums.in_phase.data(), sums.quadrature.data()); });
  return sums;
}

BlockLight block_amplitudes(const SearchReads& reads, const CellBlock& block, InstructionSet set) {
  constexpr int kCells = kBlock * kBlock;
  BlockLight light = BlockLight::Zero();
  in_lanes(set, [&] {
    float* const sum = light.data();
    for (const Aperture& aperture : reads.apertures) {
      float in_phase[kCells];
      float quadrature[kCells];
      sum_up(reads.reads.data() + aperture.begin, static_cast<std::size_t>(aperture.count), block,
             in_phase, quadrature);
      if (aperture.offset_known) {
        for (int k = 0; k < kCells; ++k) sum[k] += in_phase[k];
      } else {
        for (int k = 0; k < kCells; ++k) {
          sum[k] += std::sqrt(in_phase[k] * in_phase[k] + quadrature[k] * quadrature[k]);
        }
      }
    }
  });
  return light;
}

}  // namespace tagfield
