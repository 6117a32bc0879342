// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/place_search.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/localization/judgement.h"
#include "tagfield/localization/phase_noise.h"

namespace tagfield {
namespace {

constexpr Eigen::Index kThinReads = 120;  ///< Reads by which intersections are ranked.
constexpr std::size_t kStarts = 12;       ///< Intersections to start a fit from.
constexpr double kApart = 0.1;            ///< Starts nearer than this are one [m].
constexpr double kSame = 0.03;            ///< Minima nearer than this are one [m].
constexpr int kSlipRounds = 3;

std::vector<Eigen::Vector2d> refined(const TagPhases& phases, double height,
                                     const std::vector<Eigen::Vector2d>& starts) {
  std::vector<Eigen::Vector2d> minima;
  minima.reserve(starts.size());
  for (const Eigen::Vector2d& start : starts) minima.push_back(refine(phases, height, start));
  return minima;
}

/// The best place so far and its mirror image, with the other starts.
std::vector<Eigen::Vector2d> with_mirror_images(const TagPhases& phases,
                                                std::vector<Eigen::Vector2d> places) {
  const std::size_t count = std::min<std::size_t>(places.size(), 3);
  for (std::size_t i = 0; i < count; ++i) places.push_back(mirror_image(phases, places[i]));
  return places;
}

/// Distinct local minima of E over all reads, best first: from the intersections on a part of the
/// reads, then on all. Corrects the cycle slips that the best one shows.
std::vector<Eigen::Vector2d> find_minima(PlaceSearch& search) {
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

/// Channel after channel, each in order of time: a reader that comes back to a channel goes on
/// there, however many others it was on in between.
std::vector<PhaseSample> by_channel(std::vector<PhaseSample> series) {
  std::stable_sort(series.begin(), series.end(), [](const PhaseSample& a, const PhaseSample& b) {
    return a.frequency_hz < b.frequency_hz;
  });
  return series;
}

}  // namespace

PlaceSearch begin_search(const SamplesOfTag& samples, double height, const Follow& follow) {
  PlaceSearch search;
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

std::string why_too_few(const PlaceSearch& search) {
  const auto reads = static_cast<std::size_t>(search.phases.size());
  if (reads < kFewestReads) {
    return "the antenna moved too far between reads for the phase to be followed";
  }
  // Unknown are the place and an offset for each segment.
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

void search_places(PlaceSearch& search, double stride, std::size_t max_hyperbolae) {
  const auto conics = make_conics(search.segments, stride, max_hyperbolae);
  search.ranked =
      rank(thinned(search.phases, kThinReads), search.height, intersect_all(conics, search.height));
  search.minima = find_minima(search);
}

}  // namespace tagfield
