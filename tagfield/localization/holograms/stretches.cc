// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/stretches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "tagfield/localization/holograms/stretch_sums.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// How far an antenna has come at each of its reads [m], by read.
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

/// Which stretch of the shortest length a read is in.
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

/// Parts of the way with as many reads each, by time.
class Parts {
 public:
  explicit Parts(const TagPhases& phases) : time_s_(phases.time_s) {
    std::vector<double> sorted(phases.time_s.data(), phases.time_s.data() + phases.size());
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 1; k < kWayParts; ++k) {
      begins_.push_back(sorted[k * sorted.size() / kWayParts]);
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

/// A channel on a stretch of some length.
struct StretchChannel {
  std::string antenna;
  std::size_t span = 0;
  std::int64_t number = 0;  ///< Of the stretch.
  std::size_t sum = 0;      ///< Of the waves.
  std::vector<Aperture> pieces;
};

std::vector<StretchChannel> shortest_channels(const std::vector<Piece>& pieces) {
  std::vector<StretchChannel> channels;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    channels.push_back({piece.antenna, piece.span, piece.number, i, {piece.reads}});
  }
  return channels;
}

/// On stretches twice as long; the sums that these take are added to `all`.
std::vector<StretchChannel> twice_as_long(const std::vector<StretchChannel>& channels,
                                          StretchedReads& all) {
  std::vector<StretchChannel> longer;
  for (const StretchChannel& one : channels) {
    const std::int64_t number = one.number / 2;
    if (longer.empty() || longer.back().span != one.span || longer.back().number != number) {
      longer.push_back(one);
      longer.back().number = number;
      continue;
    }
    StretchChannel& other = longer.back();
    all.pairs.push_back({other.sum, one.sum});
    other.sum = all.reads.apertures.size() + all.pairs.size() - 1;
    other.pieces.insert(other.pieces.end(), one.pieces.begin(), one.pieces.end());
  }
  return longer;
}

/// How far the antenna has come at each of the reads [m].
std::vector<double> travels_in(const StretchChannel& channel, const Eigen::ArrayXd& travel) {
  std::vector<double> along;
  for (const Aperture& piece : channel.pieces) {
    for (Index i = piece.begin; i < piece.begin + piece.count; ++i) along.push_back(travel[i]);
  }
  return along;
}

/// Enough to tell how many samples are independent.
std::vector<double> thinned_out(std::vector<double> all) {
  constexpr std::size_t kEnough = 150;
  if (all.size() <= kEnough) return all;
  std::sort(all.begin(), all.end());
  std::vector<double> some;
  some.reserve(kEnough);
  for (std::size_t i = 0; i < kEnough; ++i) some.push_back(all[i * all.size() / kEnough]);
  return some;
}

CoherentStretch stretch_of(const std::vector<const StretchChannel*>& channels,
                           const Eigen::ArrayXd& travel, double wavelength) {
  CoherentStretch stretch;
  std::vector<double> whole;
  double of_channels = 0.0;
  for (const StretchChannel* channel : channels) {
    std::vector<double> along = travels_in(*channel, travel);
    stretch.reads += static_cast<float>(along.size());
    whole.insert(whole.end(), along.begin(), along.end());
    of_channels += independent_samples(thinned_out(std::move(along)), wavelength);
    stretch.channels.push_back(channel->sum);
  }
  // Channels that were read at the same places see the same reflections.
  const double all = channels.size() == 1
                         ? of_channels
                         : independent_samples(thinned_out(std::move(whole)), wavelength);
  const double offsets = static_cast<double>(channels.size());
  stretch.freedom =
      static_cast<float>(std::max(0.0, of_channels - offsets) * std::min(1.0, all / of_channels));
  return stretch;
}

std::vector<CoherentStretch> stretches_of(const std::vector<StretchChannel>& channels,
                                          const Eigen::ArrayXd& travel, double wavelength,
                                          const Parts& parts) {
  std::map<std::pair<std::string, std::int64_t>, std::vector<const StretchChannel*>> numbers;
  for (const StretchChannel& one : channels) numbers[{one.antenna, one.number}].push_back(&one);
  std::vector<CoherentStretch> stretches;
  for (const auto& [key, of_stretch] : numbers) {
    CoherentStretch stretch = stretch_of(of_stretch, travel, wavelength);
    stretch.part = parts.of(of_stretch.front()->pieces.front().begin);
    if (stretch.freedom > 0.0f) stretches.push_back(std::move(stretch));
  }
  return stretches;
}

/// Those of the pieces, and on from two to two.
std::vector<PieceSums> all_sums(const StretchedReads& reads,
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

/// −f ln(1 − the share of the power that adds up), of the reads that count.
Tile likelihood_of(const CoherentStretch& stretch, const std::vector<PieceSums>& sums) {
  Tile power = Tile::Zero();
  Tile reads = Tile::Zero();
  for (const std::size_t channel : stretch.channels) {
    const PieceSums& sum = sums[channel];
    power += (sum.waves.in_phase.square() + sum.waves.quadrature.square()) / sum.reads.max(1.0f);
    reads += sum.reads;
  }
  const Tile freedom = stretch.freedom / stretch.reads * reads;
  return -freedom * (1.0f - power / reads.max(1.0f)).max(kLeastLeft).log();
}

/// Likewise, as if only `left` of each read's power were noise.
Tile likelihood_with(const CoherentStretch& stretch, const std::vector<PieceSums>& sums,
                     float left) {
  Tile offsets = Tile::Zero();
  Tile reads = Tile::Zero();
  for (const std::size_t channel : stretch.channels) {
    offsets += sums[channel].reads.min(1.0f);
    reads += sums[channel].reads;
  }
  const Tile freedom = stretch.freedom / stretch.reads * reads;
  return -freedom * (left * (1.0f - offsets / reads.max(1.0f))).max(kLeastLeft).log();
}

std::vector<const CoherentStretch*> chosen_stretches(const StretchedReads& reads,
                                                     const StretchChoice& choice) {
  std::vector<const CoherentStretch*> chosen;
  for (int k = choice.first; k <= choice.last; ++k) {
    for (const CoherentStretch& stretch : reads.stretches[static_cast<std::size_t>(k)]) {
      if (choice.part == kWholeWay || stretch.part == choice.part) chosen.push_back(&stretch);
    }
  }
  return chosen;
}

Tile mean_over_lengths(const StretchChoice& choice, const Tile& sum) {
  return sum / static_cast<float>(choice.last - choice.first + 1);
}

template <class OfStretch>
Tile mean_over_lengths(const StretchedReads& reads, const StretchChoice& choice,
                       const OfStretch& of_stretch) {
  Tile sum = Tile::Zero();
  for (const CoherentStretch* stretch : chosen_stretches(reads, choice)) {
    sum += of_stretch(*stretch);
  }
  return mean_over_lengths(choice, sum);
}

}  // namespace

StretchedReads stretched_reads(const TagPhases& phases, double wavelength, double height,
                               const Eigen::Vector2d& middle) {
  StretchedReads all;
  all.reads = search_reads(phases, kWholeAperture, height, middle);
  all.reads.apertures.clear();
  if (phases.size() == 0) return all;
  const Eigen::ArrayXd travel = travel_of(phases);
  const std::vector<Piece> pieces = pieces_of(phases, travel, kShortestStretch * wavelength);
  const Parts parts(phases);
  all.reads.apertures.reserve(pieces.size());
  for (const Piece& piece : pieces) all.reads.apertures.push_back(piece.reads);
  std::vector<StretchChannel> channels = shortest_channels(pieces);
  for (std::size_t k = 0; k < kStretchLengths; ++k) {
    if (k > 0) channels = twice_as_long(channels, all);
    all.stretches[k] = stretches_of(channels, travel, wavelength, parts);
  }
  return all;
}

Tile stretch_likelihood(const StretchedReads& reads, const StretchChoice& choice, const Tile& x,
                        const Tile& y, const Tile& z) {
  const Tile sum = stretch_sums(reads, chosen_stretches(reads, choice), x, y, z);
  return mean_over_lengths(choice, sum);
}

Tile stretch_likelihood(const StretchedReads& reads, const StretchChoice& choice,
                        const std::vector<PieceSums>& of_pieces) {
  const std::vector<PieceSums> sums = all_sums(reads, of_pieces);
  return mean_over_lengths(
      reads, choice, [&](const CoherentStretch& stretch) { return likelihood_of(stretch, sums); });
}

Tile likelihood_of_noise(const StretchedReads& reads, const StretchChoice& choice,
                         const std::vector<PieceSums>& of_pieces, double noise_rad) {
  const auto left = static_cast<float>(-std::expm1(-noise_rad * noise_rad));
  const std::vector<PieceSums> sums = all_sums(reads, of_pieces);
  return mean_over_lengths(reads, choice, [&](const CoherentStretch& stretch) {
    return likelihood_with(stretch, sums, left);
  });
}

}  // namespace tagfield
