// SPDX-License-Identifier: Apache-2.0
/// @file
/// Spatial index of the tags near an antenna, at a cost that does not grow with the number of tags
/// elsewhere.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tagfield {

/// Points by slot number, in square columns of the world's x, y plane, as halls are wider than they
/// are high.
class TagIndex {
 public:
  /// `cell_m` > 0 is the columns' edge length; half of the antennas' range is a good choice.
  explicit TagIndex(double cell_m);

  /// Puts slot `slot` at `p_WT` [m], whatever its previous position. Throws Error if not finite.
  void place(std::uint32_t slot, const Eigen::Vector3d& p_WT);
  /// Removes the slot; no effect if it is not in the index.
  void remove(std::uint32_t slot);
  /// Position of a slot that is in the index.
  [[nodiscard]] const Eigen::Vector3d& position(std::uint32_t slot) const {
    return positions_[slot];
  }

  /// Slots within `radius` [m] of `center`, in ascending order, into `slots` (cleared first). None
  /// if `center` is not finite or `radius` negative or NaN.
  void within(const Eigen::Vector3d& center, double radius,
              std::vector<std::uint32_t>& slots) const;

 private:
  struct Cell {
    std::int32_t x = 0;
    std::int32_t y = 0;
    bool operator==(const Cell& other) const { return x == other.x && y == other.y; }
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  using Columns = std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash>;

  [[nodiscard]] Cell cell_of(double x, double y) const;
  void collect(const std::vector<std::uint32_t>& column, const Eigen::Vector3d& center,
               double max_square, std::vector<std::uint32_t>& slots) const;
  void sort(std::vector<std::uint32_t>& slots) const;
  void within_all(const Eigen::Vector3d& center, double max_square,
                  std::vector<std::uint32_t>& slots) const;

  double cell_m_;
  Columns columns_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<bool> present_;
};

}  // namespace tagfield
