// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/place_search.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/localization/judgement.h"
#include "tagfield/localization/phase_curves/phase_following.h"
#include "tagfield/localization/phase_noise.h"

namespace tagfield {
namespace {

constexpr Eigen::Index kThinReads = 120;  ///< Reads used to rank intersections.
constexpr std::size_t kStarts = 12;       ///< Intersections from which a fit starts.
constexpr double kApart = 0.1;            ///< Starts closer than this are the same [m].
constexpr double kSame = 0.03;            ///< Minima closer than this are the same [m].
constexpr int kSlipRounds = 3;

std::vector<Eigen::Vector2d> refined(const TagPhases& phases, double height,
                                     const std::vector<Eigen::Vector2d>& starts) {
  std::vector<Eigen::Vector2d> minima;
  minima.reserve(starts.size());
  for (const Eigen::Vector2d& start : starts) minima.push_back(refine(phases, height, start));
  return minima;
}

/// The positions, followed by the mirror images of the best three.
std::vector<Eigen::Vector2d> with_mirror_images(const TagPhases& phases,
                                                std::vector<Eigen::Vector2d> places) {
  const std::size_t count = std::min<std::size_t>(places.size(), 3);
  for (std::size_t i = 0; i < count; ++i) places.push_back(mirror_image(phases, places[i]));
  return places;
}

/// Distinct local minima of E over all reads, best first: refined from the intersections with a
/// part of the reads, then with all. Corrects the cycle slips that the best one reveals.
std::vector<Eigen::Vector2d> find_minima(PositionSearch& search) {
  const double height = search.height;
  TagPhases& phases = search.phases;
  std::vector<Eigen::Vector2d> places =
      refined(thinned(phases, kThinReads), height, best_distinct(search.ranked, kStarts, kApart));
  const auto ranked = [&] { return best_distinct(rank(phases, height, places), kStarts, kSame); };
  for (int round = 0; round < kSlipRounds; ++round) {
    places = ranked();
    if (places.empty()) return places;
    places = refined(phases, height, with_mirror_images(phases, places));
    places = ranked();
    if (places.empty() || correct_slips(phases, height, places.front()) == 0) break;
  }
  places = refined(phases, height, places);
  return ranked();
}

}  // namespace

PositionSearch begin_search(const SamplesOfTag& samples, double height, const Follow& follow) {
  PositionSearch search;
  search.height = height;
  std::vector<std::string> antennas;
  for (const auto& [antenna, series] : samples) {
    if (extent_of(series) < kStillExtent) continue;
    for (PhaseSegment& segment : follow(by_channel(series))) {
      if (segment.samples.size() < 2) continue;
      search.segments.push_back(std::move(segment));
      antennas.push_back(antenna);
    }
  }
  search.phases = unwrapped_phases(search.segments, antennas);
  return search;
}

std::string why_too_few(const PositionSearch& search) {
  const auto reads = static_cast<std::size_t>(search.phases.size());
  if (reads < kFewestReads) {
    return "the antenna moved too far between reads for the phase to be followed";
  }
  // The unknowns are the position and an offset for each segment.
  if (reads < search.segments.size() + 2 + kFewestSpare) {
    return fmt::format("too few reads: the phase could be followed over {} in {} segments", reads,
                       search.segments.size());
  }
  return "";
}

std::string why_too_noisy(const SamplesOfTag& samples, double most) {
  const double slips = expected_slips(samples);
  if (slips <= most) return "";
  return fmt::format(
      "phase noise of {:.2f} rad is too much to unwrap {} reads: {:.2g} undetected cycle slips are "
      "expected, limit {:g} (method sar does not unwrap)",
      largest_phase_noise(samples, 0.0), count_reads(samples), slips, most);
}

void search_positions(PositionSearch& search, double stride, std::size_t max_hyperbolae) {
  const auto conics = make_conics(search.segments, stride, max_hyperbolae);
  search.ranked =
      rank(thinned(search.phases, kThinReads), search.height, intersect_all(conics, search.height));
  search.minima = find_minima(search);
}

}  // namespace tagfield
