// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/robust.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/holograms/likelihood_spread.h"
#include "tagfield/localization/holograms/reach.h"
#include "tagfield/localization/holograms/segments.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

constexpr double kFirstCell = 0.9;        ///< Of λ/2, which is one turn of phase.
constexpr float kImpossible = -1e9F;      ///< ln of a likelihood.
constexpr std::size_t kMaxima = 24;       ///< On each plane.
constexpr double kOnePlace = 0.45;        ///< Maxima closer than this are one position [m].
constexpr double kMinProbability = 0.01;  ///< Of a candidate, relative to the best.
/// Objects within a wavelength of a tag shift the point that its waves appear to come from:
/// standard deviation along each axis, chosen on twelve halls and checked on twelve others
/// (docs/methods.md) [λ].
constexpr double kShift = 0.025;

/// State shared by the steps of one tag.
struct RobustSearch {
  TagPhases phases;
  HeightModel height;
  double wavelength = 0.0;  ///< Of the carrier [m].
  double max_range_m = 0.0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  SegmentedReads all;  ///< Points are relative to `middle` and `height.z`.
};

double wavelength_of(const LocalizationProblem& problem, const TagPhases& phases) {
  return 2.0 * problem.multiple() * longest_cycle(phases);
}

/// Best positions on a plane at height z. All cells are evaluated with half of the reads, the best
/// tenth of them with all.
std::vector<Vector3d> best_on_plane(const RobustSearch& search, const TagPhases& coarse,
                                    const TagPhases& coarsest, double z) {
  const SegmentedReads few = segmented_reads(coarse, search.wavelength, z, search.middle);
  const SegmentedReads fewest = segmented_reads(coarsest, search.wavelength, z, search.middle);
  const auto level = [](const SegmentedReads& reads, int first, int last) {
    return [&reads, choice = SegmentChoice{first, last}](const Tile& x, const Tile& y) {
      return segment_likelihood(reads, choice, x, y, Tile::Zero());
    };
  };
  const Grid grid{search.middle, kFirstCell * longest_cycle(search.phases), search.max_range_m};
  const PlaneInReach in_reach(search.phases, z, search.max_range_m);
  GridPreselection glances;
  glances.at_blocks = [first = level(fewest, 0, 0)](const CellBlock& block) {
    return light_of_block(first, block);
  };
  std::vector<Vector3d> places;
  for (const GridMaximum& maximum : search_grid(
           grid, in_reach,
           {level(few, 0, 0), level(few, 1, 2), level(few, kForPlaces.first, kForPlaces.last)},
           kMaxima, glances)) {
    places.emplace_back(maximum.p.x(), maximum.p.y(), z);
  }
  return places;
}

std::vector<Vector3d> best_places(const RobustSearch& search, std::size_t reads) {
  const TagPhases coarse = thinned(search.phases, reads);
  const TagPhases coarsest = thinned(search.phases, (reads + 1) / 2);
  std::vector<Vector3d> places;
  for (const double z : heights_to_search(search.height)) {
    for (const Vector3d& p : best_on_plane(search, coarse, coarsest, z)) places.push_back(p);
  }
  return places;
}

Vector3d origin_of(const RobustSearch& search) {
  return {search.middle.x(), search.middle.y(), search.height.z};
}

/// Likelihood of a part of the path, or of all of it.
LogLikelihood likelihood_of(const RobustSearch& search, int part) {
  return [&search, part](const Tile& x, const Tile& y, const Tile& z) {
    return segment_likelihood(search.all, {kForPlaces.first, kForPlaces.last, part}, x, y, z);
  };
}

