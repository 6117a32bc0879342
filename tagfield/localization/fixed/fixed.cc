#include "tagfield/localization/fixed/fixed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/fixed/channel_offsets.h"
#include "tagfield/localization/fixed/place_posterior.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

constexpr std::size_t kFewestAntennas = 3;
constexpr double kCoarseCells = 1200;   ///< Of the area, about.
constexpr double kLeastEvidence = 4.6;  ///< ln 100: chance makes so much in one case of a hundred.
constexpr double kMostOfArea = 0.7;     ///< A place hardly better known than the area is none.
constexpr double kRangeStep = 0.02;     ///< [m]
constexpr std::size_t kTellingTags = 12;  ///< Of the phases' field.
/// A tag and all that is known of it.
struct FixedTag {
  const std::string* name = nullptr;
  const SamplesOfTag* samples = nullptr;
  std::vector<FixedReads> reads;
  TagOnGrid grid;
  double cell_m = 0.0;
  double spread_m = 0.0;  ///< Of the area by itself.
  std::string why_not;
};

struct Scene {
  std::vector<std::string> antennas;
  std::vector<FixedTag> tags;
  LearnedLaw law;
  ChannelTurns offsets;
  PhaseField field;
  double trust = 1.0;         ///< Exponent of the phases' likelihoods.
  std::string swapped;        ///< The two antennas that must have been exchanged, or "".
  bool out_of_order = false;  ///< Phases show other carriers than were told; they are not used.
};

double furthest(const std::vector<FixedReads>& reads, const Eigen::Vector3d& place) {
  double most = 0.0;
  for (const FixedReads& of : reads) most = std::max(most, (of.p_WA - place).norm());
  return most;
}

/// The area in which a tag may be: told, or within reach of all antennas that read it.
Eigen::AlignedBox2d area_of(const LocalizationProblem& problem,
                            const std::vector<FixedReads>& reads, double max_range_m) {
  if (problem.area.box) return *problem.area.box;
  Eigen::AlignedBox2d box;
  for (const FixedReads& of : reads) box.extend(Eigen::Vector2d(of.p_WA.head<2>()));
  const Eigen::Vector2d margin(max_range_m, max_range_m);
  return {box.min() - margin, box.max() + margin};
}

double spread_of(const std::vector<Eigen::Vector3d>& cells) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& cell : cells) mean += cell;
  mean /= static_cast<double>(cells.size());
  double squares = 0.0;
  for (const Eigen::Vector3d& cell : cells) squares += (cell - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(cells.size()));
}

WayLine line_of(const std::vector<FixedReads>& reads) {
  std::vector<Eigen::Vector2d> places;
  places.reserve(reads.size());
  for (const FixedReads& of : reads) places.emplace_back(of.p_WA.head<2>());
  return way_line(places);
}

std::vector<Eigen::Vector3d> cells_of(const LocalizationProblem& problem, const FixedTag& tag,
                                      const FixedOptions& options, double& cell_m) {
  const Eigen::AlignedBox2d area = area_of(problem, tag.reads, options.max_range_m);
  const Eigen::Vector2d size = area.sizes();
  cell_m = std::sqrt(size.prod() / kCoarseCells);
  const double height = plane_height(problem, *tag.name);
  const WayLine line = line_of(tag.reads);
  std::vector<Eigen::Vector3d> cells;
  for (double x = area.min().x() + 0.5 * cell_m; x < area.max().x(); x += cell_m) {
    for (double y = area.min().y() + 0.5 * cell_m; y < area.max().y(); y += cell_m) {
      const Eigen::Vector3d place(x, y, height);
      const bool is_near = furthest(tag.reads, place) <= options.max_range_m;
      if (is_near && is_within(problem.area, line.middle, line.along, {x, y})) {
        cells.push_back(place);
      }
    }
  }
  return cells;
}

std::size_t with_strength(const std::vector<FixedReads>& reads) {
  return static_cast<std::size_t>(std::count_if(
      reads.begin(), reads.end(), [](const FixedReads& of) { return of.strengths > 0.0; }));
}

