// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/near_distances.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/lanes.h"

namespace tagfield {
namespace {

/// Distances along the columns in cells, up to `most`: first from the row before, then from the row
/// after.
inline void set_column_distances(const std::vector<std::uint8_t>& sources, std::size_t width,
                                 std::int16_t most, std::vector<std::int16_t>& distances) {
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
}

/// A square minus 2¹⁵: the minimum of signed numbers takes one instruction on every target, that of
/// unsigned ones five. The sum of two squares of up to 180 cells also fits.
using Lowered = std::int16_t;
constexpr int kLowered = 32768;

inline Lowered lowered(int square) { return static_cast<Lowered>(square - kLowered); }

inline std::uint32_t index_of(Lowered square) {
  return static_cast<std::uint32_t>(square + kLowered);
}

inline void set_squares(const std::int16_t* along, std::size_t width, Lowered* squares) {
  for (std::size_t x = 0; x < width; ++x) squares[x] = lowered(along[x] * along[x]);
}

inline void look_up(const std::vector<float>& roots, const std::vector<Lowered>& squares,
                    float* distances) {
  for (std::size_t x = 0; x < squares.size(); ++x) distances[x] = roots[index_of(squares[x])];
}

/// Lowers `best[x]` to row[x + d]² + d² for d of ±`offset`, where that is less. `padded` has `most`
/// extra cells at either end.
inline void lower_by(const std::vector<Lowered>& padded, std::size_t width, std::size_t most,
                     std::size_t offset, std::vector<Lowered>& best) {
  const auto square = static_cast<Lowered>(offset * offset);
  const Lowered* const before = padded.data() + most - offset;
  const Lowered* const after = padded.data() + most + offset;
  Lowered* const to = best.data();
  for (std::size_t x = 0; x < width; ++x) {
    const Lowered nearer = before[x] < after[x] ? before[x] : after[x];
    const auto sum = static_cast<Lowered>(nearer + square);
    to[x] = sum < to[x] ? sum : to[x];
  }
}

inline Lowered greatest_of(const std::vector<Lowered>& best) {
  Lowered greatest = best.front();
  for (const Lowered square : best) greatest = square > greatest ? square : greatest;
  return greatest;
}

/// `best[x]` = min over |d| ≤ most of row[x + d]² + d², which no larger |d| lowers once d² is at
/// least the greatest of all.
inline void row_squares(const std::vector<Lowered>& padded, std::size_t width, std::size_t most,
                        std::vector<Lowered>& best) {
  constexpr std::size_t kBetween = 4;
  std::fill(best.begin(), best.end(), lowered(static_cast<int>(most * most)));
  for (std::size_t offset = 0; offset <= most; ++offset) {
    if (offset % kBetween == 0 && lowered(static_cast<int>(offset * offset)) >= greatest_of(best)) {
      return;
    }
    lower_by(padded, width, most, offset, best);
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
  std::vector<std::int16_t> along(sources.size());
  std::vector<float> roots(most * most + 1);
  for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = std::sqrt(static_cast<float>(i));
  std::vector<Lowered> padded(columns + 2 * most, lowered(max_cells * max_cells));
  std::vector<Lowered> best(columns);
  std::vector<float> distances(sources.size());
  in_lanes(instruction_sets().back(), [&] {
    set_column_distances(sources, columns, static_cast<std::int16_t>(max_cells), along);
    for (std::size_t row = 0; row < sources.size(); row += columns) {
      set_squares(along.data() + row, columns, padded.data() + most);
      row_squares(padded, columns, most, best);
      look_up(roots, best, distances.data() + row);
    }
  });
  return distances;
}

}  // namespace tagfield
