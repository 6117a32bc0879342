// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/internal/phase_field.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/fixed/strength_density.h"

namespace tagfield {
namespace {

constexpr double kRangeStep = 0.02;           ///< [m]
constexpr std::size_t kInformativeTags = 12;  ///< Used to estimate the phase field.

/// The first few tags at unknown positions.
std::vector<std::size_t> informative_tags(const FixedScene& scene,
                                          const LocalizationProblem& problem) {
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < scene.tags.size() && some.size() < kInformativeTags; ++i) {
    const bool is_known = problem.reference_tags.count(*scene.tags[i].name) > 0;
    if (scene.tags[i].why_not.empty() && !is_known) some.push_back(i);
  }
  return some;
}

/// Log-likelihood of a field given the phases of some tags at the positions that RSSI suggests.
double log_of_field(const FixedScene& scene, const std::vector<std::size_t>& some,
                    const std::vector<Eigen::ArrayXd>& weights, const PhaseField& field) {
  double log = 0.0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const FixedTag& tag = scene.tags[some[i]];
    for (const FixedReads& reads : tag.reads) {
      double most = 0.0;
      for (const auto& cell : tag.grid.places.cells)
        most = std::max(most, (cell - reads.p_WA).norm());
      const RangeLikelihood of = range_likelihood(reads, scene.offsets, field, most, kRangeStep);
      if (of.log.size() == 0) continue;
      const double best = of.log.maxCoeff();
      double sum = 0.0;
      for (std::size_t j = 0; j < tag.grid.places.cells.size(); ++j) {
        const double r = (tag.grid.places.cells[j] - reads.p_WA).norm();
        sum += weights[i][static_cast<Eigen::Index>(j)] * std::exp(most_likely(of, r, 0.0) - best);
      }
      log += best + std::log(sum + 1e-300);
    }
  }
  return log;
}

/// Range likelihoods per antenna, relative to their mean over the area's distances.
std::vector<RangeLikelihood> ranges_of(const FixedScene& scene, const FixedTag& tag, double trust) {
  std::vector<RangeLikelihood> ranges;
  for (const FixedReads& reads : tag.reads) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const auto& cell : tag.grid.places.cells) {
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

}  // namespace

PhaseField likeliest_field(const FixedScene& scene, const LocalizationProblem& problem,
                           const FixedOptions& options, int threads) {
  const std::vector<std::size_t> some = informative_tags(scene, problem);
  std::vector<Eigen::ArrayXd> weights;
  for (const std::size_t i : some) {
    const TagOnGrid& grid = scene.tags[i].grid;
    const Eigen::ArrayXd logs = log_strength(grid, scene.law.of_tag[i], options) +
                                log_prior(grid.places, scene.law.areas_of_tag[i]);
    weights.push_back((logs - logs.maxCoeff()).exp());
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

LogDensity density_of(const FixedScene& scene, std::size_t number, double trust,
                      const FixedOptions& options) {
  const FixedTag& tag = scene.tags[number];
  const StrengthLaw& law = scene.law.of_tag[number];
  const Eigen::ArrayXd& areas = scene.law.areas_of_tag[number];
  return [&scene, &tag, &law, &areas, &options, ranges = ranges_of(scene, tag, trust)](
             const std::vector<Eigen::Vector3d>& places, double reach_m) {
    const auto count = static_cast<Eigen::Index>(places.size());
    PossiblePlaces cells{places, Eigen::ArrayXd::Ones(count),
                         densities_in(scene.areas, tag.areas_m2, places)};
    Eigen::ArrayXd logs = log_prior(cells, areas);       // Per square metre.
    cells.size_m.setConstant(std::sqrt(2.0) * reach_m);  // With corners in reach.
    const TagOnGrid there = on_grid(scene.antennas, tag.reads, std::move(cells), options);
    logs += reach_m > 0.0 ? cell_strengths(there, law, options).bound
                          : log_strength(there, law, options);
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

double trust_of(const FixedScene& scene, const LocalizationProblem& problem,
                const FixedOptions& options, int threads) {
  constexpr double kTrusts[] = {1.0, 0.5, 0.25, 0.12, 0.06, 0.03, 0.015, 0.0};
  const std::vector<std::size_t> some = informative_tags(scene, problem);
  std::vector<double> sums(std::size(kTrusts));
  parallel_for(sums.size(), threads, [&](std::size_t k) {
    for (const std::size_t i : some) {
      const FixedTag& tag = scene.tags[i];
      sums[k] += log_integral({tag.grid.places.cells, tag.cell_m},
                              density_of(scene, i, kTrusts[k], options));
    }
  });
  return kTrusts[std::max_element(sums.begin(), sums.end()) - sums.begin()];
}

}  // namespace tagfield