FixedTag fixed_tag(const LocalizationProblem& problem, const std::vector<std::string>& antennas,
                   const std::string& name, const SamplesOfTag& samples,
                   const FixedOptions& options) {
  FixedTag tag;
  tag.name = &name;
  tag.samples = &samples;
  tag.reads = fixed_reads(problem, samples);
  const std::size_t count = with_strength(tag.reads);
  if (count < kFewestAntennas) {
    tag.why_not = fmt::format(
        "RSSI by {} antenna{} at rest, at least {} are needed: a tag read by more would be "
        "located, by one that moves too",
        count, count == 1 ? "" : "s", kFewestAntennas);
    return tag;
  }
  std::vector<Eigen::Vector3d> cells = cells_of(problem, tag, options, tag.cell_m);
  if (cells.empty()) {
    tag.why_not = "no place is in reach of all antennas that read it";
    return tag;
  }
  tag.spread_m = spread_of(cells);
  tag.grid = on_grid(antennas, tag.reads, std::move(cells), options);
  return tag;
}

std::vector<std::string> antennas_of(const LocalizationProblem& problem) {
  std::set<std::string> names;
  for (const auto& [tag, samples] : problem.samples) {
    for (const auto& [antenna, series] : samples) names.insert(antenna);
  }
  return {names.begin(), names.end()};
}

/// A reference tag is one whose area is its place.
void put_at_reference(const LocalizationProblem& problem, const std::vector<std::string>& antennas,
                      const FixedOptions& options, FixedTag& tag) {
  const auto known = problem.reference_tags.find(*tag.name);
  if (known == problem.reference_tags.end() || !tag.why_not.empty()) return;
  tag.grid = on_grid(antennas, tag.reads, {known->second}, options);
}

/// The first few whose places are not known.
std::vector<std::size_t> telling_tags(const Scene& scene, const LocalizationProblem& problem) {
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < scene.tags.size() && some.size() < kTellingTags; ++i) {
    const bool is_known = problem.reference_tags.count(*scene.tags[i].name) > 0;
    if (scene.tags[i].why_not.empty() && !is_known) some.push_back(i);
  }
  return some;
}

/// ln of how likely the phases of some tags are under a field, by where strengths put them.
double log_of_field(const Scene& scene, const std::vector<std::size_t>& some,
                    const std::vector<Eigen::ArrayXd>& weights, const PhaseField& field) {
  double log = 0.0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const FixedTag& tag = scene.tags[some[i]];
    for (const FixedReads& reads : tag.reads) {
      double most = 0.0;
      for (const auto& cell : tag.grid.cells) most = std::max(most, (cell - reads.p_WA).norm());
      const RangeLikelihood of = range_likelihood(reads, scene.offsets, field, most, kRangeStep);
      if (of.log.size() == 0) continue;
      const double best = of.log.maxCoeff();
      double sum = 0.0;
      for (std::size_t j = 0; j < tag.grid.cells.size(); ++j) {
        const double r = (tag.grid.cells[j] - reads.p_WA).norm();
        sum += weights[i][static_cast<Eigen::Index>(j)] * std::exp(most_likely(of, r, 0.0) - best);
      }
      log += best + std::log(sum + 1e-300);
    }
  }
  return log;
}

/// The likeliest field.
PhaseField field_of(const Scene& scene, const LocalizationProblem& problem,
                    const FixedOptions& options, int threads) {
  const std::vector<std::size_t> some = telling_tags(scene, problem);
  std::vector<Eigen::ArrayXd> weights;
  for (const std::size_t i : some) {
    const Eigen::ArrayXd logs = log_strength(scene.tags[i].grid, scene.law.of_tag[i], options);
    weights.push_back((logs - logs.maxCoeff()).exp());
    weights.back() /= weights.back().sum();
  }
  std::vector<PhaseField> fields;
  for (const double diffuse : {0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 0.9}) {
    for (const double delay : {10e-9, 20e-9, 40e-9}) {
      for (const double noise : {0.003, 0.01, 0.03, 0.1, 0.3, 0.9}) {
        if (diffuse + noise < 1.0 && (diffuse > 0.0 || delay == 10e-9)) {
          fields.push_back({diffuse, delay, noise});
        }
      }
    }
  }
  std::vector<double> logs(fields.size());
  parallel_for(fields.size(), threads,
               [&](std::size_t i) { logs[i] = log_of_field(scene, some, weights, fields[i]); });
  return fields[static_cast<std::size_t>(std::max_element(logs.begin(), logs.end()) -
                                         logs.begin())];
}

