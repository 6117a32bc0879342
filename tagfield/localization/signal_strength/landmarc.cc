// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/landmarc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "tagfield/base/random.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/signal_strength/rssi_samples.h"

namespace tagfield {
namespace {

/// Smaller distances in signal space are clamped to this [dB], to keep weights finite.
constexpr double kMinDistance = 0.01;

struct Reference {
  Eigen::Vector3d p_WT;
  RssiVector rssi;
};

struct References {
  std::vector<Reference> tags;
  double unread_dbm = 0.0;  ///< Substitute for the RSSI of a tag that was not read.
  bool go_by_place = false;
};

References references_of(const LocalizationProblem& problem, const LandmarcOptions& options) {
  References references;
  double weakest = 0.0;
  for (const auto& [tag, samples] : problem.samples) {
    RssiVector rssi = rssi_over_time(samples, options.bin_s);
    for (const auto& [bin, value] : rssi) weakest = std::min(weakest, value);
    const auto place = problem.reference_tags.find(tag);
    if (place == problem.reference_tags.end() || rssi.empty()) continue;
    references.tags.push_back({place->second, std::move(rssi)});
  }
  references.unread_dbm = weakest - options.unread_margin_db;
  return references;
}

double value_at(const RssiVector& rssi, const RssiVector::key_type& bin, double otherwise) {
  const auto found = rssi.find(bin);
  return found == rssi.end() ? otherwise : found->second;
}

/// E: root mean square difference over the bins in which either tag was read [dB].
double signal_distance(const RssiVector& a, const RssiVector& b, double unread_dbm) {
  std::set<RssiVector::key_type> bins;
  for (const auto& [bin, value] : a) bins.insert(bin);
  for (const auto& [bin, value] : b) bins.insert(bin);
  double sum = 0.0;
  for (const auto& bin : bins) {
    sum += std::pow(value_at(a, bin, unread_dbm) - value_at(b, bin, unread_dbm), 2);
  }
  return std::sqrt(sum / static_cast<double>(bins.size()));
}

struct Neighbour {
  const Reference* reference = nullptr;
  double distance_db = 0.0;
};

std::vector<Neighbour> nearest(const References& references, const RssiVector& rssi,
                               std::size_t count) {
  std::vector<Neighbour> neighbours;
  for (const Reference& reference : references.tags) {
    neighbours.push_back(
        {&reference, signal_distance(rssi, reference.rssi, references.unread_dbm)});
  }
  std::stable_sort(neighbours.begin(), neighbours.end(),
                   [](const auto& a, const auto& b) { return a.distance_db < b.distance_db; });
  neighbours.resize(std::min(count, neighbours.size()));
  return neighbours;
}

/// Sum over all pairs of tags of their distance times the difference of their RSSI; `order`
/// permutes their positions, of which all else in the correlation of the two is independent.
double likeness(const References& references, const std::vector<std::vector<double>>& signal_db,
                const std::vector<std::size_t>& order) {
  double sum = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const double apart = (references.tags[order[i]].p_WT - references.tags[order[j]].p_WT).norm();
      sum += apart * signal_db[i][j];
    }
  }
  return sum;
}

/// Whether tags close to each other have similar RSSI, by Mantel's test (Cancer Research 27, 1967):
/// at most 1 % of random permutations of their positions correlate as well as the true order.
bool go_by_place(const References& references) {
  constexpr int kOrders = 1000;
  const std::size_t count = references.tags.size();
  std::vector<std::vector<double>> signal_db(count, std::vector<double>(count));
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    order[i] = i;
    for (std::size_t j = 0; j < count; ++j) {
      signal_db[i][j] =
          signal_distance(references.tags[i].rssi, references.tags[j].rssi, references.unread_dbm);
    }
  }
  const double as_given = likeness(references, signal_db, order);
  RandomStream stream(1, Purpose::kTagSearch, count);
  int as_good = 0;
  for (int k = 0; k < kOrders; ++k) {
    for (std::size_t left = count; left > 1; --left) {
      std::swap(order[left - 1], order[static_cast<std::size_t>(stream() % left)]);
    }
    if (likeness(references, signal_db, order) >= as_given) ++as_good;
  }
  return 100 * as_good <= kOrders;
}

