// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/dah.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/differential_brightness.h"
#include "tagfield/localization/phase_noise.h"

namespace tagfield {
namespace {

/// Phase error added by the grid's spacing [rad]: a tag is seldom at the middle of a cell.
constexpr double kGridNoise = 0.35;
constexpr double kMinNoise = 1e-3;       ///< Of a phase [rad], if none is observed.
constexpr int kDraws = 16;               ///< Noise realizations that give the expected error.
constexpr std::size_t kFinished = 6;     ///< Number of brightest positions that are refined.
constexpr double kFirstSpacing = 0.012;  ///< Of the tile that searches for the summit [m].
constexpr double kLastSpacing = 1e-4;    ///< [m]

/// Vector from an antenna to a point on the floor.
Eigen::Vector2d from_antenna(const SearchRead& read, const Eigen::Vector2d& p) {
  return p - Eigen::Vector2d(static_cast<double>(read.x), static_cast<double>(read.y));
}

/// Square array of points around `p`, `spacing` apart.
void lay_tile(const Eigen::Vector2d& p, double spacing, Tile& x, Tile& y) {
  constexpr int kSide = 8;
  static_assert(kSide * kSide == kTile);
  for (int i = 0; i < kTile; ++i) {
    // One of the points is `p` itself.
    const int column = i % kSide - kSide / 2;
    const int row = i / kSide - kSide / 2;
    x[i] = static_cast<float>(p.x() + spacing * column);
    y[i] = static_cast<float>(p.y() + spacing * row);
  }
}

/// Summit near `p`, relative to the reads' middle.
Eigen::Vector2d summit(const SearchReads& reads, double noise_rad, Eigen::Vector2d p) {
  constexpr int kMaxMoves = 30;
  Tile x;
  Tile y;
  double spacing = kFirstSpacing;
  for (int move = 0; move < kMaxMoves && spacing > kLastSpacing; ++move) {
    lay_tile(p, spacing, x, y);
    Eigen::Index best = 0;
    differential_brightness(reads, noise_rad, x, y).maxCoeff(&best);
    const Eigen::Vector2d there(static_cast<double>(x[best]), static_cast<double>(y[best]));
    if ((there - p).cwiseAbs().maxCoeff() < 2.5 * spacing) spacing /= 4.0;
    p = there;
  }
  return p;
}

/// The positions moved to their summits, at unchanged heights.
std::vector<PositionVector> finished(const TagPhases& phases, const HeightModel& height,
                                     std::vector<PositionVector> places, double noise_rad) {
  if (places.size() > kFinished) places.resize(kFinished);
  for (PositionVector& place : places) {
    const Eigen::Vector2d middle = middle_of(phases);
    const SearchReads reads =
        search_reads(phases, kWholeAperture, to_position(height, place).z(), middle);
    place.head<2>() = middle + summit(reads, noise_rad, place.head<2>() - middle);
  }
  return places;
}

/// The same reads, simulated for a tag at `p` with noise.
SearchReads drawn(SearchReads reads, const Eigen::Vector2d& p, double noise_rad,
                  RandomStream& stream) {
  for (SearchRead& read : reads.reads) {
    const double r = std::sqrt(from_antenna(read, p).squaredNorm() + read.height_squared);
    const double turns = read.turns_per_metre * r + noise_rad / kTwoPi * standard_normal(stream);
    read.turns = static_cast<float>(turns - std::round(turns));
  }
  return reads;
}

/// Information on x and y for a phase noise of 1 rad, each aperture's offset unknown [1/m²].
Eigen::Matrix2d information_at(const SearchReads& reads, const Eigen::Vector2d& p) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const Aperture& aperture : reads.apertures) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (Eigen::Index i = aperture.begin; i < aperture.begin + aperture.count; ++i) {
      const SearchRead& read = reads.reads[static_cast<std::size_t>(i)];
      const Eigen::Vector2d away = from_antenna(read, p);
      const Eigen::Vector2d slope = kTwoPi * static_cast<double>(read.turns_per_metre) * away /
                                    std::sqrt(away.squaredNorm() + read.height_squared + 1e-12);
      information += slope * slope.transpose();
      sum += slope;
    }
    information -=
        sum * sum.transpose() / static_cast<double>(std::max<Eigen::Index>(aperture.count, 1));
  }
  return information;
}

/// √ of the mean of eᵀ J e/2 over `kDraws` sets of reads simulated for a tag at the position with
/// the observed noise, where e is the summit's error on the floor and J⁻¹ its lower bound. Noise of
/// the reference and data-dependent weights have no simple closed form.
double error_factor(const TagPhases& phases, const PositionVector& place, double z,
                    double kernel_rad, double noise_rad, RandomStream& stream) {
  const Eigen::Vector2d middle = middle_of(phases);
  const SearchReads reads = search_reads(phases, kWholeAperture, z, middle);
  const Eigen::Vector2d p = place.head<2>() - middle;
  const Eigen::Matrix2d J = information_at(reads, p) / (noise_rad * noise_rad);
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::Vector2d e = summit(drawn(reads, p, noise_rad, stream), kernel_rad, p) - p;
    sum += e.dot(J * e);
  }
  return std::max(1.0, std::sqrt(sum / (2.0 * kDraws)));
}

TagEstimate locate_by_differences(const LocalizationProblem& problem, const std::string& tag,
                                  const SamplesOfTag& samples, const DahOptions& options) {
  CoherentJudgement judgement;
  judgement.min_share = options.min_share;
  judgement.climb = false;
  judgement.at_maxima = false;
  judgement.known_offsets = false;  // The offset cancels in differences.
  const double noise = largest_phase_noise(samples, options.min_noise_rad);
  const double grid_noise = std::hypot(noise, kGridNoise);
  judgement.error_factor = [&](const TagPhases& phases, const HeightModel& height,
                               const PositionVector& place) {
    RandomStream stream(0, Purpose::kTagSearch, stream_key(tag));
    return error_factor(phases, place, to_position(height, place).z(), noise,
                        largest_phase_noise(samples, kMinNoise), stream);
  };
  const Brightness brightness{[&](const SearchReads& reads, const Tile& x, const Tile& y) {
    return differential_brightness(reads, grid_noise, x, y);
  }};
  return locate_by_waves(
      problem, tag, samples, judgement, [&](const TagPhases& phases, const HeightModel& height) {
        return finished(phases, height, search_positions(phases, height, options, brightness),
                        noise);
      });
}

/// Keys of the options.
const OptionTable<DahOptions>& dah_options() {
  using O = DahOptions;
  static const OptionTable<O> of = [] {
    OptionTable<O> table{
        {setting<O>("min_noise_rad", "rad", "lower bound on the phase noise (standard deviation)",
                    &O::min_noise_rad, kOverZero),
         setting<O>("min_share", "", "minimum coherence; below it a tag is not taken to be at rest",
                    &O::min_share, kShareRange)}};
    add_search_options(table);
    return table;
  }();
  return of;
}

}  // namespace

Method dah_method(const DahOptions& options) {
  return one_by_one("dah",
                    "differential augmented hologram: phase differences, weighted by probability",
                    dah_options(), options, locate_by_differences);
}

}  // namespace tagfield
