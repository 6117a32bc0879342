// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "tagfield/localization/holograms/segment_sums.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// Distance travelled by the antenna at each read [m].
Eigen::ArrayXd travel_of(const TagPhases& phases) {
  std::map<std::string, std::vector<Index>> by_antenna;
  for (const TagPhases::Span& span : phases.spans) {
    std::vector<Index>& reads = by_antenna[span.antenna];
    for (Index i = span.begin; i < span.begin + span.count; ++i) reads.push_back(i);
  }
  Eigen::ArrayXd travel = Eigen::ArrayXd::Zero(phases.size());
  for (auto& [antenna, reads] : by_antenna) {
    std::stable_sort(reads.begin(), reads.end(),
                     [&](Index a, Index b) { return phases.time_s[a] < phases.time_s[b]; });
    for (std::size_t k = 1; k < reads.size(); ++k) {
      const Index a = reads[k - 1];
      const Index b = reads[k];
      travel[b] = travel[a] + std::sqrt(std::pow(phases.x[b] - phases.x[a], 2) +
                                        std::pow(phases.y[b] - phases.y[a], 2) +
                                        std::pow(phases.z[b] - phases.z[a], 2));
    }
  }
  return travel;
}

/// Reads of one channel within one of the shortest segments.
struct Piece {
  std::string antenna;
  std::size_t span = 0;
  std::int64_t number = 0;
  Aperture reads;
};

std::vector<Piece> pieces_of(const TagPhases& phases, const Eigen::ArrayXd& travel, double length) {
  std::vector<Piece> pieces;
  for (std::size_t s = 0; s < phases.spans.size(); ++s) {
    const TagPhases::Span& span = phases.spans[s];
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      const auto number = static_cast<std::int64_t>(travel[i] / length);
      if (i == span.begin || pieces.back().number != number) {
        pieces.push_back({span.antenna, s, number, {i, 0, false}});
      }
      ++pieces.back().reads.count;
    }
  }
  return pieces;
}

/// Parts of the path, in time order, with equal numbers of reads.
class Parts {
 public:
  explicit Parts(const TagPhases& phases) : time_s_(phases.time_s) {
    std::vector<double> sorted(phases.time_s.data(), phases.time_s.data() + phases.size());
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 1; k < kPathParts; ++k) {
      begins_.push_back(sorted[k * sorted.size() / kPathParts]);
    }
  }
  [[nodiscard]] int of(Index read) const {
    const auto after = std::upper_bound(begins_.begin(), begins_.end(), time_s_[read]);
    return static_cast<int>(after - begins_.begin());
  }

 private:
  const Eigen::ArrayXd& time_s_;
  std::vector<double> begins_;
};

/// One channel on a segment of some length.
struct SegmentChannel {
  std::string antenna;
  std::size_t span = 0;
  std::int64_t number = 0;  ///< Of the segment.
  std::size_t sum = 0;      ///< Index of the phasor sum.
  std::vector<Aperture> pieces;
};

std::vector<SegmentChannel> shortest_channels(const std::vector<Piece>& pieces) {
  std::vector<SegmentChannel> channels;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    channels.push_back({piece.antenna, piece.span, piece.number, i, {piece.reads}});
  }
  return channels;
}

/// The channels on segments twice as long; the sums that they need are added to `all`.
std::vector<SegmentChannel> twice_as_long(const std::vector<SegmentChannel>& channels,
                                          SegmentedReads& all) {
  std::vector<SegmentChannel> longer;
  for (const SegmentChannel& one : channels) {
    const std::int64_t number = one.number / 2;
    if (longer.empty() || longer.back().span != one.span || longer.back().number != number) {
      longer.push_back(one);
      longer.back().number = number;
      continue;
    }
    SegmentChannel& other = longer.back();
    all.pairs.push_back({other.sum, one.sum});
    other.sum = all.reads.apertures.size() + all.pairs.size() - 1;
    other.pieces.insert(other.pieces.end(), one.pieces.begin(), one.pieces.end());
  }
  return longer;
}

/// Distance travelled by the antenna at each read of the channel [m].
std::vector<double> travels_in(const SegmentChannel& channel, const Eigen::ArrayXd& travel) {
  std::vector<double> along;
  for (const Aperture& piece : channel.pieces) {
    for (Index i = piece.begin; i < piece.begin + piece.count; ++i) along.push_back(travel[i]);
  }
  return along;
}

/// Subset large enough to estimate the number of independent samples.
std::vector<double> thinned_out(std::vector<double> all) {
  constexpr std::size_t kEnough = 150;
  if (all.size() <= kEnough) return all;
  std::sort(all.begin(), all.end());
  std::vector<double> some;
  some.reserve(kEnough);
  for (std::size_t i = 0; i < kEnough; ++i) some.push_back(all[i * all.size() / kEnough]);
  return some;
}

CoherentSegment segment_of(const std::vector<const SegmentChannel*>& channels,
                           const Eigen::ArrayXd& travel, double wavelength) {
  CoherentSegment segment;
  std::vector<double> whole;
  double of_channels = 0.0;
  for (const SegmentChannel* channel : channels) {
    std::vector<double> along = travels_in(*channel, travel);
    segment.reads += static_cast<float>(along.size());
    whole.insert(whole.end(), along.begin(), along.end());
    of_channels += independent_samples(thinned_out(std::move(along)), wavelength);
    segment.channels.push_back(channel->sum);
  }
  // Channels read at the same positions see the same reflections.
  const double all = channels.size() == 1
                         ? of_channels
                         : independent_samples(thinned_out(std::move(whole)), wavelength);
  const double offsets = static_cast<double>(channels.size());
  segment.freedom =
      static_cast<float>(std::max(0.0, of_channels - offsets) * std::min(1.0, all / of_channels));
  return segment;
}

