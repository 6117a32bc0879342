// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/near_distances.h"

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

using Square = std::uint16_t;

/// Distances along the columns, up to `most`: from above, then from below.
std::vector<Square> column_distances(const std::vector<std::uint8_t>& sources, std::size_t width,
                                     Square most) {
  std::vector<Square> distances(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Square above = i < width ? most : distances[i - width];
    const auto next = static_cast<Square>(std::min<int>(above + 1, most));
    distances[i] = sources[i] != 0 ? Square{0} : next;
  }
  for (std::size_t i = sources.size(); i-- > width;) {
    const auto next = static_cast<Square>(distances[i] + 1);
    distances[i - width] = std::min(distances[i - width], next);
  }
  return distances;
}

/// `best[x]` = min over |d| ≤ most of row[x + d]² + d². `padded` has `most` cells more at either
/// end.
void row_squares(const std::vector<Square>& padded, std::size_t width, std::size_t most,
                 std::vector<Square>& best) {
  std::fill(best.begin(), best.end(), static_cast<Square>(most * most));
  for (std::size_t shift = 0; shift <= 2 * most; ++shift) {
    const std::size_t offset = shift > most ? shift - most : most - shift;
    const auto square = static_cast<Square>(offset * offset);
    const Square* from = padded.data() + shift;
    Square* to = best.data();
    for (std::size_t x = 0; x < width; ++x) {
      const auto sum = static_cast<Square>(from[x] + square);
      to[x] = sum < to[x] ? sum : to[x];
    }
  }
}

}  // namespace

int cells_for(double distance_m, double resolution_m) {
  return static_cast<int>(std::clamp(std::ceil(distance_m / resolution_m) + 1.0, 1.0, 180.0));
}

std::vector<float> near_distances(const std::vector<std::uint8_t>& sources, int width,
                                  int most_cells) {
  const auto columns = static_cast<std::size_t>(width);
  const auto most = static_cast<std::size_t>(most_cells);
  const auto most_square = static_cast<Square>(most * most);
  const std::vector<Square> along =
      column_distances(sources, columns, static_cast<Square>(most_cells));
  std::vector<float> roots(most * most + 1);
  for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = std::sqrt(static_cast<float>(i));
  std::vector<Square> padded(columns + 2 * most, most_square);
  std::vector<Square> best(columns);
  std::vector<float> distances(sources.size());
  for (std::size_t row = 0; row < sources.size(); row += columns) {
    for (std::size_t x = 0; x < columns; ++x) {
      padded[most + x] = static_cast<Square>(along[row + x] * along[row + x]);
    }
    row_squares(padded, columns, most, best);
    for (std::size_t x = 0; x < columns; ++x) distances[row + x] = roots[best[x]];
  }
  return distances;
}

}  // namespace tagfield
