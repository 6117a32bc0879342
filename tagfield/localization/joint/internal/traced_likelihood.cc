// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/traced_likelihood.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tagfield/localization/joint/internal/outlying.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;
using Index = Eigen::Index;

/// Per read of the phases; an antenna reads a tag at most once at a time.
std::vector<std::pair<std::string, std::size_t>> samples_by_read(const TagPhases& phases,
                                                                 const SamplesOfTag& samples) {
  std::map<std::pair<std::string, double>, std::size_t> numbers;
  for (const auto& [antenna, series] : samples) {
    for (std::size_t i = 0; i < series.size(); ++i) {
      numbers[{antenna, to_seconds(series[i].stamp)}] = i;
    }
  }
  std::vector<std::pair<std::string, std::size_t>> by_read;
  for (const TagPhases::Span& span : phases.spans) {
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      by_read.emplace_back(span.antenna, numbers.at({span.antenna, phases.time_s[i]}));
    }
  }
  return by_read;
}

/// Measured minus predicted phase of a read at each point, and whether it is used.
struct Difference {
  Tile cosine;
  Tile sine;
  Tile used;  ///< 0 or 1.
};

Difference difference(const TracedSearch& search, const NearReply& reply, double phase_rad,
                      const Tile& x, const Tile& y, const Tile& z) {
  const ReplyPhasors there = reply_phasors(reply, x, y, z);
  Tile cosine = there.in_phase;
  Tile sine = there.quadrature;
  if (search.problem.pi_ambiguity) {
    sine = 2.0f * there.in_phase * there.quadrature;
    cosine = there.in_phase.square() - there.quadrature.square();
  }
  const auto c = static_cast<float>(std::cos(phase_rad));
  const auto s = static_cast<float>(std::sin(phase_rad));
  return {c * cosine + s * sine, s * cosine - c * sine,
          (there.directness >= static_cast<float>(search.min_directness) &&
           there.slope < static_cast<float>(kSteepestBend))
              .cast<float>()};
}

void add(const Difference& read, PieceSums& sums) {
  sums.waves.in_phase += read.used * read.cosine;
  sums.waves.quadrature += read.used * read.sine;
  sums.reads += read.used;
}

/// Sums per piece; `read` returns the Difference of a read by its index.
template <class OfRead>
std::vector<PieceSums> sums_of(const TracedLayout& layout, const OfRead& read) {
  std::vector<PieceSums> of_pieces;
  of_pieces.reserve(layout.reads.reads.apertures.size());
  for (const Aperture& piece : layout.reads.reads.apertures) {
    PieceSums sums;
    for (Index i = piece.begin; i < piece.begin + piece.count; ++i) {
      add(read(static_cast<std::size_t>(i)), sums);
    }
    of_pieces.push_back(sums);
  }
  return of_pieces;
}

std::size_t channels_of(const std::vector<PhaseLeft>& left) {
  std::set<std::size_t> channels;
  for (const PhaseLeft& read : left) channels.insert(read.channel);
  return channels.size();
}

double cost_of(const PhaseSpread& spread, double noise_rad, std::size_t reads) {
  constexpr double kMost = 16.0;
  double cost = kMost * static_cast<double>(reads - spread.off_rad.size());
  for (const double off : spread.off_rad) cost += std::min(kMost, std::pow(off / noise_rad, 2));
  return cost;
}

double kept_cost_of(const PhaseSpread& spread, double noise_rad) {
  double cost = 0.0;
  for (std::size_t i = 0; i < spread.off_rad.size(); ++i) {
    if (!spread.outlying[i]) cost += std::pow(spread.off_rad[i] / noise_rad, 2);
  }
  return cost;
}

}  // namespace

TracedLayout layout_of(const TracedSearch& search) {
  TracedLayout layout;
  const TagPhases phases = coherent_reads(search.problem, search.sight.samples);
  if (phases.size() == 0) return layout;
  // Positions enter only through the replies.
  const double wavelength = 2.0 * search.problem.multiple() * longest_cycle(phases);
  layout.reads = segmented_reads(phases, wavelength, 0.0, middle_of(phases));
  layout.phase_rad = phases.value * phases.wavenumber;
  layout.sample = samples_by_read(phases, search.sight.samples);
  ChannelNumbers channels;
  for (const auto& [antenna, number] : layout.sample) {
    layout.channel.push_back(
        channels.of(antenna, search.sight.samples.at(antenna)[number].frequency_hz));
  }
  return layout;
}

std::vector<NearReply> replies_about(const TracedSearch& search, const TracedLayout& layout,
                                     const std::string& tag, const Vector3d& middle) {
  const TracedReplies replies = traced(search.problem, tag, search.sight.corrected, middle);
  std::vector<NearReply> near;
  near.reserve(layout.sample.size());
  for (const auto& [antenna, number] : layout.sample) {
    const double carrier_hz =
        search.sight.samples.at(antenna)[number].frequency_hz / search.problem.multiple();
    near.push_back(near_reply(replies.at(antenna)[number], middle, carrier_hz));
  }
  return near;
}

Tile likelihoods_at(const TracedSearch& search, const TracedLayout& layout,
                    const std::vector<NearReply>& replies, const Tile& x, const Tile& y,
                    const Tile& z) {
  const auto read = [&](std::size_t i) {
    return difference(search, replies[i], layout.phase_rad[static_cast<Index>(i)], x, y, z);
  };
  return segment_likelihood(layout.reads, kForPlaces, sums_of(layout, read));
}

Fit fit_at_middle(const TracedSearch& search, const TracedLayout& layout,
                  const std::vector<NearReply>& replies) {
  const Tile here = Tile::Zero();
  std::vector<Difference> reads;
  std::vector<PhaseLeft> left;  // Of the used reads.
  for (std::size_t i = 0; i < replies.size(); ++i) {
    const double phase_rad = layout.phase_rad[static_cast<Index>(i)];
    reads.push_back(difference(search, replies[i], phase_rad, here, here, here));
    if (!(reads.back().used[0] > 0.0f)) continue;
    left.push_back({layout.channel[i], std::atan2(reads.back().sine[0], reads.back().cosine[0])});
  }
  Fit fit;
  const PhaseSpread spread = spread_of(left, search.noise_rad);
  fit.cost = cost_of(spread, search.noise_rad, reads.size());
  fit.kept_cost = kept_cost_of(spread, search.noise_rad);
  const auto kept_reads = std::count(spread.outlying.begin(), spread.outlying.end(), false);
  fit.cost_of_noise =
      std::max(0.0, static_cast<double>(kept_reads) - static_cast<double>(channels_of(left)) - 2.0);
  std::size_t next = 0;
  for (Difference& read : reads) {
    if (read.used[0] > 0.0f && spread.outlying[next++]) read.used = Tile::Zero();
  }
  const std::vector<PieceSums> kept =
      sums_of(layout, [&](std::size_t i) -> const Difference& { return reads[i]; });
  fit.without_outlying = static_cast<double>(segment_likelihood(layout.reads, kForPlaces, kept)[0]);
  fit.attainable =
      static_cast<double>(likelihood_of_noise(layout.reads, kForPlaces, kept, search.noise_rad)[0]);
  fit.freedom = fit.attainable / -std::log(-std::expm1(-search.noise_rad * search.noise_rad));
  return fit;
}

}  // namespace tagfield