/// Disagreement between the parts of the path: twice the log-likelihood gained by a position per
/// part over a common one, per degree of freedom; 1 is expected by chance.
double disagreement(const RobustSearch& search, LikelihoodSpread spread) {
  spread.mean -= origin_of(search);
  constexpr double kDeviations = 6.0;
  std::vector<LogLikelihood> parts;
  parts.reserve(kPathParts);
  for (int part = 0; part < kPathParts; ++part) parts.push_back(likelihood_of(search, part));
  double gained = -spread.log_peak;
  for (const double greatest : greatest_about(spread, kDeviations, parts)) gained += greatest;
  const int unknowns = search.height.unknowns();
  return 2.0 * gained / (unknowns * (kPathParts - 1));
}

/// The likelihood on the side of the antennas on which the height is estimated.
LogLikelihood likelihood_on_side(const RobustSearch& search) {
  const double side = search.height.side;
  const double lowest = (side * search.phases.z).minCoeff() - side * search.height.z;
  return [likelihood = likelihood_of(search, kWholePath), up = static_cast<float>(side),
          least = static_cast<float>(lowest)](const Tile& x, const Tile& y, const Tile& z) {
    return Tile((up * z < least).select(Tile::Constant(kImpossible), likelihood(x, y, z)));
  };
}

/// The maxima near the positions found on planes, which are up to 0.35 m above or below, the most
/// likely first.
std::vector<Vector3d> maxima_in_space(const RobustSearch& search,
                                      const std::vector<Vector3d>& places) {
  const LogLikelihood likelihood = likelihood_on_side(search);
  std::vector<Climbed> maxima;
  maxima.reserve(places.size());
  for (const Vector3d& p : places) maxima.push_back(climbed(likelihood, p - origin_of(search)));
  std::stable_sort(maxima.begin(), maxima.end(),
                   [](const Climbed& a, const Climbed& b) { return a.log > b.log; });
  std::vector<Vector3d> ranked;
  ranked.reserve(maxima.size());
  for (const Climbed& maximum : maxima) ranked.emplace_back(maximum.place + origin_of(search));
  return ranked;
}

/// Likelihood around each position, computed on first use.
class FirstBoxes {
 public:
  FirstBoxes(const RobustSearch& search, const std::vector<Vector3d>& places)
      : search_(search), places_(places), boxes_(places.size()) {}
  const FirstBox& about(std::size_t number) {
    std::optional<FirstBox>& box = boxes_[number];
    if (!box) {
      const bool level = search_.height.kind == HeightModel::Kind::kKnown;
      box = first_box(likelihood_of(search_, kWholePath), places_[number] - origin_of(search_),
                      level);
    }
    return *box;
  }

 private:
  const RobustSearch& search_;
  const std::vector<Vector3d>& places_;
  std::vector<std::optional<FirstBox>> boxes_;
};

bool is_new(const std::vector<LikelihoodSpread>& all, const Vector3d& p) {
  return std::all_of(all.begin(), all.end(), [&](const LikelihoodSpread& other) {
    return (other.mean - p).head<2>().norm() > kOnePlace;
  });
}

/// Spread of the likelihood, raised to the power 1/`doubt`, around the positions, one for each
/// group of close ones, the most probable first.
std::vector<LikelihoodSpread> distinct(const RobustSearch& search,
                                       const std::vector<Vector3d>& places, double doubt,
                                       FirstBoxes& boxes) {
  std::vector<LikelihoodSpread> all;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!is_new(all, places[i])) continue;
    all.push_back(likelihood_spread(likelihood_of(search, kWholePath), boxes.about(i), doubt));
    all.back().mean += origin_of(search);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.log_mass > b.log_mass; });
  std::vector<LikelihoodSpread> kept;
  for (const LikelihoodSpread& one : all) {
    if (is_new(kept, one.mean)) kept.push_back(one);
  }
  return kept;
}

/// Spreads, widened if parts of the path disagree at the most probable position.
std::vector<LikelihoodSpread> doubted(const RobustSearch& search,
                                      const std::vector<Vector3d>& places) {
  FirstBoxes boxes(search, places);
  std::vector<LikelihoodSpread> spreads = distinct(search, places, 1.0, boxes);
  if (spreads.empty()) return spreads;
  const double doubt = disagreement(search, spreads.front());
  return doubt > 1.0 ? distinct(search, places, doubt, boxes) : spreads;
}

