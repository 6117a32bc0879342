// SPDX-License-Identifier: Apache-2.0
/// @file
/// Coarse-to-fine search for the positions that many phases agree on, over the whole area where a
/// tag could be read: first short apertures, whose lobes are wide, then longer and longer ones on
/// finer and finer grids where the coarser ones were bright. The method defines the brightness.
///
/// Brightness is computed in single precision, a tile of points at a time, in loops that compilers
/// vectorize. Phases are first reduced to near zero in double precision.
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

/// Brightness from some reads; points are relative to the same middle as the reads [m].
struct Brightness {
  /// At the points (x, y) of a tile.
  std::function<Tile(const SearchReads& reads, const Tile& x, const Tile& y)> at;
  /// Approximation at a block's cells; null to use tiles instead.
  std::function<BlockLight(const SearchReads& reads, const CellBlock& block)> at_a_glance{};
};

/// Σ |Σ e^{j(φ − k r)}| over the apertures, the real part where the offset is known.
Tile coherent_brightness(const SearchReads& reads, const Tile& x, const Tile& y);
/// Approximation of the same at a block's cells; see block_sums() for its accuracy.
BlockLight approximate_coherence(const SearchReads& reads, const CellBlock& block);
/// Both.
Brightness coherent_light();
/// As coherent_brightness(), but with a height above the plane for each point.
Tile brightness_in_space(const SearchReads& reads, const Tile& x, const Tile& y, const Tile& z);

/// Options of the search.
struct SearchOptions {
  double max_range_m = 12.0;  ///< Half of the reads are from within this range; over 0.
  double cell_m = 0.25;       ///< Of the coarsest grid; over 0.
  std::size_t maxima = 12;    ///< Maximum number returned.
  /// Maximum number used by a level, evenly thinned, except for the last level of a thorough
  /// search.
  std::size_t reads = 800;
  /// Use whole apertures over the whole area from the start: some twenty times the work.
  /// Reflections distort the phase over decimetres, so that short apertures are brightest
  /// elsewhere.
  bool thorough = false;
};

/// Throws Error if there are too many cells.
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

/// The brightest local maxima on the plane z = `height`, brightest first; none if no point is
/// within range of half of the reads. With λ the longest wavelength, apertures are 1.5 λ on the
/// first level, three times as long on each further one, and whole on the last, whose cells are at
/// most λ/10.
std::vector<Eigen::Vector2d> search_plane(const TagPhases& phases, double height,
                                          const SearchOptions& options,
                                          const Brightness& brightness);

/// search_plane() in the unknowns of the fit. If the height is unknown, planes at several heights
/// on the tag's side are searched, and each position found is fitted in all three coordinates over
/// growing apertures, as lobes are narrower than the spacing of the planes.
std::vector<PositionVector> search_positions(const TagPhases& phases, const HeightModel& height,
                                             const SearchOptions& options,
                                             const Brightness& brightness);

/// Middle of the box around the antennas, seen from above [m]; phases must not be empty.
Eigen::Vector2d middle_of(const TagPhases& phases);

/// Every n-th read, so that at most about `count` remain; with `between`, those halfway between.
TagPhases thinned(const TagPhases& phases, std::size_t count, bool between = false);

/// Reads in single precision relative to `middle`, for a tag at `height`, with apertures of
/// `length` [m].
SearchReads search_reads(const TagPhases& phases, double length, double height,
                         const Eigen::Vector2d& middle);

}  // namespace tagfield