std::vector<CoherentSegment> intervals_of(const std::vector<SegmentChannel>& channels,
                                          const Eigen::ArrayXd& travel, double wavelength,
                                          const Parts& parts) {
  std::map<std::pair<std::string, std::int64_t>, std::vector<const SegmentChannel*>> numbers;
  for (const SegmentChannel& one : channels) numbers[{one.antenna, one.number}].push_back(&one);
  std::vector<CoherentSegment> segments;
  for (const auto& [key, of_segment] : numbers) {
    CoherentSegment segment = segment_of(of_segment, travel, wavelength);
    segment.part = parts.of(of_segment.front()->pieces.front().begin);
    if (segment.freedom > 0.0f) segments.push_back(std::move(segment));
  }
  return segments;
}

/// Sums of the pieces, followed by those of the pairs.
std::vector<PieceSums> all_sums(const SegmentedReads& reads,
                                const std::vector<PieceSums>& of_pieces) {
  std::vector<PieceSums> sums = of_pieces;
  sums.reserve(of_pieces.size() + reads.pairs.size());
  for (const auto& [one, other] : reads.pairs) {
    PieceSums both = sums[one];
    both.waves.in_phase += sums[other].waves.in_phase;
    both.waves.quadrature += sums[other].waves.quadrature;
    both.reads += sums[other].reads;
    sums.push_back(both);
  }
  return sums;
}

/// −f ln(1 − share of the power that adds up), over the reads that count.
Tile likelihood_of(const CoherentSegment& segment, const std::vector<PieceSums>& sums) {
  Tile power = Tile::Zero();
  Tile reads = Tile::Zero();
  for (const std::size_t channel : segment.channels) {
    const PieceSums& sum = sums[channel];
    power += (sum.waves.in_phase.square() + sum.waves.quadrature.square()) / sum.reads.max(1.0f);
    reads += sum.reads;
  }
  const Tile freedom = segment.freedom / segment.reads * reads;
  return -freedom * (1.0f - power / reads.max(1.0f)).max(kMinLeft).log();
}

/// As above, but as if only the share `left` of each read's power were noise.
Tile likelihood_with(const CoherentSegment& segment, const std::vector<PieceSums>& sums,
                     float left) {
  Tile offsets = Tile::Zero();
  Tile reads = Tile::Zero();
  for (const std::size_t channel : segment.channels) {
    offsets += sums[channel].reads.min(1.0f);
    reads += sums[channel].reads;
  }
  const Tile freedom = segment.freedom / segment.reads * reads;
  return -freedom * (left * (1.0f - offsets / reads.max(1.0f))).max(kMinLeft).log();
}

std::vector<const CoherentSegment*> chosen_segments(const SegmentedReads& reads,
                                                    const SegmentChoice& choice) {
  std::vector<const CoherentSegment*> chosen;
  for (int k = choice.first; k <= choice.last; ++k) {
    for (const CoherentSegment& segment : reads.segments[static_cast<std::size_t>(k)]) {
      if (choice.part == kWholePath || segment.part == choice.part) chosen.push_back(&segment);
    }
  }
  return chosen;
}

Tile mean_over_lengths(const SegmentChoice& choice, const Tile& sum) {
  return sum / static_cast<float>(choice.last - choice.first + 1);
}

template <class OfSegment>
Tile mean_over_lengths(const SegmentedReads& reads, const SegmentChoice& choice,
                       const OfSegment& of_segment) {
  Tile sum = Tile::Zero();
  for (const CoherentSegment* segment : chosen_segments(reads, choice)) {
    sum += of_segment(*segment);
  }
  return mean_over_lengths(choice, sum);
}

}  // namespace

SegmentedReads segmented_reads(const TagPhases& phases, double wavelength, double height,
                               const Eigen::Vector2d& middle) {
  SegmentedReads all;
  all.reads = search_reads(phases, kWholeAperture, height, middle);
  all.reads.apertures.clear();
  if (phases.size() == 0) return all;
  const Eigen::ArrayXd travel = travel_of(phases);
  const std::vector<Piece> pieces = pieces_of(phases, travel, kShortestSegment * wavelength);
  const Parts parts(phases);
  all.reads.apertures.reserve(pieces.size());
  for (const Piece& piece : pieces) all.reads.apertures.push_back(piece.reads);
  std::vector<SegmentChannel> channels = shortest_channels(pieces);
  for (std::size_t k = 0; k < kSegmentLengths; ++k) {
    if (k > 0) channels = twice_as_long(channels, all);
    all.segments[k] = intervals_of(channels, travel, wavelength, parts);
  }
  return all;
}

Tile segment_likelihood(const SegmentedReads& reads, const SegmentChoice& choice, const Tile& x,
                        const Tile& y, const Tile& z) {
  const Tile sum = segment_sums(reads, chosen_segments(reads, choice), x, y, z);
  return mean_over_lengths(choice, sum);
}

Tile segment_likelihood(const SegmentedReads& reads, const SegmentChoice& choice,
                        const std::vector<PieceSums>& of_pieces) {
  const std::vector<PieceSums> sums = all_sums(reads, of_pieces);
  return mean_over_lengths(
      reads, choice, [&](const CoherentSegment& segment) { return likelihood_of(segment, sums); });
}

Tile likelihood_of_noise(const SegmentedReads& reads, const SegmentChoice& choice,
                         const std::vector<PieceSums>& of_pieces, double noise_rad) {
  const auto left = static_cast<float>(-std::expm1(-noise_rad * noise_rad));
  const std::vector<PieceSums> sums = all_sums(reads, of_pieces);
  return mean_over_lengths(reads, choice, [&](const CoherentSegment& segment) {
    return likelihood_with(segment, sums, left);
  });
}

}  // namespace tagfield