/// Covariance that the likelihood does not include: the shift, and a given pose error, which varies
/// more slowly than fading.
Eigen::Matrix3d beyond_likelihood(const RobustSearch& search, const TagFit& fit) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const double shift = kShift * search.wavelength;
  covariance.topLeftCorner<2, 2>() += shift * shift * Eigen::Matrix2d::Identity();
  if (!search.phases.pose_error) return covariance;
  return covariance + to_position_covariance(search.height, fit.unknowns,
                                             honest_covariance(search.phases, search.height, fit));
}

Candidate candidate_of(const RobustSearch& search, const LikelihoodSpread& spread) {
  Candidate candidate;
  candidate.p_WT = spread.mean;
  if (search.height.kind == HeightModel::Kind::kKnown) candidate.p_WT.z() = search.height.z;
  const PositionVector place = to_unknowns(search.height, candidate.p_WT);
  const TagFit fit{place, offsets_at(search.phases, search.height, place), 0.0};
  candidate.covariance = spread.covariance + beyond_likelihood(search, fit);
  candidate.expected_error_m = std::sqrt(candidate.covariance->topLeftCorner<2, 2>().trace());
  candidate.rms_m = std::sqrt(residuals_of(search.phases, search.height, fit).square().mean());
  return candidate;
}

TagEstimate judged(const LocalizationProblem& problem, const RobustSearch& search,
                   const std::vector<LikelihoodSpread>& spreads, TagEstimate estimate) {
  if (spreads.empty()) {
    return not_located(std::move(estimate), "no position is within range of most reads");
  }
  for (const LikelihoodSpread& spread : spreads) {
    const double less = spread.log_mass - spreads.front().log_mass;
    if (less < std::log(kMinProbability)) break;
    estimate.candidates.push_back(candidate_of(search, spread));
  }
  judge(problem.limits, estimate);
  return estimate;
}

TagEstimate locate_robustly(const LocalizationProblem& problem, const std::string& tag,
                            const SamplesOfTag& samples, const RobustOptions& options) {
  TagEstimate estimate = begun(tag, samples);
  const std::string hopeless = why_not_locatable(samples);
  if (!hopeless.empty()) return not_located(std::move(estimate), hopeless);
  RobustSearch search;
  search.phases = coherent_reads(problem, samples);
  estimate.reads = static_cast<std::size_t>(search.phases.size());
  const std::string why_too_few = too_few(search.phases);
  if (!why_too_few.empty()) return not_located(std::move(estimate), why_too_few);
  search.height = height_model(problem, tag, search.phases);
  search.wavelength = wavelength_of(problem, search.phases);
  search.max_range_m = options.max_range_m;
  search.middle = middle_of(search.phases);
  search.all = segmented_reads(search.phases, search.wavelength, search.height.z, search.middle);
  std::vector<Vector3d> places = best_places(search, options.search_reads);
  if (search.height.kind != HeightModel::Kind::kKnown) places = maxima_in_space(search, places);
  return judged(problem, search, doubted(search, places), std::move(estimate));
}

const OptionTable<RobustOptions>& robust_options() {
  using O = RobustOptions;
  static const OptionTable<O> of{
      {setting<O>("max_range_m", "m", "half of the reads are from within this range",
                  &O::max_range_m, {0.0, true, 100.0}),
       setting<O>("search_reads", "", "reads that the search uses at most", &O::search_reads,
                  kAtLeastOne)}};
  return of;
}

}  // namespace

Method robust_method(const RobustOptions& options) {
  return one_by_one("robust",
                    "for reflections: sections of the path, each as long as its phasors add up",
                    robust_options(), options, locate_robustly);
}

}  // namespace tagfield
