// SPDX-License-Identifier: Apache-2.0
/// @file
/// Likelihood of places amid reflections: the way is cut into stretches, and each counts by how
/// well its waves add up there. docs/methods.md has the equations.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/height_model.h"
#include "tagfield/localization/holograms/hologram.h"

namespace tagfield {

/// Stretches of seven lengths, each twice the one before: the first is of so many wavelengths.
inline constexpr int kStretchLengths = 7;
inline constexpr double kShortestStretch = 2.5;

/// The way is held against itself in so many parts, each with as many reads.
inline constexpr int kWayParts = 4;
inline constexpr int kWholeWay = -1;

/// Which of the lengths, and which part of the way.
struct StretchChoice {
  int first = 0;
  int last = kStretchLengths - 1;
  int part = kWholeWay;
};

/// What places are judged by. Shorter stretches only show a search where to look.
inline constexpr StretchChoice kForPlaces{1, kStretchLengths - 1};

/// One antenna on a piece of its way.
struct CoherentStretch {
  std::vector<std::size_t> channels;  ///< Sums of waves that share an offset.
  float reads = 0.0f;
  /// Independent samples of the field, less one for each offset; at least 0.
  float freedom = 0.0f;
  int part = 0;  ///< Of kWayParts, by time.
};

/// A tag's reads laid out for stretch_likelihood(). Waves are added up by pieces, one channel on
/// one of the shortest stretches each, and those on from two to two, as stretches grow: the first
/// sums are of the pieces, in their order, and each further one is of two before it.
struct StretchedReads {
  SearchReads reads;  ///< Its apertures are the pieces.
  std::vector<std::array<std::size_t, 2>> pairs;
  std::array<std::vector<CoherentStretch>, kStretchLengths> stretches;
};

/// `wavelength` [m] is that of the carrier, whatever the phases are multiplied by; `height` and
/// `middle` are as those of search_reads().
StretchedReads stretched_reads(const TagPhases& phases, double wavelength, double height,
                               const Eigen::Vector2d& middle);

/// Independent samples that a field has along the way, of which it is known at the places
/// `along_m`, in rising order: n² / Σ sinc²((s_i − s_j)/λ) over all pairs. The same to the last bit
/// for each set of instructions.
double independent_samples(const std::vector<double>& along_m, double wavelength,
                           InstructionSet set = instruction_sets().back());

/// ln of the likelihood up to a constant, in the mean over the chosen lengths:
/// −Σ f ln(1 − Σ_c |S_c|²/n_c / n) over the stretches with the freedom f, of places (x, y, z)
/// relative to `middle` and `height` [m].
Tile stretch_likelihood(const StretchedReads& reads, const StretchChoice& choice, const Tile& x,
                        const Tile& y, const Tile& z);

/// Waves of a piece's reads at each place of a tile, where not all reads tell something at each.
struct PieceSums {
  WaveSums waves;
  Tile reads = Tile::Zero();  ///< So many are in the sums.
};

/// The same likelihood of waves that were added up elsewhere, by piece. A stretch has the less
/// freedom the fewer of its reads count.
Tile stretch_likelihood(const StretchedReads& reads, const StretchChoice& choice,
                        const std::vector<PieceSums>& of_pieces);

/// What it would be of the same reads if nothing but phase noise were left in them: of a stretch
/// with n reads and C offsets 1 − e^(−σ²) of the power, less C/n of that, which the offsets take.
Tile likelihood_of_noise(const StretchedReads& reads, const StretchChoice& choice,
                         const std::vector<PieceSums>& of_pieces, double noise_rad);

}  // namespace tagfield
