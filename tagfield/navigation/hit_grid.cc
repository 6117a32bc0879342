// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/hit_grid.h"

#include <algorithm>
#include <limits>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/internal/cell_marks.h"

namespace tagfield {
namespace {

/// Index of a cell within its patch.
template <int kBits>
std::size_t place_in_patch(int x, int y) {
  constexpr int kMask = (1 << kBits) - 1;
  return static_cast<std::size_t>(((y & kMask) << kBits) | (x & kMask));
}

/// Index of a patch in a table that is `width` patches wide.
std::size_t place_of(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

}  // namespace

const HitCell& HitGrid::at(int x, int y) const {
  static const HitCell kUnknown;
  const int px = (x >> kPatchBits) - patch_x0_;
  const int py = (y >> kPatchBits) - patch_y0_;
  if (px < 0 || py < 0 || px >= patches_x_ || py >= patches_y_) return kUnknown;
  const std::shared_ptr<Patch>& patch = patches_[place_of(px, py, patches_x_)];
  return patch ? (*patch)[place_in_patch<kPatchBits>(x, y)] : kUnknown;
}

void HitGrid::make_room(int patch_x, int patch_y) {
  if (patches_.empty()) {
    patch_x0_ = patch_x;
    patch_y0_ = patch_y;
  }
  const int x0 = std::min(patch_x0_, patch_x);
  const int y0 = std::min(patch_y0_, patch_y);
  const int nx = std::max(patch_x0_ + patches_x_, patch_x + 1) - x0;
  const int ny = std::max(patch_y0_ + patches_y_, patch_y + 1) - y0;
  if (nx == patches_x_ && ny == patches_y_) return;
  std::vector<std::shared_ptr<Patch>> wider(place_of(0, ny, nx));
  for (int y = 0; y < patches_y_; ++y) {
    for (int x = 0; x < patches_x_; ++x) {
      wider[place_of(x + patch_x0_ - x0, y + patch_y0_ - y0, nx)] =
          std::move(patches_[place_of(x, y, patches_x_)]);
    }
  }
  patches_ = std::move(wider);
  patch_x0_ = x0;
  patch_y0_ = y0;
  patches_x_ = nx;
  patches_y_ = ny;
}

/// The patch, owned by this grid alone from now on.
HitGrid::Patch& HitGrid::patch_to_change(int patch_x, int patch_y) {
  make_room(patch_x, patch_y);
  std::shared_ptr<Patch>& patch =
      patches_[place_of(patch_x - patch_x0_, patch_y - patch_y0_, patches_x_)];
  if (!patch) {
    patch = std::make_shared<Patch>();
    return *patch;
  }
  // Take one more reference first: incrementing the count synchronizes with grids on other threads
  // that have read these cells and released them; use_count() alone does not.
  const std::shared_ptr<Patch> taken = patch;
  if (taken.use_count() > 2) patch = std::make_shared<Patch>(*taken);
  return *patch;
}

/// Counts a pass in the marked cells of a patch, except those already counted for this scan.
void HitGrid::count_passed(const CellMarks& marks, int patch_x, int patch_y) {
  Patch* patch = nullptr;
  const int x0 = std::max(patch_x * kPatchCells, marks.x0);
  const int x1 = std::min((patch_x + 1) * kPatchCells, marks.x0 + marks.width);
  const int y0 = std::max(patch_y * kPatchCells, marks.y0);
  const int y1 = std::min((patch_y + 1) * kPatchCells, marks.y0 + marks.height);
  for (int y = y0; y < y1; ++y) {
    const char* const begin = marks.row(y) + (x0 - marks.x0);
    const char* const end = begin + std::max(0, x1 - x0);
    const char* const first = std::find(begin, end, 1);
    if (first == end) continue;
    if (patch == nullptr) patch = &patch_to_change(patch_x, patch_y);
    HitCell* cell = &(*patch)[place_in_patch<kPatchBits>(x0 + static_cast<int>(first - begin), y)];
    // Without branches, since marks are scattered between the beams.
    for (const char* marked = first; marked != end; ++marked, ++cell) {
      const bool is_new = (*marked != 0) & (cell->last != scans_);
      cell->last = is_new ? scans_ : cell->last;
      cell->passed += is_new ? 1U : 0U;
    }
  }
}

void HitGrid::add_end(const Eigen::Vector2d& offset, HitCell& cell) const {
  cell.sum_x += static_cast<float>(offset.x());
  cell.sum_y += static_cast<float>(offset.y());
  ++cell.hits;
  if (cell.last != scans_) {
    cell.last = scans_;
    ++cell.ended;
  }
}

void HitGrid::add_ends(const std::vector<Eigen::Vector2d>& ends_M) {
  ++scans_;
  // Neighbouring beams mostly end in the same patch.
  Patch* patch = nullptr;
  Eigen::Vector2i where(0, 0);
  for (const Eigen::Vector2d& end_M : ends_M) {
    const Eigen::Vector2i at = cell_of(end_M);
    const Eigen::Vector2i of_end(at.x() >> kPatchBits, at.y() >> kPatchBits);
    if (patch == nullptr || of_end != where) patch = &patch_to_change(of_end.x(), of_end.y());
    where = of_end;
    add_end(end_M - centre_of(at.x(), at.y()),
            (*patch)[place_in_patch<kPatchBits>(at.x(), at.y())]);
  }
}

void HitGrid::insert(const ScanPoints& scan, const PlanarPose& pose_M) {
  const Eigen::Vector2d from = transformed(pose_M, scan.sensor_R);
  // A beam that ends in a cell says nothing against its neighbours along the wall.
  const double stop_short_m = 1.5 * resolution_m_;
  std::vector<Eigen::Vector2d> ends;
  ends.reserve(scan.ends_R.size());
  for (const Eigen::Vector2d& end_R : scan.ends_R) ends.push_back(transformed(pose_M, end_R));
  // Endpoints first, since a cell is counted only once per scan.
  add_ends(ends);
  std::vector<Ray> rays;
  rays.reserve(ends.size() + scan.clear_R.size());
  for (const Eigen::Vector2d& end : ends) rays.push_back({end, stop_short_m});
  for (const Eigen::Vector2d& clear_R : scan.clear_R) {
    rays.push_back({transformed(pose_M, clear_R), 0.0});
  }
  pass(from, rays);
}

/// Many beams pass through most cells near the sensor, so cells are first marked and then counted
/// once.
void HitGrid::pass(const Eigen::Vector2d& from, const std::vector<Ray>& rays) {
  Eigen::Vector2i low = cell_of(from);
  Eigen::Vector2i high = low;
  for (const Ray& ray : rays) {
    low = low.cwiseMin(cell_of(ray.to));
    high = high.cwiseMax(cell_of(ray.to));
  }
  // Rounding may lead a ray one cell beyond its end.
  CellMarks marks(low - Eigen::Vector2i::Ones(), high + Eigen::Vector2i::Ones());
  std::vector<CellMarks::Ray> in_cells;
  in_cells.reserve(rays.size());
  for (const Ray& ray : rays) {
    const double length = (ray.to - from).norm();
    if (!(length > ray.stop_short_m)) continue;
    in_cells.push_back({ray.to / resolution_m_, 1.0 - ray.stop_short_m / length});
  }
  marks.mark_rays(from / resolution_m_, in_cells);
  for (int y = low.y() >> kPatchBits; y <= high.y() >> kPatchBits; ++y) {
    for (int x = low.x() >> kPatchBits; x <= high.x() >> kPatchBits; ++x) count_passed(marks, x, y);
  }
}

OccupancyGrid HitGrid::to_occupancy() const {
  Eigen::Vector2i low(std::numeric_limits<int>::max(), std::numeric_limits<int>::max());
  Eigen::Vector2i high(std::numeric_limits<int>::min(), std::numeric_limits<int>::min());
  const int cells_x = patches_x_ * kPatchCells;
  const int cells_y = patches_y_ * kPatchCells;
  const Eigen::Vector2i corner(patch_x0_ * kPatchCells, patch_y0_ * kPatchCells);
  for (int y = 0; y < cells_y; ++y) {
    for (int x = 0; x < cells_x; ++x) {
      const Eigen::Vector2i cell = corner + Eigen::Vector2i(x, y);
      if (!at(cell.x(), cell.y()).is_known()) continue;
      low = low.cwiseMin(cell);
      high = high.cwiseMax(cell);
    }
  }
  if (low.x() > high.x()) low = high = Eigen::Vector2i::Zero();
  low -= Eigen::Vector2i::Ones();
  high += Eigen::Vector2i::Ones();
  OccupancyGrid grid;
  grid.resolution_m = resolution_m_;
  grid.width = high.x() - low.x() + 1;
  grid.height = high.y() - low.y() + 1;
  grid.origin = low.cast<double>() * resolution_m_;
  grid.cells.reserve(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      const HitCell& cell = at(x, y);
      const int value = !cell.is_known() ? -1 : (cell.is_occupied() ? 100 : 0);
      grid.cells.push_back(static_cast<std::int8_t>(value));
    }
  }
  return grid;
}

}  // namespace tagfield
