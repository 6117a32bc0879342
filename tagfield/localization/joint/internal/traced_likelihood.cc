// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/traced_likelihood.h"

#include <cmath>
#include <map>

namespace tagfield {
namespace {

using Eigen::Vector3d;
using Index = Eigen::Index;

/// By read of the phases; an antenna reads a tag once at a time.
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

/// Adds what a read measured less what it would be at each place, where it tells something.
void add_read(const TracedSearch& search, const NearReply& reply, double phase_rad, const Tile& x,
              const Tile& y, const Tile& z, PieceSums& sums) {
  const ReplyPhasors there = reply_phasors(reply, x, y, z);
  const Tile used = (there.directness >= static_cast<float>(search.least_directness) &&
                     there.slope < static_cast<float>(kSteepestBend))
                        .cast<float>();
  Tile cosine = there.in_phase;
  Tile sine = there.quadrature;
  if (search.problem.half_turns) {
    sine = 2.0f * there.in_phase * there.quadrature;
    cosine = there.in_phase.square() - there.quadrature.square();
  }
  const auto c = static_cast<float>(std::cos(phase_rad));
  const auto s = static_cast<float>(std::sin(phase_rad));
  sums.waves.in_phase += used * (c * cosine + s * sine);
  sums.waves.quadrature += used * (s * cosine - c * sine);
  sums.reads += used;
}

}  // namespace

TracedLayout layout_of(const TracedSearch& search) {
  TracedLayout layout;
  const TagPhases phases = coherent_reads(search.problem, search.sight.samples);
  if (phases.size() == 0) return layout;
  // Places come in by the replies alone.
  const double wavelength = 2.0 * search.problem.multiple() * longest_cycle(phases);
  layout.reads = stretched_reads(phases, wavelength, 0.0, middle_of(phases));
  layout.phase_rad = phases.value * phases.wavenumber;
  layout.sample = samples_by_read(phases, search.sight.samples);
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
  std::vector<PieceSums> of_pieces;
  of_pieces.reserve(layout.reads.reads.apertures.size());
  for (const Aperture& piece : layout.reads.reads.apertures) {
    PieceSums sums;
    for (Index i = piece.begin; i < piece.begin + piece.count; ++i) {
      add_read(search, replies[static_cast<std::size_t>(i)], layout.phase_rad[i], x, y, z, sums);
    }
    of_pieces.push_back(sums);
  }
  return stretch_likelihood(layout.reads, kForPlaces, of_pieces);
}

}  // namespace tagfield
