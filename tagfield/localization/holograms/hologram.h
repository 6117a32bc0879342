// SPDX-License-Identifier: Apache-2.0
/// @file
/// Search for the places that many phases agree on, over all the area where a tag could be read,
/// from coarse to fine: short apertures first, whose lobes are wide, then ever longer ones on ever
/// finer grids where the coarser ones were bright. What makes a place bright is up to the method.
///
/// Brightness is computed in single precision, a tile of places at a time, in loops that compilers
/// turn into vector instructions. Phases are brought near zero in double precision before.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tagfield/localization/height_model.h"
#include "tagfield/localization/holograms/coherent_reads.h"
#include "tagfield/localization/holograms/grid_search.h"
#include "tagfield/localization/holograms/wave_sums.h"
#include "tagfield/localization/method.h"

namespace tagfield {

/// Brightness by some reads, relative to the same middle [m].
struct Brightness {
  /// Of the places (x, y) of a tile.
  std::function<Tile(const SearchReads& reads, const Tile& x, const Tile& y)> at;
  /// About that of a block's cells; null where tiles have to do.
  std::function<BlockLight(const SearchReads& reads, const CellBlock& block)> at_a_glance{};
};

/// Measured less predicted phase of one read [turns], not wrapped.
inline Tile residual_turns(const SearchRead& read, const Tile& x, const Tile& y) {
  return read.turns -
         read.turns_per_metre *
             ((x - read.x).square() + (y - read.y).square() + read.height_squared).sqrt();
}

/// `turns` wrapped to [−½, ½]; |turns| < 2²².
inline Tile wrapped_turns(const Tile& turns) {
  // Added to a number of this size, fractions are rounded off, in every instruction set.
  constexpr float kRounds = 12582912.0f;  // 1.5 · 2²³
  const Tile shifted = turns + kRounds;
  return turns - (shifted - kRounds);
}

/// Cosine and sine of 2πt, |t| ≤ ½, to 2·10⁻⁵: those of πt by polynomials that meet them at
/// Chebyshev's points, then the double angle.
inline void wave_of(const Tile& t, Tile& cosine, Tile& sine) {
  const Tile u = t.square();
  const Tile s = t * (3.1415903f + u * (-5.1674058f + u * (2.5440002f - u * 0.5594350f)));
  const Tile c = 0.9999932f + u * (-4.9339313f + u * (4.0412123f - u * 1.2219364f));
  cosine = 1.0f - 2.0f * s.square();
  sine = 2.0f * s * c;
}

/// Σ |Σ e^{j(φ − k r)}| over the apertures, the real part where the offset is known.
Tile coherent_brightness(const SearchReads& reads, const Tile& x, const Tile& y);
/// About the same of a block's cells; block_sums() has how near.
BlockLight coherent_glance(const SearchReads& reads, const CellBlock& block);
/// Both.
Brightness coherent_light();
/// The same, each place with a height of its own above the plane.
Tile brightness_in_space(const SearchReads& reads, const Tile& x, const Tile& y, const Tile& z);

/// How the area is searched.
struct SearchOptions {
  double max_range_m = 12.0;  ///< Half of the reads are from nearer; over 0.
  double cell_m = 0.25;       ///< Of the coarsest grid; over 0.
  std::size_t maxima = 12;    ///< So many are returned at most.
  /// Levels take so many at most, evenly thinned, but for the last of a thorough search.
  std::size_t reads = 800;
  /// Whole apertures on all of the area at once: some twenty times the work. Reflections bend the
  /// phase over decimetres, so that short apertures are brightest elsewhere.
  bool thorough = false;
};

/// Throws Error where cells are too many.
void check_cells(const SearchOptions& options);

/// Adds the keys of a search's options.
template <class Options>
void add_search_options(OptionTable<Options>& of) {
  using O = SearchOptions;
  of.table.push_back(setting<Options>("max_range_m", "m",
                                      "half of the reads are from within this range",
                                      &O::max_range_m, kOverZero));
  of.table.push_back(
      setting<Options>("cell_m", "m", "of the coarsest grid", &O::cell_m, kOverZero));
  of.table.push_back(setting<Options>("maxima", "", "brightest positions that are examined",
                                      &O::maxima, {1.0, false, 1e6}));
  of.table.push_back(setting<Options>("search_reads", "", "reads that coarse grids use at most",
                                      &O::reads, kAtLeastOne));
  of.table.push_back(setting<Options>(
      "thorough", "whole apertures over the whole area at once, some 20 times the work",
      &O::thorough));
  of.check = [](const Options& options) { check_cells(options); };
}

/// The brightest local maxima on the plane z = `height`, brightest first; none where no place is
/// within the range of all reads. With λ the longest wavelength, apertures are 1.5 λ, three times
/// that for each level on, and whole on the last, whose cells are at most λ/10.
std::vector<Eigen::Vector2d> search_plane(const TagPhases& phases, double height,
                                          const SearchOptions& options,
                                          const Brightness& brightness);

/// search_plane() as the fit sees it. Where the height is unknown, planes at several heights on the
/// tag's side are searched, and each place found is fitted in all three coordinates over growing
/// apertures, as lobes are narrower than planes are apart.
std::vector<PlaceVector> search_places(const TagPhases& phases, const HeightModel& height,
                                       const SearchOptions& options, const Brightness& brightness);

/// Middle of the box around the antennas, seen from above [m]; phases must not be empty.
Eigen::Vector2d middle_of(const TagPhases& phases);

/// Every n-th read, so that about `count` are left at most, or as many that lie between those.
TagPhases thinned(const TagPhases& phases, std::size_t count, bool between = false);

/// Reads in single precision about `middle`, for a tag at `height`, with the apertures of `length`
/// [m].
SearchReads search_reads(const TagPhases& phases, double length, double height,
                         const Eigen::Vector2d& middle);

}  // namespace tagfield
