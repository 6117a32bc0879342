// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/particle.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/holograms/reach.h"
#include "tagfield/localization/phase_noise.h"

namespace tagfield {
namespace {

constexpr std::size_t kCoarseReads = 300;  ///< Reads used by short apertures.
constexpr int kStepsOfLevel = 4;           ///< For all apertures except the whole ones.
constexpr int kMaxSteps = 60;
constexpr double kEffective = 0.5;      ///< Minimum effective number of particles, relative to all.
constexpr double kClusterRadius = 0.1;  ///< [m]
constexpr std::size_t kMaxClusters = 8;
constexpr int kDrawsOfPlace = 1000;

/// Positions relative to the middle of the reads and the plane of the tag [m], with their
/// coherence.
struct Particles {
  std::vector<Eigen::Vector3f> places;
  std::vector<double> coherence;
};

/// One annealing target: coherence over apertures of one length.
struct Level {
  SearchReads reads;
  double spread_m = 0.0;  ///< Maximum scale of a move, as wide as the lobes.
};

/// State shared by all steps of one tag.
struct Search {
  TagPhases phases;
  HeightModel height;
  Eigen::Vector2d middle{0.0, 0.0};
  double concentration = 1.0;  ///< κ of a read.
  std::vector<Level> levels;
};

std::vector<double> coherence_of(const SearchReads& reads,
                                 const std::vector<Eigen::Vector3f>& places) {
  return by_tiles(places, [&](const Tile& x, const Tile& y, const Tile& z) {
    return brightness_in_space(reads, x, y, z);
  });
}

Eigen::Vector3d in_world(const Search& search, const Eigen::Vector3f& place) {
  return Eigen::Vector3d(search.middle.x(), search.middle.y(), search.height.z) +
         place.cast<double>();
}

/// Random position in reach; the middle if none is found.
Eigen::Vector3f draw_position(const Search& search, const Reach& reach,
                              const ParticleOptions& options, RandomStream& stream) {
  const bool known = search.height.kind == HeightModel::Kind::kKnown;
  for (int draw = 0; draw < kDrawsOfPlace; ++draw) {
    const double x = options.max_range_m * (2.0 * uniform(stream) - 1.0);
    const double y = options.max_range_m * (2.0 * uniform(stream) - 1.0);
    const double up = search.height.side * options.max_height_m * uniform(stream);
    Eigen::Vector3f place = Eigen::Vector3d(x, y, known ? 0.0 : up).cast<float>();
    if (reach.holds(in_world(search, place))) return place;
  }
  return Eigen::Vector3f::Zero();
}

/// Effective number of particles under the weights e^(gain · coherence), relative to all.
double effective_part(const std::vector<double>& coherence, double gain) {
  const double most = *std::max_element(coherence.begin(), coherence.end());
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : coherence) {
    const double weight = std::exp(gain * (value - most));
    sum += weight;
    squares += weight * weight;
  }
  return sum * sum / squares / static_cast<double>(coherence.size());
}

/// Largest gain up to `most` that keeps enough effective particles.
double next_gain(const std::vector<double>& coherence, double most) {
  if (effective_part(coherence, most) >= kEffective) return most;
  double low = 0.0;
  double high = most;
  for (int i = 0; i < 40; ++i) {
    const double half = 0.5 * (low + high);
    (effective_part(coherence, half) >= kEffective ? low : high) = half;
  }
  return low;
}

/// Systematic resampling by the weights e^(gain · coherence).
void resample(Particles& particles, double gain, RandomStream& stream) {
  const std::size_t count = particles.places.size();
  const double most = *std::max_element(particles.coherence.begin(), particles.coherence.end());
  std::vector<double> sums(count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += std::exp(gain * (particles.coherence[i] - most));
    sums[i] = sum;
  }
  Particles drawn;
  const double first = uniform(stream);
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double target = (static_cast<double>(i) + first) / static_cast<double>(count) * sum;
    while (at + 1 < count && sums[at] < target) ++at;
    drawn.places.push_back(particles.places[at]);
    drawn.coherence.push_back(particles.coherence[at]);
  }
  particles = std::move(drawn);
}

/// Scale of a move, from a hundredth of `spread` to all of it, as modes have many widths.
double draw_scale(double spread, RandomStream& stream) {
  return spread * std::pow(10.0, -2.0 * uniform(stream));
}

/// One Metropolis move of each particle, which leaves e^(gain · coherence) invariant.
void move_particles(const Search& search, const Level& level, double gain, Particles& particles,
                    RandomStream& stream) {
  const bool known = search.height.kind == HeightModel::Kind::kKnown;
  std::vector<Eigen::Vector3f> proposed;
  proposed.reserve(particles.places.size());
  for (const Eigen::Vector3f& place : particles.places) {
    const double scale = draw_scale(level.spread_m, stream);
    const auto level_move = standard_normal_pair(stream);
    const double up = known ? 0.0 : standard_normal(stream);
    Eigen::Vector3f there =
        place + (scale * Eigen::Vector3d(level_move[0], level_move[1], up)).cast<float>();
    // A tag on the other side cannot be distinguished from its mirror image on this one.
    if (!known) there.z() = static_cast<float>(search.height.side) * std::abs(there.z());
    proposed.push_back(there);
  }
  const std::vector<double> coherence = coherence_of(level.reads, proposed);
  for (std::size_t i = 0; i < proposed.size(); ++i) {
    if (std::log(uniform(stream) + 1e-300) > gain * (coherence[i] - particles.coherence[i])) {
      continue;
    }
    particles.places[i] = proposed[i];
    particles.coherence[i] = coherence[i];
  }
}

