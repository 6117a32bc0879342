// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/stretches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

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

/// Enough to tell how many samples are independent.
void add_travel(const Aperture& piece, const Eigen::ArrayXd& travel, std::vector<double>& along) {
  for (Index i = piece.begin; i < piece.begin + piece.count; ++i) along.push_back(travel[i]);
}

std::vector<double> thinned_out(std::vector<double> all) {
  constexpr std::size_t kEnough = 150;
  if (all.size() <= kEnough) return all;
  std::sort(all.begin(), all.end());
  std::vector<double> some;
  some.reserve(kEnough);
  for (std::size_t i = 0; i < kEnough; ++i) some.push_back(all[i * all.size() / kEnough]);
  return some;
}

/// The stretch that the pieces make.
CoherentStretch stretch_of(const std::vector<Piece>& pieces,
                           const std::vector<std::size_t>& numbers, const Eigen::ArrayXd& travel,
                           double wavelength) {
  std::map<std::size_t, std::vector<std::size_t>> by_span;
  for (const std::size_t i : numbers) by_span[pieces[i].span].push_back(i);
  CoherentStretch stretch;
  std::vector<double> whole;
  double of_channels = 0.0;
  for (const auto& [span, of_span] : by_span) {
    std::vector<double> along;
    for (const std::size_t i : of_span) add_travel(pieces[i].reads, travel, along);
    stretch.reads += static_cast<float>(along.size());
    whole.insert(whole.end(), along.begin(), along.end());
    of_channels += independent_samples(thinned_out(std::move(along)), wavelength);
    stretch.channels.push_back(of_span);
  }
  // Channels that were read at the same places see the same reflections.
  const double all = by_span.size() == 1
                         ? of_channels
                         : independent_samples(thinned_out(std::move(whole)), wavelength);
  const double offsets = static_cast<double>(by_span.size());
  stretch.freedom =
      static_cast<float>(std::max(0.0, of_channels - offsets) * std::min(1.0, all / of_channels));
  return stretch;
}

std::vector<CoherentStretch> stretches_of(const std::vector<Piece>& pieces,
                                          const Eigen::ArrayXd& travel, double wavelength,
                                          std::int64_t pieces_each, const Parts& parts) {
  std::map<std::pair<std::string, std::int64_t>, std::vector<std::size_t>> numbers;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    numbers[{pieces[i].antenna, pieces[i].number / pieces_each}].push_back(i);
  }
  std::vector<CoherentStretch> stretches;
  for (const auto& [key, of_stretch] : numbers) {
    CoherentStretch stretch = stretch_of(pieces, of_stretch, travel, wavelength);
    stretch.part = parts.of(pieces[of_stretch.front()].reads.begin);
    if (stretch.freedom > 0.0f) stretches.push_back(std::move(stretch));
  }
  return stretches;
}

/// −f ln(1 − the share of the power that adds up), of the reads that count.
Tile likelihood_of(const CoherentStretch& stretch, const std::vector<PieceSums>& of_pieces) {
  Tile power = Tile::Zero();
  Tile reads = Tile::Zero();
  for (const auto& channel : stretch.channels) {
    PieceSums sum;
    for (const std::size_t piece : channel) {
      sum.waves.in_phase += of_pieces[piece].waves.in_phase;
      sum.waves.quadrature += of_pieces[piece].waves.quadrature;
      sum.reads += of_pieces[piece].reads;
    }
    power += (sum.waves.in_phase.square() + sum.waves.quadrature.square()) / sum.reads.max(1.0f);
    reads += sum.reads;
  }
  const Tile freedom = stretch.freedom / stretch.reads * reads;
  return -freedom * (1.0f - power / reads.max(1.0f)).max(kLeastLeft).log();
}

/// Likewise, as if only `left` of each read's power were noise.
Tile likelihood_with(const CoherentStretch& stretch, const std::vector<PieceSums>& of_pieces,
                     float left) {
  Tile offsets = Tile::Zero();
  Tile reads = Tile::Zero();
  for (const auto& channel : stretch.channels) {
    Tile of_channel = Tile::Zero();
    for (const std::size_t piece : channel) of_channel += of_pieces[piece].reads;
    offsets += of_channel.min(1.0f);
    reads += of_channel;
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
  for (const CoherentStretch* stretch : chosen_stretches(reads, choice))
    sum += of_stretch(*stretch);
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
  for (int k = 0; k < kStretchLengths; ++k) {
    all.stretches[static_cast<std::size_t>(k)] =
        stretches_of(pieces, travel, wavelength, std::int64_t{1} << k, parts);
  }
  return all;
}

Tile stretch_likelihood(const StretchedReads& reads, const StretchChoice& choice, const Tile& x,
                        const Tile& y, const Tile& z) {
  const Tile sum = stretch_sums(reads.reads, chosen_stretches(reads, choice), x, y, z);
  return mean_over_lengths(choice, sum);
}

Tile stretch_likelihood(const StretchedReads& reads, const StretchChoice& choice,
                        const std::vector<PieceSums>& of_pieces) {
  return mean_over_lengths(reads, choice, [&](const CoherentStretch& stretch) {
    return likelihood_of(stretch, of_pieces);
  });
}

Tile likelihood_of_noise(const StretchedReads& reads, const StretchChoice& choice,
                         const std::vector<PieceSums>& of_pieces, double noise_rad) {
  const auto left = static_cast<float>(-std::expm1(-noise_rad * noise_rad));
  return mean_over_lengths(reads, choice, [&](const CoherentStretch& stretch) {
    return likelihood_with(stretch, of_pieces, left);
  });
}

}  // namespace tagfield
