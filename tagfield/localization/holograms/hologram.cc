#include "tagfield/localization/holograms/hologram.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/coherent_fit.h"

namespace tagfield {
namespace {

constexpr double kFirstAperture = 1.5;  ///< [λ]
constexpr double kFinestCell = 0.1;     ///< [λ]
constexpr double kThoroughCell = 0.16;  ///< Half of a lobe's width [λ].
constexpr double kMostCells = 1000.0;   ///< From the middle to the edge of a grid.
constexpr std::int64_t kSplit = 3;      ///< A cell is split into so many by so many.
constexpr std::size_t kMostKept = 250;  ///< Cells of a level that are split.
constexpr std::size_t kFewestKept = 100;
constexpr float kBrightEnough = 0.6f;     ///< Of the brightest.
constexpr double kApart = 0.05;           ///< Maxima nearer than this are one [m].
constexpr Eigen::Index kReachReads = 60;  ///< Antenna places by which the range is checked.
constexpr double kPlanesApart = 0.7;      ///< Of unknown height [m].
constexpr int kPlanes = 4;

struct Cell {
  std::int64_t i = 0, j = 0;
  float brightness = 0.0f;
};

/// A level's grid: cell (i, j) has its middle at (i, j) · size.
using Cells = std::vector<Cell>;

Cells all_cells(const TagPhases& phases, double height, const Eigen::Vector2d& middle,
                double max_range, double size) {
  Cells cells;
  const auto reach = static_cast<std::int64_t>(max_range / size) + 1;
  for (std::int64_t i = -reach; i <= reach; ++i) {
    for (std::int64_t j = -reach; j <= reach; ++j) {
      const Eigen::Vector2d p =
          middle + size * Eigen::Vector2d(static_cast<double>(i), static_cast<double>(j));
      if (in_reach(phases, {p.x(), p.y(), height}, max_range)) cells.push_back({i, j, 0.0f});
    }
  }
  return cells;
}

void illuminate(const SearchReads& reads, double size, const Brightness& brightness, Cells& cells) {
  for (std::size_t begin = 0; begin < cells.size(); begin += kTile) {
    const std::size_t count = std::min<std::size_t>(kTile, cells.size() - begin);
    Tile x = Tile::Zero();
    Tile y = Tile::Zero();
    for (std::size_t k = 0; k < count; ++k) {
      x[static_cast<Eigen::Index>(k)] =
          static_cast<float>(size * static_cast<double>(cells[begin + k].i));
      y[static_cast<Eigen::Index>(k)] =
          static_cast<float>(size * static_cast<double>(cells[begin + k].j));
    }
    const Tile light = brightness(reads, x, y);
    for (std::size_t k = 0; k < count; ++k) {
      cells[begin + k].brightness = light[static_cast<Eigen::Index>(k)];
    }
  }
}

/// By falling brightness, then by place, so that the order is the same everywhere.
bool is_brighter(const Cell& a, const Cell& b) {
  if (a.brightness != b.brightness) return a.brightness > b.brightness;
  return a.i != b.i ? a.i < b.i : a.j < b.j;
}

/// The bright ones of the cells, each split.
Cells split(Cells cells) {
  std::sort(cells.begin(), cells.end(), is_brighter);
  Cells finer;
  for (std::size_t k = 0; k < std::min(cells.size(), kMostKept); ++k) {
    const Cell& cell = cells[k];
    if (k >= kFewestKept && cell.brightness < kBrightEnough * cells.front().brightness) break;
    for (std::int64_t a = -1; a <= 1; ++a) {
      for (std::int64_t b = -1; b <= 1; ++b) {
        finer.push_back({kSplit * cell.i + a, kSplit * cell.j + b, 0.0f});
      }
    }
  }
  return finer;
}

std::uint64_t key_of(std::int64_t i, std::int64_t j) {
  return (static_cast<std::uint64_t>(i) << 32U) ^ (static_cast<std::uint64_t>(j) & 0xffffffffU);
}

/// Cells as bright as all of their neighbours, brightest first.
Cells local_maxima(const Cells& cells) {
  std::unordered_map<std::uint64_t, float> light;
  light.reserve(cells.size());
  for (const Cell& cell : cells) light[key_of(cell.i, cell.j)] = cell.brightness;
  Cells maxima;
  for (const Cell& cell : cells) {
    bool highest = true;
    for (std::int64_t a = -1; a <= 1 && highest; ++a) {
      for (std::int64_t b = -1; b <= 1 && highest; ++b) {
        const auto neighbour = light.find(key_of(cell.i + a, cell.j + b));
        highest = neighbour == light.end() || neighbour->second <= cell.brightness;
      }
    }
    if (highest) maxima.push_back(cell);
  }
  std::sort(maxima.begin(), maxima.end(), is_brighter);
  return maxima;
}

std::vector<Eigen::Vector2d> places_of(const Cells& maxima, double size,
                                       const Eigen::Vector2d& middle, std::size_t count) {
  std::vector<Eigen::Vector2d> places;
  for (const Cell& cell : maxima) {
    const Eigen::Vector2d p =
        middle + size * Eigen::Vector2d(static_cast<double>(cell.i), static_cast<double>(cell.j));
    const bool apart = std::all_of(places.begin(), places.end(), [&](const Eigen::Vector2d& other) {
      return (p - other).norm() > kApart;
    });
    if (apart) places.push_back(p);
    if (places.size() == count) break;
  }
  return places;
}

/// The place near `start` where growing apertures lead the fit.
PlaceVector climb_gradually(const TagPhases& phases, const HeightModel& height, PlaceVector place) {
  const double lambda = 2.0 * longest_cycle(phases);
  for (const double length : {3.0 * kFirstAperture * lambda, 9.0 * kFirstAperture * lambda}) {
    place = climb(phases, apertures(phases, length), height, place);
  }
  return place;
}

}  // namespace

void check_cells(const SearchOptions& options) {
  if (options.max_range_m / options.cell_m > kMostCells) {
    throw Error("cell_m must be at least a thousandth of max_range_m");
  }
}

Eigen::Vector2d middle_of(const TagPhases& phases) {
  return {0.5 * (phases.x.minCoeff() + phases.x.maxCoeff()),
          0.5 * (phases.y.minCoeff() + phases.y.maxCoeff())};
}

bool in_reach(const TagPhases& phases, const Eigen::Vector3d& p, double max_range) {
  const Eigen::Index step = std::max<Eigen::Index>(1, phases.size() / kReachReads);
  Eigen::Index within = 0;
  Eigen::Index beyond = 0;
  for (Eigen::Index i = 0; i < phases.size(); i += step) {
    const Eigen::Vector3d p_WA(phases.x[i], phases.y[i], phases.z[i]);
    ++((p - p_WA).squaredNorm() > max_range * max_range ? beyond : within);
  }
  return within >= beyond;
}

TagPhases thinned(const TagPhases& phases, std::size_t count) {
  const auto all = static_cast<std::size_t>(phases.size());
  const auto stride = static_cast<Eigen::Index>((all + count - 1) / count);
  if (stride <= 1) return phases;
  std::vector<Eigen::Index> kept;
  std::vector<TagPhases::Span> spans = phases.spans;
  for (TagPhases::Span& span : spans) {
    const auto begin = static_cast<Eigen::Index>(kept.size());
    for (Eigen::Index i = span.begin; i < span.begin + span.count; i += stride) kept.push_back(i);
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
  return coherent_sum(reads, [&](const SearchRead& read) { return residual_turns(read, x, y); });
}

std::vector<Eigen::Vector2d> search_plane(const TagPhases& phases, double height,
                                          const SearchOptions& options,
                                          const Brightness& brightness) {
  if (phases.size() == 0) return {};
  const double lambda = 2.0 * longest_cycle(phases);
  const TagPhases coarse =
      thinned(phases, options.thorough ? (options.reads + 1) / 2 : options.reads);
  const Eigen::Vector2d middle = middle_of(phases);
  const double whole_cell = std::max(kThoroughCell * lambda, options.max_range_m / kMostCells);
  double size = options.thorough ? std::min(options.cell_m, whole_cell) : options.cell_m;
  double length = options.thorough ? kWholeAperture : kFirstAperture * lambda;
  Cells cells = all_cells(phases, height, middle, options.max_range_m, size);
  for (; size > kFinestCell * lambda; size /= static_cast<double>(kSplit), length *= 3.0) {
    illuminate(search_reads(coarse, length, height, middle), size, brightness, cells);
    cells = split(std::move(cells));
  }
  illuminate(search_reads(phases, kWholeAperture, height, middle), size, brightness, cells);
  return places_of(local_maxima(cells), size, middle, options.maxima);
}

std::vector<PlaceVector> search_places(const TagPhases& phases, const HeightModel& height,
                                       const SearchOptions& options, const Brightness& brightness) {
  std::vector<PlaceVector> places;
  const bool known = height.kind == HeightModel::Kind::kKnown;
  for (int plane = 0; plane < (known ? 1 : kPlanes); ++plane) {
    const double z = height.z + height.side * kPlanesApart * plane;
    for (const Eigen::Vector2d& p : search_plane(phases, z, options, brightness)) {
      const PlaceVector place = to_unknowns(height, {p.x(), p.y(), z});
      places.push_back(known ? place : climb_gradually(phases, height, place));
    }
  }
  return places;
}

}  // namespace tagfield