/// Raises the gain of one level from `reached` by resampling and moving. Returns the gain reached.
double anneal(const Search& search, const Level& level, double reached, int steps,
              Particles& particles, RandomStream& stream) {
  double gain = reached;
  for (int step = 0; step < steps && gain < search.concentration; ++step) {
    const double more = next_gain(particles.coherence, search.concentration - gain);
    resample(particles, more, stream);
    gain += more;
    move_particles(search, level, gain, particles, stream);
  }
  return gain;
}

Particles spread_and_anneal(const Search& search, const ParticleOptions& options,
                            RandomStream& stream) {
  Particles particles;
  particles.places.reserve(options.particles);
  const Reach reach(search.phases, options.max_range_m);
  for (std::size_t i = 0; i < options.particles; ++i) {
    particles.places.push_back(draw_position(search, reach, options, stream));
  }
  for (const Level& level : search.levels) {
    const bool last = &level == &search.levels.back();
    // The particles concentrated by shorter apertures are the initial spread of this level.
    particles.coherence = coherence_of(level.reads, particles.places);
    anneal(search, level, 0.0, last ? kMaxSteps : kStepsOfLevel, particles, stream);
  }
  // The last moves let the particles settle into the shape of each mode.
  for (int i = 0; i < kStepsOfLevel; ++i) {
    move_particles(search, search.levels.back(), search.concentration, particles, stream);
  }
  return particles;
}

/// Means of the particles around the best ones, in the unknowns of the fit.
std::vector<PositionVector> clusters_of(const Search& search, const Particles& particles) {
  std::vector<std::size_t> order(particles.places.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return particles.coherence[a] > particles.coherence[b];
  });
  std::vector<PositionVector> means;
  std::vector<bool> taken(order.size(), false);
  for (const std::size_t best : order) {
    if (taken[best]) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Eigen::Vector3f apart = particles.places[i] - particles.places[best];
      if (taken[i] || static_cast<double>(apart.norm()) > kClusterRadius) continue;
      taken[i] = true;
      sum += in_world(search, particles.places[i]);
      count += 1.0;
    }
    means.push_back(to_unknowns(search.height, sum / count));
    if (means.size() == kMaxClusters) break;
  }
  return means;
}

/// Variance of a phase [rad²]: its noise and, where known, the effect of the pose error.
double phase_variance(const LocalizationProblem& problem, const SamplesOfTag& samples,
                      const TagPhases& phases, double least) {
  const double noise = largest_phase_noise(samples, least);
  const double pose = problem.pose_error ? problem.pose_error->sigma_m : 0.0;
  return noise * noise + std::pow(pose * phases.wavenumber.maxCoeff(), 2);
}

Search prepare(const TagPhases& phases, const HeightModel& height) {
  Search search;
  search.middle = middle_of(phases);
  search.height = height;
  const double lambda = 2.0 * longest_cycle(phases);
  const TagPhases coarse = thinned(phases, kCoarseReads);
  const auto add = [&](const TagPhases& reads, double length, double spread) {
    search.levels.push_back({search_reads(reads, length, height.z, search.middle), spread});
  };
  add(coarse, 1.5 * lambda, 2.0 * lambda);
  add(coarse, 4.5 * lambda, 0.7 * lambda);
  add(phases, 13.5 * lambda, 0.25 * lambda);
  add(phases, kWholeAperture, 0.1 * lambda);
  search.phases = phases;
  return search;
}

TagEstimate locate_by_particles(const LocalizationProblem& problem, const std::string& tag,
                                const SamplesOfTag& samples, const ParticleOptions& options) {
  CoherentJudgement judgement;
  judgement.min_share = options.min_share;
  judgement.climb = false;
  return locate_by_waves(
      problem, tag, samples, judgement, [&](const TagPhases& phases, const HeightModel& height) {
        Search search = prepare(phases, height);
        search.concentration =
            1.0 / phase_variance(problem, samples, phases, options.min_noise_rad);
        RandomStream stream(options.seed, Purpose::kTagSearch, stream_key(tag));
        return clusters_of(search, spread_and_anneal(search, options, stream));
      });
}

/// Keys of the options.
const OptionTable<ParticleOptions>& particle_options() {
  using O = ParticleOptions;
  static const OptionTable<O> of{
      {setting<O>("particles", "", "positions that are drawn", &O::particles, {100.0, false, 1e6}),
       setting<O>("max_range_m", "m", "half of the reads are from within this range",
                  &O::max_range_m, kOverZero),
       setting<O>("max_height_m", "m", "above or below the antennas, where the height is unknown",
                  &O::max_height_m, kOverZero),
       setting<O>("min_noise_rad", "rad", "lower bound on the phase noise (standard deviation)",
                  &O::min_noise_rad, kOverZero),
       setting<O>("min_share", "", "minimum coherence; below it a tag is not taken to be at rest",
                  &O::min_share, kShareRange),
       setting<O>("seed", "", "of the draws", &O::seed, kAtLeastZero)}};
  return of;
}

}  // namespace

Method particle_method(const ParticleOptions& options) {
  return one_by_one("particle", "particles drawn together by the likelihood of wrapped phase",
                    particle_options(), options, locate_by_particles);
}

}  // namespace tagfield
