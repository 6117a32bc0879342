// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/hologram.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/grid_search.h"
#include "tagfield/localization/holograms/reach.h"
#include "tagfield/localization/holograms/wave_blocks.h"

namespace tagfield {
namespace {

constexpr double kFirstAperture = 1.5;  ///< [λ]
constexpr double kFinestCell = 0.1;     ///< [λ]
constexpr double kThoroughCell = 0.16;  ///< Half of a lobe's width [λ].
constexpr double kMaxCells = 1000.0;    ///< From the middle to the edge of a grid.

/// Position that the fit reaches from `place` over growing apertures.
PositionVector climb_gradually(const TagPhases& phases, const HeightModel& height,
                               PositionVector place) {
  const double lambda = 2.0 * longest_cycle(phases);
  for (const double length : {3.0 * kFirstAperture * lambda, 9.0 * kFirstAperture * lambda}) {
    place = climb(phases, apertures(phases, length), height, place);
  }
  return place;
}

/// With this many reads, noise alone adds up to 15 % at one point in ten (quantile √(ln 10/100) of
/// a Rayleigh amplitude), and a point where a third of the phasors agree falls below that in less
/// than 1 % of cases. Reads of each unknown offset are summed separately.
std::size_t glance_reads(const TagPhases& phases) {
  constexpr std::size_t kOfOne = 100;
  constexpr std::size_t kOfEach = 16;
  return std::max(kOfOne, kOfEach * apertures(phases, kWholeAperture).size());
}

/// Two glances that use interleaved reads.
GridPreselection glances_by(const TagPhases& phases, double height, const Eigen::Vector2d& middle,
                            const Brightness& brightness) {
  const std::size_t count = glance_reads(phases);
  const auto reads = [&](bool between) {
    return search_reads(thinned(phases, count, between), kWholeAperture, height, middle);
  };
  GridPreselection glances;
  glances.at_blocks = [&brightness, some = reads(false)](const CellBlock& block) -> BlockLight {
    if (brightness.at_a_glance) return brightness.at_a_glance(some, block);
    return light_of_block([&](const Tile& x, const Tile& y) { return brightness.at(some, x, y); },
                          block);
  };
  glances.at_cells = [&brightness, others = reads(true)](const Tile& x, const Tile& y) {
    return brightness.at(others, x, y);
  };
  return glances;
}

}  // namespace

void check_cells(const SearchOptions& options) {
  if (options.max_range_m / options.cell_m > kMaxCells) {
    throw Error("cell_m must be at least a thousandth of max_range_m");
  }
}

Eigen::Vector2d middle_of(const TagPhases& phases) {
  return {0.5 * (phases.x.minCoeff() + phases.x.maxCoeff()),
          0.5 * (phases.y.minCoeff() + phases.y.maxCoeff())};
}

TagPhases thinned(const TagPhases& phases, std::size_t count, bool between) {
  const auto all = static_cast<std::size_t>(phases.size());
  const auto stride = static_cast<Eigen::Index>((all + count - 1) / count);
  if (stride <= 1) return phases;
  std::vector<Eigen::Index> kept;
  std::vector<TagPhases::Span> spans = phases.spans;
  for (TagPhases::Span& span : spans) {
    const auto begin = static_cast<Eigen::Index>(kept.size());
    const Eigen::Index end = span.begin + span.count;
    for (Eigen::Index i = span.begin + (between ? stride / 2 : 0); i < end; i += stride) {
      kept.push_back(i);
    }
    span.begin = begin;
    span.count = static_cast<Eigen::Index>(kept.size()) - begin;
  }
  return chosen(phases, kept, std::move(spans));
}

SearchReads search_reads(const TagPhases& phases, double length, double height,
                         const Eigen::Vector2d& middle) {
  SearchReads result;
  result.apertures = apertures(phases, length);
  result.reads.reserve(static_cast<std::size_t>(phases.size()));
  for (const TagPhases::Span& span : phases.spans) {
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const double up = height - phases.z[i];
      const double turns = phases.value[i] / span.cycle_m;
      SearchRead read;
      read.x = static_cast<float>(phases.x[i] - middle.x());
      read.y = static_cast<float>(phases.y[i] - middle.y());
      read.z = static_cast<float>(-up);
      read.height_squared = static_cast<float>(up * up);
      read.turns = static_cast<float>(turns - std::round(turns));
      read.turns_per_metre = static_cast<float>(1.0 / span.cycle_m);
      result.reads.push_back(read);
    }
  }
  return result;
}

Tile coherent_brightness(const SearchReads& reads, const Tile& x, const Tile& y) {
  return wave_amplitudes(reads, x, y);
}

BlockLight approximate_coherence(const SearchReads& reads, const CellBlock& block) {
  return block_amplitudes(reads, block);
}

Brightness coherent_light() { return {coherent_brightness, approximate_coherence}; }

Tile brightness_in_space(const SearchReads& reads, const Tile& x, const Tile& y, const Tile& z) {
  return wave_amplitudes(reads, x, y, z);
}

std::vector<Eigen::Vector2d> search_plane(const TagPhases& phases, double height,
                                          const SearchOptions& options,
                                          const Brightness& brightness) {
  if (phases.size() == 0) return {};
  const double lambda = 2.0 * longest_cycle(phases);
  const TagPhases coarse =
      thinned(phases, options.thorough ? (options.reads + 1) / 2 : options.reads);
  const Eigen::Vector2d middle = middle_of(phases);
  const double whole_cell = std::max(kThoroughCell * lambda, options.max_range_m / kMaxCells);
  const double size = options.thorough ? std::min(options.cell_m, whole_cell) : options.cell_m;
  double length = options.thorough ? kWholeAperture : kFirstAperture * lambda;
  std::vector<GridLevel> levels;
  const auto add = [&](const TagPhases& reads, double aperture) {
    levels.push_back([&brightness, level = search_reads(reads, aperture, height, middle)](
                         const Tile& x, const Tile& y) { return brightness.at(level, x, y); });
  };
  GridPreselection glances;
  if (options.thorough && 2 * glance_reads(phases) <= static_cast<std::size_t>(coarse.size())) {
    glances = glances_by(phases, height, middle, brightness);
  }
  double finest = size;
  for (; finest > kFinestCell * lambda; finest /= kGridSplit, length *= 3.0) add(coarse, length);
  add(options.thorough ? phases : coarse, kWholeAperture);
  const PlaneInReach in_reach(phases, height, options.max_range_m);
  std::vector<Eigen::Vector2d> places;
  const Grid grid{middle, size, options.max_range_m};
  for (const GridMaximum& maximum : search_grid(grid, in_reach, levels, options.maxima, glances)) {
    places.push_back(maximum.p);
  }
  return places;
}

std::vector<PositionVector> search_positions(const TagPhases& phases, const HeightModel& height,
                                             const SearchOptions& options,
                                             const Brightness& brightness) {
  std::vector<PositionVector> places;
  const bool known = height.kind == HeightModel::Kind::kKnown;
  for (const double z : heights_to_search(height)) {
    for (const Eigen::Vector2d& p : search_plane(phases, z, options, brightness)) {
      const PositionVector place = to_unknowns(height, {p.x(), p.y(), z});
      places.push_back(known ? place : climb_gradually(phases, height, place));
    }
  }
  return places;
}

}  // namespace tagfield