/// Mean of the neighbours' positions with weights 1/E², and their weighted scatter as covariance.
Candidate between(const std::vector<Neighbour>& neighbours) {
  double sum = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  std::vector<double> weights;
  for (const Neighbour& neighbour : neighbours) {
    weights.push_back(1.0 / std::pow(std::max(neighbour.distance_db, kMinDistance), 2));
    sum += weights.back();
    mean += weights.back() * neighbour.reference->p_WT;
  }
  mean /= sum;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const Eigen::Vector3d apart = neighbours[i].reference->p_WT - mean;
    scatter += weights[i] / sum * apart * apart.transpose();
  }
  Candidate candidate;
  candidate.p_WT = mean;
  candidate.expected_error_m = std::sqrt(scatter(0, 0) + scatter(1, 1));
  candidate.covariance = scatter;
  return candidate;
}

/// A known height is kept, not estimated.
void keep_height(const LocalizationProblem& problem, const std::string& tag, Candidate& candidate) {
  const bool known = problem.heights.of_all || problem.heights.of_tag.count(tag) > 0;
  if (!known) return;
  candidate.p_WT.z() = plane_height(problem, tag);
  candidate.covariance->row(2).setZero();
  candidate.covariance->col(2).setZero();
}

TagEstimate locate_by_neighbours(const LocalizationProblem& problem, const References& references,
                                 const std::string& tag, const SamplesOfTag& samples,
                                 const LandmarcOptions& options) {
  TagEstimate estimate = begun(tag, samples);
  if (references.tags.size() < kFewestReferenceTags) {
    return not_located(std::move(estimate),
                       fmt::format("needs reference tags: {} were read with RSSI, at least {} are "
                                   "needed",
                                   references.tags.size(), kFewestReferenceTags));
  }
  if (!references.go_by_place) {
    return not_located(std::move(estimate),
                       fmt::format("RSSI of the {} reference tags does not depend on their "
                                   "positions",
                                   references.tags.size()));
  }
  if (estimate.reads == 0)
    return not_located(std::move(estimate), "no reads that have an antenna pose");
  const RssiVector rssi = rssi_over_time(samples, options.bin_s);
  if (rssi.empty()) return not_located(std::move(estimate), "no read has an RSSI");
  const std::vector<Neighbour> neighbours = nearest(references, rssi, options.neighbours);
  Candidate candidate = between(neighbours);
  keep_height(problem, tag, candidate);
  estimate.candidates = {candidate};
  EstimateLimits limits;
  limits.max_expected_error_m = options.max_expected_error_m;
  judge(limits, estimate);
  return estimate;
}

std::vector<TagEstimate> locate_by_references(const LocalizationProblem& problem, int threads,
                                              const LandmarcOptions& options) {
  References references = references_of(problem, options);
  references.go_by_place = go_by_place(references);
  return locate_each(problem, threads, [&](const std::string& tag, const SamplesOfTag& samples) {
    return locate_by_neighbours(problem, references, tag, samples, options);
  });
}

/// Keys of the options.
const OptionTable<LandmarcOptions>& landmarc_options() {
  using O = LandmarcOptions;
  static const OptionTable<O> of{
      {setting<O>("neighbours", "", "nearest reference tags whose mean is taken", &O::neighbours,
                  kAtLeastOne),
       setting<O>("bin_s", "s", "RSSI is averaged over this time", &O::bin_s, kOverZero),
       setting<O>("unread_margin_db", "dB", "by which a missing read is below the weakest of all",
                  &O::unread_margin_db, kAtLeastZero),
       setting<O>("rssi_max_error_m", "m",
                  "with a larger expected error a tag is not given as located",
                  &O::max_expected_error_m, kOverZero)}};
  return of;
}

}  // namespace

Method landmarc_method(const LandmarcOptions& options) {
  return ignoring({"offset", "pi_ambiguity", "pose_error", "max_expected_error_m", "max_rms_m"},
                  method_with("landmarc", "the nearest reference tags by RSSI, their mean",
                              landmarc_options(), options, locate_by_references));
}

}  // namespace tagfield