/// Of each antenna over the area's distances, as a density over that of the area itself.
std::vector<RangeLikelihood> ranges_of(const Scene& scene, const FixedTag& tag, double trust) {
  std::vector<RangeLikelihood> ranges;
  for (const FixedReads& reads : tag.reads) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const auto& cell : tag.grid.cells) {
      least = std::min(least, (cell - reads.p_WA).norm());
      most = std::max(most, (cell - reads.p_WA).norm());
    }
    ranges.push_back(
        range_likelihood(reads, scene.offsets, scene.field, most + tag.cell_m, kRangeStep));
    Eigen::ArrayXd& logs = ranges.back().log;
    if (logs.size() == 0) continue;
    logs *= trust;
    const auto begin = static_cast<Eigen::Index>(least / kRangeStep);
    const Eigen::ArrayXd there = logs.tail(logs.size() - begin);
    const double best = there.maxCoeff();
    logs -= best + std::log((there - best).exp().mean());
  }
  return ranges;
}

LogDensity density_of(const Scene& scene, const FixedTag& tag, const StrengthLaw& law, double trust,
                      const FixedOptions& options) {
  return [&scene, &tag, &law, &options, ranges = ranges_of(scene, tag, trust)](
             const std::vector<Eigen::Vector3d>& places, double reach_m) {
    const TagOnGrid there = on_grid(scene.antennas, tag.reads, places, options);
    Eigen::ArrayXd logs = log_strength(there, law, options);
    for (std::size_t a = 0; a < ranges.size(); ++a) {
      if (ranges[a].log.size() == 0) continue;
      for (std::size_t i = 0; i < places.size(); ++i) {
        logs[static_cast<Eigen::Index>(i)] +=
            most_likely(ranges[a], (places[i] - tag.reads[a].p_WA).norm(), reach_m);
      }
    }
    return logs;
  };
}

/// How far the phases' distances can be trusted: the exponent of their likelihoods under which
/// those of several antennas, which say more than a place has coordinates, agree best with one
/// another and with the strengths. Reflections that are no diffuse field leave less than 1.
double trust_of(const Scene& scene, const LocalizationProblem& problem, const FixedOptions& options,
                int threads) {
  constexpr double kTrusts[] = {1.0, 0.5, 0.25, 0.12, 0.06, 0.03, 0.015, 0.0};
  const std::vector<std::size_t> some = telling_tags(scene, problem);
  std::vector<double> sums(std::size(kTrusts));
  parallel_for(sums.size(), threads, [&](std::size_t k) {
    for (const std::size_t i : some) {
      const FixedTag& tag = scene.tags[i];
      sums[k] += log_integral({tag.grid.cells, tag.cell_m},
                              density_of(scene, tag, scene.law.of_tag[i], kTrusts[k], options));
    }
  });
  return kTrusts[std::max_element(sums.begin(), sums.end()) - sums.begin()];
}

Candidate candidate_of(const PosteriorPart& part, double height) {
  Candidate candidate;
  candidate.p_WT = {part.mean.x(), part.mean.y(), height};
  candidate.covariance = Eigen::Matrix3d::Zero();
  candidate.covariance->topLeftCorner<2, 2>() = part.covariance;
  candidate.expected_error_m = std::sqrt(part.covariance.trace());
  return candidate;
}

constexpr const char* kHelp =
    "another antenna, a tag at a known place, or the area where tags can "
    "be (--box) would help";

