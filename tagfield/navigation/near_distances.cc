// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/near_distances.h"

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Distances along the columns in cells, up to `most`: first from the row before, then from the row
/// after.
std::vector<std::int16_t> column_distances(const std::vector<std::uint8_t>& sources,
                                           std::size_t width, std::int16_t most) {
  std::vector<std::int16_t> distances(sources.size());
  const std::vector<std::int16_t> none(width, most);
  for (std::size_t row = 0; row < sources.size(); row += width) {
    const std::int16_t* before = row == 0 ? none.data() : &distances[row - width];
    const std::uint8_t* source = &sources[row];
    std::int16_t* here = &distances[row];
    for (std::size_t x = 0; x < width; ++x) {
      const auto next = static_cast<std::int16_t>(before[x] + 1);
      here[x] = source[x] != 0 ? std::int16_t{0} : std::min(next, most);
    }
  }
  for (std::size_t row = sources.size() - std::min(sources.size(), width); row > 0; row -= width) {
    const std::int16_t* after = &distances[row];
    std::int16_t* here = &distances[row - width];
    for (std::size_t x = 0; x < width; ++x) {
      here[x] = std::min(here[x], static_cast<std::int16_t>(after[x] + 1));
    }
  }
  return distances;
}

/// A square minus 2¹⁵: the minimum of signed numbers takes one instruction on every target, that of
/// unsigned ones five. The sum of two squares of up to 180 cells also fits.
using Lowered = std::int16_t;
constexpr int kLowered = 32768;

Lowered lowered(int square) { return static_cast<Lowered>(square - kLowered); }

/// `best[x]` = min over |d| ≤ most of row[x + d]² + d². `padded` has `most` extra cells at either
/// end.
void row_squares(const std::vector<Lowered>& padded, std::size_t width, std::size_t most,
                 std::vector<Lowered>& best) {
  std::fill(best.begin(), best.end(), lowered(static_cast<int>(most * most)));
  for (std::size_t shift = 0; shift <= 2 * most; ++shift) {
    const std::size_t offset = shift > most ? shift - most : most - shift;
    const auto square = static_cast<Lowered>(offset * offset);
    const Lowered* from = padded.data() + shift;
    Lowered* to = best.data();
    for (std::size_t x = 0; x < width; ++x) {
      const auto sum = static_cast<Lowered>(from[x] + square);
      to[x] = sum < to[x] ? sum : to[x];
    }
  }
}

}  // namespace

int cells_for(double distance_m, double resolution_m) {
  return static_cast<int>(std::clamp(std::ceil(distance_m / resolution_m) + 1.0, 1.0, 180.0));
}

std::vector<float> near_distances(const std::vector<std::uint8_t>& sources, int width,
                                  int max_cells) {
  const auto columns = static_cast<std::size_t>(width);
  const auto most = static_cast<std::size_t>(max_cells);
  const std::vector<std::int16_t> along =
      column_distances(sources, columns, static_cast<std::int16_t>(max_cells));
  std::vector<float> roots(most * most + 1);
  for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = std::sqrt(static_cast<float>(i));
  std::vector<Lowered> padded(columns + 2 * most, lowered(max_cells * max_cells));
  std::vector<Lowered> best(columns);
  std::vector<float> distances(sources.size());
  for (std::size_t row = 0; row < sources.size(); row += columns) {
    for (std::size_t x = 0; x < columns; ++x) {
      padded[most + x] = lowered(along[row + x] * along[row + x]);
    }
    row_squares(padded, columns, most, best);
    for (std::size_t x = 0; x < columns; ++x) {
      const int square = best[x] + kLowered;
      distances[row + x] = roots[static_cast<std::size_t>(square)];
    }
  }
  return distances;
}

}  // namespace tagfield
