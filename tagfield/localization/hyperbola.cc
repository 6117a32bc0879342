#include "tagfield/localization/hyperbola.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/residuals.h"
#include "tagfield/localization/seeds.h"
#include "tagfield/localization/segment_fit.h"
#include "tagfield/localization/unwrap.h"

namespace tagfield {
namespace {

/// Reads beyond one for each unknown; a fit to fewer follows the noise and seems better than it is.
constexpr std::size_t kFewestSpare = 16;
constexpr Eigen::Index kThinReads = 120;  ///< Reads by which intersections are ranked.
constexpr std::size_t kStarts = 12;       ///< Intersections to start a fit from.
constexpr double kApart = 0.1;            ///< Starts nearer than this are one [m].
constexpr double kSame = 0.03;            ///< Minima nearer than this are one [m].
constexpr int kSlipRounds = 3;

void require_positive(double value, const char* name) {
  if (std::isfinite(value) && value > 0.0) return;
  throw Error(fmt::format("{} must be finite and over 0, but is {}", name, value));
}

void check(const HyperbolaOptions& options, double tag_height) {
  require_positive(options.stride_m, "stride_m");
  require_positive(options.max_step, "max_step");
  if (options.max_step > 1.0) throw Error("max_step must be at most 1");
  if (options.max_hyperbolae < 2) throw Error("max_hyperbolae must be at least 2");
  if (!std::isfinite(tag_height)) throw Error("the tag's height must be finite");
}

/// What one tag's estimate is made of.
struct Problem {
  std::vector<PhaseSegment> segments;
  FitData data;
};

Problem pose_problem(const SamplesOfTag& samples, double height, double max_step) {
  Problem problem;
  for (const auto& [antenna, series] : samples) {
    if (extent_of(series) < kStillExtent) continue;
    for (PhaseSegment& segment : unwrap(series, max_step)) {
      if (segment.samples.size() >= 2) problem.segments.push_back(std::move(segment));
    }
  }
  problem.data = make_fit_data(problem.segments, height);
  return problem;
}

/// Why the phase that could be followed can't locate a tag; empty if it might.
std::string too_few(const Problem& problem) {
  const auto reads = static_cast<std::size_t>(problem.data.distance.size());
  if (reads < kFewestReads) {
    return "the antenna moved too far between reads for the phase to be followed";
  }
  // Unknown are the place and an offset for each segment.
  if (reads < problem.segments.size() + 2 + kFewestSpare) {
    return fmt::format("too few reads: the phase could be followed over {} in {} segments", reads,
                       problem.segments.size());
  }
  return "";
}

std::vector<Eigen::Vector2d> refined(const FitData& data,
                                     const std::vector<Eigen::Vector2d>& starts) {
  std::vector<Eigen::Vector2d> minima;
  minima.reserve(starts.size());
  for (const Eigen::Vector2d& start : starts) minima.push_back(refine(data, start));
  return minima;
}

/// The best place so far and its mirror image, with the other starts.
std::vector<Eigen::Vector2d> with_mirror_images(const FitData& data,
                                                std::vector<Eigen::Vector2d> places) {
  const std::size_t count = std::min<std::size_t>(places.size(), 3);
  for (std::size_t i = 0; i < count; ++i) places.push_back(mirror_image(data, places[i]));
  return places;
}

/// Distinct local minima of E over all reads, best first: from the intersections on a part of the
/// reads, then on all. Corrects the cycle slips that the best one shows.
std::vector<Eigen::Vector2d> find_minima(Problem& problem, const std::vector<Guess>& ranked) {
  const FitData thin = thinned(problem.data, kThinReads);
  std::vector<Eigen::Vector2d> places = refined(thin, best_distinct(ranked, kStarts, kApart));
  for (int round = 0; round < kSlipRounds; ++round) {
    places = best_distinct(rank(problem.data, places), kStarts, kSame);
    if (places.empty()) return places;
    places = refined(problem.data, with_mirror_images(problem.data, places));
    places = best_distinct(rank(problem.data, places), kStarts, kSame);
    if (places.empty() || correct_slips(problem.data, places.front()) == 0) break;
  }
  return best_distinct(rank(problem.data, refined(problem.data, places)), kStarts, kSame);
}

/// Of the minima those that can't be told from the first.
std::vector<Eigen::Vector2d> indistinct(const FitData& data,
                                        const std::vector<Eigen::Vector2d>& minima) {
  const Eigen::ArrayXd best = residuals(data, minima.front());
  std::vector<Eigen::Vector2d> kept{minima.front()};
  for (std::size_t i = 1; i < minima.size(); ++i) {
    if (!tells_apart(data, best, residuals(data, minima[i]))) kept.push_back(minima[i]);
  }
  return kept;
}

/// The best intersection around each minimum, for those who want the method without its last step.
std::vector<Eigen::Vector2d> unrefined(const FitData& data, const std::vector<Guess>& ranked,
                                       const std::vector<Eigen::Vector2d>& minima) {
  std::vector<Eigen::Vector2d> places;
  const std::vector<Eigen::Vector2d> best = best_distinct(ranked, 60, 0.0);
  const std::vector<Guess> guesses = rank(data, best);
  for (const Eigen::Vector2d& minimum : minima) {
    const auto nearest = [&](const Guess& guess) {
      return std::none_of(minima.begin(), minima.end(), [&](const Eigen::Vector2d& other) {
        return (guess.p - other).norm() < (guess.p - minimum).norm();
      });
    };
    const auto found = std::find_if(guesses.begin(), guesses.end(), nearest);
    places.push_back(found == guesses.end() ? minimum : found->p);
  }
  return places;
}

Candidate candidate_at(const FitData& data, const Eigen::Vector2d& p, double height) {
  const auto reads = static_cast<double>(data.distance.size());
  return {
      {p.x(), p.y(), height}, std::sqrt(sum_of_squares(data, p) / reads), expected_error(data, p)};
}

}  // namespace

TagEstimate locate_by_hyperbolae(const std::string& tag, const SamplesOfTag& samples,
                                 double tag_height, const HyperbolaOptions& options,
                                 const EstimateLimits& limits) {
  check(options, tag_height);
  TagEstimate estimate;
  estimate.tag = tag;
  estimate.reads = count_reads(samples);
  const std::string hopeless = why_hopeless(samples);
  if (!hopeless.empty()) return not_located(std::move(estimate), hopeless);
  Problem problem = pose_problem(samples, tag_height, options.max_step);
  estimate.reads = static_cast<std::size_t>(problem.data.distance.size());
  const std::string why_too_few = too_few(problem);
  if (!why_too_few.empty()) return not_located(std::move(estimate), why_too_few);
  const auto conics = make_conics(problem.segments, options.stride_m, options.max_hyperbolae);
  const std::vector<Guess> ranked =
      rank(thinned(problem.data, kThinReads), intersect_all(conics, tag_height));
  std::vector<Eigen::Vector2d> places = find_minima(problem, ranked);
  if (places.empty()) return not_located(std::move(estimate), "no two hyperbolae meet");
  places = indistinct(problem.data, places);
  if (!options.refine) places = unrefined(problem.data, ranked, places);
  for (const Eigen::Vector2d& p : places) {
    estimate.candidates.push_back(candidate_at(problem.data, p, tag_height));
  }
  judge(limits, estimate);
  return estimate;
}

Method hyperbola_method(const HyperbolaOptions& options) {
  const auto locate = [options](const LocalizationProblem& problem, int threads, Diagnostics&) {
    LocalizationResult result;
    result.method = "hyperbola";
    result.estimates =
        locate_each(problem, threads, [&](const std::string& tag, const SamplesOfTag& samples) {
          return locate_by_hyperbolae(tag, samples, plane_height(problem, tag), options,
                                      problem.limits);
        });
    return result;
  };
  return {"hyperbola", "hyperbolae from unwrapped phase, their intersections (the paper's)",
          locate};
}

}  // namespace tagfield
