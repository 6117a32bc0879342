// SPDX-License-Identifier: Apache-2.0
/// @file
/// The map of a mapping particle: where beams ended and which cells they passed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/scan_points.h"

namespace tagfield {

struct CellMarks;

/// The mean of the beam endpoints in a cell gives the position of the surface within the cell, to
/// which a scan can be matched far more finely than to the cell itself.
struct HitCell {
  float sum_x = 0.0F;  ///< Of the endpoints' offsets from the cell's centre [m].
  float sum_y = 0.0F;
  std::uint32_t hits = 0;    ///< Beams that ended here.
  std::uint32_t ended = 0;   ///< Scans with such beams,
  std::uint32_t passed = 0;  ///< and scans with beams that only passed.
  std::uint32_t last = 0;    ///< Number of the last scan counted.

  [[nodiscard]] bool is_known() const { return ended + passed > 0; }
  /// Whether more than one beam ended here, and did so in at least one in ten scans. Counts scans
  /// rather than beams, since along a wall most beams of a scan pass cells in which others end.
  [[nodiscard]] bool is_occupied() const { return hits > 1 && 10 * ended >= ended + passed; }
};

/// Grows as needed. Copies share what has not changed since (copy on write), so that a filter can
/// copy maps by the dozen.
class HitGrid {
 public:
  explicit HitGrid(double resolution_m) : resolution_m_(resolution_m) {}

  /// Enters a scan taken from `pose_M`.
  void insert(const ScanPoints& scan, const PlanarPose& pose_M);
  /// Enters endpoints only, without the beams that led there.
  void add_ends(const std::vector<Eigen::Vector2d>& ends_M);

  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  /// Cell that contains `p_M`. Cell (0, 0) begins at the map's origin.
  [[nodiscard]] Eigen::Vector2i cell_of(const Eigen::Vector2d& p_M) const {
    return {static_cast<int>(std::floor(p_M.x() / resolution_m_)),
            static_cast<int>(std::floor(p_M.y() / resolution_m_))};
  }
  [[nodiscard]] Eigen::Vector2d centre_of(int x, int y) const {
    return {(x + 0.5) * resolution_m_, (y + 0.5) * resolution_m_};
  }
  /// The cell (x, y); an unknown cell outside of what was seen.
  [[nodiscard]] const HitCell& at(int x, int y) const;
  /// Mean of the endpoints in the cell, which must have hits [m].
  [[nodiscard]] Eigen::Vector2d mean_of(int x, int y, const HitCell& cell) const {
    return centre_of(x, y) + Eigen::Vector2d(cell.sum_x, cell.sum_y) / cell.hits;
  }

  /// The map as gmapping publishes it: 100 occupied, 0 free, -1 unknown. Covers all that was seen,
  /// with a margin of one cell. At least one cell.
  [[nodiscard]] OccupancyGrid to_occupancy() const;

 private:
  static constexpr int kPatchBits = 5;
  static constexpr int kPatchCells = 1 << kPatchBits;
  using Patch = std::array<HitCell, std::size_t{kPatchCells} * kPatchCells>;
  /// A beam from the sensor; cells nearer to its end than `stop_short_m` don't count as passed.
  struct Ray {
    Eigen::Vector2d to;
    double stop_short_m = 0.0;
  };

  Patch& patch_to_change(int patch_x, int patch_y);
  void make_room(int patch_x, int patch_y);
  void add_end(const Eigen::Vector2d& offset, HitCell& cell) const;
  void pass(const Eigen::Vector2d& from, const std::vector<Ray>& rays);
  void count_passed(const CellMarks& marks, int patch_x, int patch_y);

  double resolution_m_;
  std::uint32_t scans_ = 0;  ///< Number of scans entered.
  int patch_x0_ = 0;
  int patch_y0_ = 0;
  int patches_x_ = 0;
  int patches_y_ = 0;
  std::vector<std::shared_ptr<Patch>> patches_;
};

}  // namespace tagfield
