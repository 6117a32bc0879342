// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// The largest number whose square root is at most `radius`: comparing with it is equivalent to
/// comparing the root, to the last bit, but saves a square root per tag.
double largest_square(double radius) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double square = radius * radius;
  if (!(square < kInfinity)) return kInfinity;
  while (std::sqrt(square) > radius) square = std::nextafter(square, 0.0);
  for (double next = square; std::sqrt(next) <= radius; next = std::nextafter(next, kInfinity)) {
    square = next;
  }
  return square;
}

}  // namespace

TagIndex::TagIndex(double cell_m) : cell_m_(cell_m) {
  if (!(cell_m > 0.0) || !std::isfinite(cell_m)) {
    throw Error(fmt::format("tag index cells of {} m, expected a length greater than 0", cell_m));
  }
}

std::size_t TagIndex::CellHash::operator()(const Cell& cell) const {
  const auto x = static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.x));
  const auto y = static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.y));
  // Fibonacci hashing of both halves distributes neighbouring cells over the buckets.
  return static_cast<std::size_t>(((x << 32U) | y) * 0x9e3779b97f4a7c15U >> 16U);
}

TagIndex::Cell TagIndex::cell_of(double x, double y) const {
  constexpr double kMost = 1e9;  // Distant cells merge; the distance test separates them.
  const auto place = [&](double coordinate) {
    return static_cast<std::int32_t>(std::clamp(std::floor(coordinate / cell_m_), -kMost, kMost));
  };
  return {place(x), place(y)};
}

void TagIndex::place(std::uint32_t slot, const Eigen::Vector3d& p_WT) {
  if (!p_WT.allFinite()) throw Error("a tag's position must be finite");
  if (slot >= positions_.size()) {
    positions_.resize(slot + std::size_t{1}, Eigen::Vector3d::Zero());
    present_.resize(slot + std::size_t{1}, false);
  }
  const Cell cell = cell_of(p_WT.x(), p_WT.y());
  const bool stays = present_[slot] && cell == cell_of(positions_[slot].x(), positions_[slot].y());
  if (!stays) {
    remove(slot);
    columns_[cell].push_back(slot);
  }
  positions_[slot] = p_WT;
  present_[slot] = true;
}

void TagIndex::remove(std::uint32_t slot) {
  if (slot >= present_.size() || !present_[slot]) return;
  const auto found = columns_.find(cell_of(positions_[slot].x(), positions_[slot].y()));
  std::vector<std::uint32_t>& column = found->second;
  column.erase(std::find(column.begin(), column.end(), slot));
  if (column.empty()) columns_.erase(found);
  present_[slot] = false;
}

/// Each slot is written, but counted only if near: branches that depend on distances are
/// mispredicted.
void TagIndex::collect(const std::vector<std::uint32_t>& column, const Eigen::Vector3d& center,
                       double max_square, std::vector<std::uint32_t>& slots) const {
  std::size_t count = slots.size();
  slots.resize(count + column.size());
  for (const std::uint32_t slot : column) {
    slots[count] = slot;
    count += (positions_[slot] - center).squaredNorm() <= max_square ? 1U : 0U;
  }
  slots.resize(count);
}

void TagIndex::within_all(const Eigen::Vector3d& center, double max_square,
                          std::vector<std::uint32_t>& slots) const {
  for (const auto& [cell, column] : columns_) collect(column, center, max_square, slots);
}

/// If a large share of all slots is given, marking them in a bitmap is faster than a sort by
/// comparisons.
void TagIndex::sort(std::vector<std::uint32_t>& slots) const {
  constexpr std::size_t kFew = 16;
  if (slots.size() * kFew < present_.size()) {
    std::sort(slots.begin(), slots.end());
    return;
  }
  std::vector<std::uint64_t> ticks(present_.size() / 64 + 1, 0);
  for (const std::uint32_t slot : slots) ticks[slot / 64] |= std::uint64_t{1} << (slot % 64);
  std::size_t count = 0;
  for (std::size_t word = 0; word < ticks.size(); ++word) {
    for (std::uint64_t rest = ticks[word]; rest != 0; rest &= rest - 1) {
      slots[count++] =
          static_cast<std::uint32_t>(64 * word + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
}

void TagIndex::within(const Eigen::Vector3d& center, double radius,
                      std::vector<std::uint32_t>& slots) const {
  slots.clear();
  if (!center.allFinite() || !(radius >= 0.0)) return;
  const double max_square = largest_square(radius);
  const Cell low = cell_of(center.x() - radius, center.y() - radius);
  const Cell high = cell_of(center.x() + radius, center.y() + radius);
  const double cells =
      (static_cast<double>(high.x) - low.x + 1.0) * (static_cast<double>(high.y) - low.y + 1.0);
  if (cells > static_cast<double>(columns_.size())) {
    within_all(center, max_square, slots);
  } else {
    for (std::int32_t x = low.x; x <= high.x; ++x) {
      for (std::int32_t y = low.y; y <= high.y; ++y) {
        const auto found = columns_.find({x, y});
        if (found != columns_.end()) collect(found->second, center, max_square, slots);
      }
    }
  }
  sort(slots);
}

}  // namespace tagfield