TagEstimate located(const LocalizationProblem& problem, const Scene& scene, std::size_t number,
                    const FixedOptions& options) {
  const FixedTag& tag = scene.tags[number];
  TagEstimate estimate = begun(*tag.name, *tag.samples);
  if (!tag.why_not.empty()) return not_located(std::move(estimate), tag.why_not);
  if (scene.law.evidence < kLeastEvidence && !scene.swapped.empty()) {
    return not_located(std::move(estimate),
                       fmt::format("the strengths fit far better with the places of antennas {} "
                                   "exchanged: are ports or poses mixed up?",
                                   scene.swapped));
  }
  if (scene.law.evidence < kLeastEvidence) {
    return not_located(std::move(estimate),
                       fmt::format("the strengths of all tags go by no law of distance that chance "
                                   "would not make as well; {}",
                                   kHelp));
  }
  const StrengthLaw& law = scene.law.of_tag[number];
  const AreaCells cells{tag.grid.cells, tag.cell_m};
  const double height = plane_height(problem, *tag.name);
  for (const PosteriorPart& part :
       posterior_parts(cells, density_of(scene, tag, law, scene.trust, options))) {
    estimate.candidates.push_back(candidate_of(part, height));
  }
  const double most = std::min(options.max_expected_error_m, kMostOfArea * tag.spread_m);
  const double error = estimate.candidates.front().expected_error_m;
  if (error > most) {
    return not_located(std::move(estimate), fmt::format("expected error {:.2f} m, limit {:.2f} m; "
                                                        "{}",
                                                        error, most, kHelp));
  }
  EstimateLimits limits;
  limits.max_expected_error_m = most;
  limits.max_rms_m = std::numeric_limits<double>::infinity();
  judge(limits, estimate);
  if (estimate.verdict == Verdict::kAmbiguous) {
    estimate.reason = fmt::format("{} places explain the strengths and phases; {}",
                                  estimate.candidates.size(), kHelp);
  }
  return estimate;
}

/// The same tags with two antennas' places exchanged.
std::vector<TagOnGrid> with_exchanged(const Scene& scene, const std::vector<std::size_t>& numbers,
                                      const FixedReads& one, const FixedReads& other,
                                      const FixedOptions& options) {
  std::vector<TagOnGrid> grids;
  for (const std::size_t number : numbers) {
    std::vector<FixedReads> reads = scene.tags[number].reads;
    for (FixedReads& of : reads) {
      const bool is_one = of.antenna == one.antenna;
      if (!is_one && of.antenna != other.antenna) continue;
      of.p_WA = is_one ? other.p_WA : one.p_WA;
      of.boresight_W = is_one ? other.boresight_W : one.boresight_W;
    }
    grids.push_back(on_grid(scene.antennas, reads, scene.tags[number].grid.cells, options));
  }
  return grids;
}

/// Which two antennas' exchange makes the strengths a hundred times likelier, the number of pairs
/// allowed for; "" where none does. By a few tags.
std::string swapped_antennas(const Scene& scene, const std::vector<std::size_t>& numbers,
                             const FixedOptions& options, int threads) {
  constexpr std::size_t kEnough = 16;
  std::vector<std::size_t> some = numbers;
  if (some.size() > kEnough) some.resize(kEnough);
  std::map<std::string, FixedReads> antennas;
  std::vector<TagOnGrid> grids;
  for (const std::size_t number : some) {
    grids.push_back(scene.tags[number].grid);
    for (const FixedReads& of : scene.tags[number].reads) antennas.emplace(of.antenna, of);
  }
  std::vector<std::pair<const FixedReads*, const FixedReads*>> pairs;
  for (auto one = antennas.begin(); one != antennas.end(); ++one) {
    for (auto other = std::next(one); other != antennas.end(); ++other) {
      pairs.emplace_back(&one->second, &other->second);
    }
  }
  std::vector<double> evidences(pairs.size());
  parallel_for(pairs.size(), threads, [&](std::size_t i) {
    const auto exchanged = with_exchanged(scene, some, *pairs[i].first, *pairs[i].second, options);
    evidences[i] = learn_law(exchanged, scene.antennas.size(), options).evidence;
  });
  const double told = learn_law(grids, scene.antennas.size(), options).evidence;
  const auto best = std::max_element(evidences.begin(), evidences.end());
  if (best == evidences.end()) return "";
  if (*best < told + kLeastEvidence + std::log(static_cast<double>(pairs.size()))) return "";
  const auto& [one, other] = pairs[static_cast<std::size_t>(best - evidences.begin())];
  return fmt::format("'{}' and '{}'", one->antenna, other->antenna);
}

