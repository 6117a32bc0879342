// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/occupancy_grid.h"

#include <algorithm>
#include <limits>

namespace tagfield {
namespace {

/// Squared distance that represents "no source" [cells²]; sums of two are exact in an int64.
constexpr std::int64_t kNone = std::int64_t{1} << 40;

using Squares = std::vector<std::int64_t>;

/// Squared distances along a column to its nearest source: one pass up, one down.
void column_distances(const OccupancyGrid& grid, const std::vector<bool>& is_source, int x,
                      Squares& squares) {
  std::int64_t away = -1;  // None seen yet.
  const auto visit = [&](int y) {
    const std::size_t i = grid.index(x, y);
    away = is_source[i] ? 0 : (away < 0 ? -1 : away + 1);
    if (away >= 0) squares[i] = std::min(squares[i], away * away);
  };
  for (int y = 0; y < grid.height; ++y) visit(y);
  away = -1;
  for (int y = grid.height - 1; y >= 0; --y) visit(y);
}

/// Lower envelope of the parabolas (x − i)² + f(i) of one row.
class Envelope {
 public:
  explicit Envelope(std::size_t width) : sites_(width), starts_(width + 1) {}

  /// Replaces f(0), …, f(width − 1) by the envelope at these positions.
  void apply(std::int64_t* f, int width) {
    count_ = 0;
    for (int i = 0; i < width; ++i) {
      if (f[i] < kNone) add(f, i);
    }
    if (count_ == 0) return;
    heights_.assign(f, f + width);
    std::size_t k = 0;
    for (int x = 0; x < width; ++x) {
      while (k + 1 < count_ && starts_[k + 1] <= x) ++k;
      const std::int64_t offset = x - sites_[k];
      f[x] = offset * offset + heights_[static_cast<std::size_t>(sites_[k])];
    }
  }

 private:
  /// First integer x at which the parabola of `b` is no higher than that of `a` < b.
  static std::int64_t first_below(const std::int64_t* f, std::int64_t a, std::int64_t b) {
    const std::int64_t numerator = (f[b] + b * b) - (f[a] + a * a);
    const std::int64_t denominator = 2 * (b - a);
    const std::int64_t quotient = numerator / denominator;
    const bool rounds_up = numerator % denominator != 0 && numerator > 0;
    return quotient + (rounds_up ? 1 : 0);
  }

  void add(const std::int64_t* f, int site) {
    while (count_ > 0) {
      const std::int64_t start = first_below(f, sites_[count_ - 1], site);
      if (count_ == 1 || start > starts_[count_ - 1]) {
        starts_[count_] = start;
        break;
      }
      --count_;
    }
    sites_[count_++] = site;
  }

  std::vector<std::int64_t> sites_;
  std::vector<std::int64_t> starts_;  ///< First integer x at which a site's parabola is the lowest.
  std::vector<std::int64_t> heights_;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<float> distance_field(const OccupancyGrid& grid, const std::vector<bool>& is_source,
                                  double max_m) {
  Squares squares(is_source.size(), kNone);
  for (int x = 0; x < grid.width; ++x) column_distances(grid, is_source, x, squares);
  Envelope envelope(static_cast<std::size_t>(std::max(grid.width, 0)));
  for (int y = 0; y < grid.height; ++y) envelope.apply(&squares[grid.index(0, y)], grid.width);
  std::vector<float> distances(squares.size());
  std::transform(squares.begin(), squares.end(), distances.begin(), [&](std::int64_t square) {
    const double distance = grid.resolution_m * std::sqrt(static_cast<double>(square));
    return static_cast<float>(square < kNone ? std::min(distance, max_m) : max_m);
  });
  return distances;
}

}  // namespace tagfield
