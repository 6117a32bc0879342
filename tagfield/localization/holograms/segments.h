// SPDX-License-Identifier: Apache-2.0
/// @file
/// Likelihood of positions amid reflections: the antenna's path is cut into sections ("segments"),
/// each weighted by how well its phasors add up at the position. docs/methods.md has the equations.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/height_model.h"
#include "tagfield/localization/holograms/hologram.h"

namespace tagfield {

/// Segments have seven lengths, each twice the previous one; the shortest is given in wavelengths.
inline constexpr int kSegmentLengths = 7;
inline constexpr double kShortestSegment = 2.5;

/// Number of parts of the path that are compared with each other; all have equally many reads.
inline constexpr int kPathParts = 4;
inline constexpr int kWholePath = -1;

/// Selection of segment lengths and of a part of the path.
struct SegmentChoice {
  int first = 0;
  int last = kSegmentLengths - 1;
  int part = kWholePath;
};

/// Segments by which positions are judged. Shorter ones only guide a search.
inline constexpr SegmentChoice kForPlaces{1, kSegmentLengths - 1};

/// One antenna on a section of its path.
struct CoherentSegment {
  std::vector<std::size_t> channels;  ///< Indices of its phasor sums, one per offset.
  float reads = 0.0f;
  /// Independent samples of the field, minus one for each offset; at least 0.
  float freedom = 0.0f;
  int part = 0;  ///< Of kPathParts, by time.
};

/// A tag's reads laid out for segment_likelihood(). Phasors are summed over pieces, each one
/// channel on one of the shortest segments, and the sums are merged in pairs as segments grow:
/// the first sums are those of the pieces, in order, and each further one adds two earlier sums.
struct SegmentedReads {
  SearchReads reads;  ///< Its apertures are the pieces.
  std::vector<std::array<std::size_t, 2>> pairs;
  std::array<std::vector<CoherentSegment>, kSegmentLengths> segments;
};

/// `wavelength` [m] is that of the carrier, even if the phases are multiplied; `height` and
/// `middle` are as in search_reads().
SegmentedReads segmented_reads(const TagPhases& phases, double wavelength, double height,
                               const Eigen::Vector2d& middle);

/// Number of independent samples of a field sampled at `along_m` along the path: n² / Σ sinc²((s_i
/// − s_j)/λ) over all pairs. Bit-identical for every instruction set.
double independent_samples(const std::vector<double>& along_m, double wavelength,
                           InstructionSet set = instruction_sets().back());

/// ln of the likelihood up to a constant, averaged over the chosen lengths: −Σ f ln(1 − Σ_c
/// |S_c|²/n_c / n) over the segments with freedom f, at points (x, y, z) relative to `middle` and
/// `height` [m].
Tile segment_likelihood(const SegmentedReads& reads, const SegmentChoice& choice, const Tile& x,
                        const Tile& y, const Tile& z);

/// Phasor sums of a piece at each point of a tile, if not all of its reads count at every point.
struct PieceSums {
  WaveSums waves;
  Tile reads = Tile::Zero();  ///< Number of reads in the sums.
};

/// The same likelihood from given sums per piece. The freedom of a segment shrinks with the number
/// of its reads that count.
Tile segment_likelihood(const SegmentedReads& reads, const SegmentChoice& choice,
                        const std::vector<PieceSums>& of_pieces);

/// The likelihood of the same reads if only phase noise remained: in a segment with n reads and C
/// offsets, a share 1 − e^(−σ²) of the power, minus C/n of it, which the offsets absorb.
Tile likelihood_of_noise(const SegmentedReads& reads, const SegmentChoice& choice,
                         const std::vector<PieceSums>& of_pieces, double noise_rad);

}  // namespace tagfield