Scene scene_of(const LocalizationProblem& problem, int threads, const FixedOptions& options) {
  Scene scene;
  scene.antennas = antennas_of(problem);
  for (const auto& [name, samples] : problem.samples) {
    scene.tags.push_back(fixed_tag(problem, scene.antennas, name, samples, options));
    put_at_reference(problem, scene.antennas, options, scene.tags.back());
  }
  std::vector<TagOnGrid> grids;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < scene.tags.size(); ++i) {
    if (!scene.tags[i].why_not.empty()) continue;
    grids.push_back(scene.tags[i].grid);
    numbers.push_back(i);
  }
  LearnedLaw learned = learn_law(grids, scene.antennas.size(), options);
  scene.law = learned;
  scene.law.of_tag.assign(scene.tags.size(), learned.of_all);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    scene.law.of_tag[numbers[i]] = learned.of_tag[i];
  }
  // Where a law holds as told, reflections alone can make another order likelier.
  if (scene.law.evidence < kLeastEvidence) {
    scene.swapped = swapped_antennas(scene, numbers, options, threads);
  }
  std::vector<std::vector<FixedReads>> reads;
  for (const FixedTag& tag : scene.tags) reads.push_back(tag.reads);
  scene.out_of_order = problem.has_phases && is_out_of_order(reads);
  if (!scene.out_of_order) scene.offsets = channel_offsets(problem);
  if (scene.offsets.empty()) return scene;
  scene.field = field_of(scene, problem, options, threads);
  scene.trust = trust_of(scene, problem, options, threads);
  return scene;
}

LocalizationResult locate_all(const LocalizationProblem& problem, int threads,
                              Diagnostics& diagnostics, const FixedOptions& options) {
  const Scene scene = scene_of(problem, threads, options);
  if (scene.out_of_order) {
    diagnostics.warn(
        "the phases are not used: they show that the channels' carriers are not those that were "
        "told. The reader's own hop table has their order; places are by strength alone");
  } else if (problem.has_phases && scene.offsets.empty()) {
    diagnostics.warn(
        "the phases are not used: every channel of every port has an offset of its own, which "
        "only a tag at a known place that all antennas read (--reference) or a calibration "
        "(--calibration) would tell; places are by strength alone");
  }
  LocalizationResult result;
  result.method = "fixed";
  result.estimates.resize(scene.tags.size());
  parallel_for(scene.tags.size(), threads, [&](std::size_t i) {
    const auto known = problem.reference_tags.find(*scene.tags[i].name);
    result.estimates[i] = known != problem.reference_tags.end()
                              ? reference_estimate(known->first, known->second)
                              : located(problem, scene, i, options);
  });
  return result;
}

/// The keys of its options.
const OptionTable<FixedOptions>& option_table() {
  using O = FixedOptions;
  static const OptionTable<O> of{with_lobe<O>(
      {setting<O>("slope_db", "dB", "by which RSSI falls for ten times the distance", &O::slope_db,
                  kOverZero),
       setting<O>("slope_sigma_db", "dB", "how uncertain that is before the data are seen",
                  &O::slope_sigma_db, kAtLeastZero),
       setting<O>("tag_sigma_db", "dB", "how tags of one kind differ", &O::tag_sigma_db,
                  kAtLeastZero),
       setting<O>("antenna_sigma_db", "dB", "how antennas differ, cables included",
                  &O::antenna_sigma_db, kAtLeastZero),
       setting<O>("fading_db", "dB", "by which reflections scatter RSSI, before the data are seen",
                  &O::fading_db, kOverZero),
       setting<O>("max_range_m", "m", "no tag is read from further away", &O::max_range_m,
                  kOverZero),
       setting<O>("rssi_max_error_m", "m", "a place expected to be worse is not given as located",
                  &O::max_expected_error_m, kOverZero)})};
  return of;
}

}  // namespace

Method fixed_method(const FixedOptions& options) {
  check_options(option_table(), options);
  const auto bound = [](const FixedOptions& of) -> LocateFunction {
    return [of](const LocalizationProblem& problem, int threads, Diagnostics& diagnostics) {
      return locate_all(problem, threads, diagnostics, of);
    };
  };
  return {"fixed", "antennas at rest: strengths by a law that tags share, phases over channels",
          bound(options), helps_of(option_table().table, options),
          [=](const MethodSettings& settings) {
            return bound(changed_options(option_table(), options, settings));
          }};
}

}  // namespace tagfield
