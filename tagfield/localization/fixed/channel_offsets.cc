// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/channel_offsets.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kFewestChannels = 3;
constexpr int kOffsetRounds = 20;

double wavenumber(double carrier_hz) { return 2.0 * kTwoPi / wavelength(carrier_hz); }

Complex unit(const Complex& value) {
  return std::abs(value) > 0.0 ? value / std::abs(value) : Complex(1.0, 0.0);
}

/// The phases of a tag at a known position, with its distance removed.
using ReducedOffsets = std::map<double, Complex>;

/// Per antenna, one entry for each reference tag.
std::map<std::string, std::vector<ReducedOffsets>> reduced_references(
    const LocalizationProblem& problem) {
  std::map<std::string, std::vector<ReducedOffsets>> all;
  for (const auto& [tag, p_WT] : problem.reference_tags) {
    const auto samples = problem.samples.find(tag);
    if (samples == problem.samples.end()) continue;
    for (const FixedReads& reads : fixed_reads(problem, samples->second)) {
      ReducedOffsets reduced;
      const double distance = (p_WT - reads.p_WA).norm();
      for (const auto& [carrier, phase] : reads.channels) {
        reduced[carrier] = unit(phase.mean) * std::polar(1.0, -wavenumber(carrier) * distance);
      }
      all[reads.antenna].push_back(std::move(reduced));
    }
  }
  return all;
}

/// A port's offsets: estimates the turns of the tags and of the channels alternately, starting from
/// the tag with the most channels.
std::map<double, ChannelTurn> offsets_by(std::vector<ReducedOffsets> references) {
  std::sort(references.begin(), references.end(),
            [](const ReducedOffsets& a, const ReducedOffsets& b) { return a.size() > b.size(); });
  std::map<double, ChannelTurn> offsets;
  for (const auto& [carrier, turn] : references.front()) offsets[carrier] = {turn, 1.0};
  for (int round = 0; round < kOffsetRounds; ++round) {
    std::map<double, Complex> sums;
    std::map<double, double> counts;
    for (const ReducedOffsets& reduced : references) {
      Complex own = 0.0;
      for (const auto& [carrier, turn] : reduced) {
        const auto found = offsets.find(carrier);
        if (found != offsets.end()) own += turn * std::conj(found->second.turn);
      }
      if (std::abs(own) == 0.0) continue;
      for (const auto& [carrier, turn] : reduced) {
        sums[carrier] += turn * std::conj(unit(own));
        counts[carrier] += 1.0;
      }
    }
    for (const auto& [carrier, sum] : sums) offsets[carrier] = {unit(sum), counts[carrier]};
  }
  return offsets;
}

/// Channels with known offsets, with the offsets removed.
struct Channels {
  Eigen::VectorXcd phases;
  Eigen::VectorXd wavenumbers, reads, references;
};

Channels channels_of(const FixedReads& reads, const std::map<double, ChannelTurn>& offsets) {
  Channels channels;
  const auto most = static_cast<Eigen::Index>(reads.channels.size());
  channels.phases.resize(most);
  channels.wavenumbers.resize(most);
  channels.reads.resize(most);
  channels.references.resize(most);
  Eigen::Index count = 0;
  for (const auto& [carrier, phase] : reads.channels) {
    const auto offset = offsets.find(carrier);
    if (offset == offsets.end()) continue;
    channels.phases[count] = unit(phase.mean) * std::conj(offset->second.turn);
    channels.wavenumbers[count] = wavenumber(carrier);
    channels.reads[count] = phase.reads;
    channels.references[count++] = offset->second.references;
  }
  channels.phases.conservativeResize(count);
  channels.wavenumbers.conservativeResize(count);
  channels.reads.conservativeResize(count);
  channels.references.conservativeResize(count);
  return channels;
}

/// Covariance of the phases with the distance removed: one wave of any phase, diffuse waves that
/// arrive later (exponentially distributed delays), and noise; plus the diffuse waves and noise of
/// the references.
Eigen::MatrixXcd covariance_of(const Channels& channels, const PhaseField& field) {
  const Eigen::Index n = channels.phases.size();
  const double direct = std::max(1.0 - field.diffuse - field.noise, 1e-3);
  const auto worse = [&](Eigen::Index i) {
    return channels.references[i] > 0.0 ? std::sqrt(1.0 + 1.0 / channels.references[i]) : 1.0;
  };
  Eigen::MatrixXcd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      // The round-trip wavenumber is 4πf/c, so a delay τ turns the phase by 2πΔf τ.
      const double turn =
          0.5 * kSpeedOfLight * (channels.wavenumbers[i] - channels.wavenumbers[j]) * field.delay_s;
      const Complex late = 1.0 / Complex(1.0, -turn);
      covariance(i, j) = direct + field.diffuse * late * worse(i) * worse(j);
    }
    covariance(i, i) += field.noise * worse(i) * worse(i) / channels.reads[i];
  }
  return covariance;
}

/// Consistency of two channels' phase difference over all tags, per antenna.
struct Agreement {
  double share = 0.0;
  double pairs = 0.0;
};

Agreement agreement_of(const std::vector<std::vector<FixedReads>>& tags, double one, double other) {
  std::map<std::string, Complex> sums;
  Agreement agreement;
  for (const auto& tag : tags) {
    for (const FixedReads& reads : tag) {
      const auto a = reads.channels.find(one);
      const auto b = reads.channels.find(other);
      if (a == reads.channels.end() || b == reads.channels.end()) continue;
      sums[reads.antenna] += unit(a->second.mean) * std::conj(unit(b->second.mean));
      agreement.pairs += 1.0;
    }
  }
  for (const auto& [antenna, sum] : sums) agreement.share += std::abs(sum);
  agreement.share /= std::max(agreement.pairs, 1.0);
  return agreement;
}

/// Expected excess agreement of the best of fifty pairs: 2.2 standard deviations.
double luck_of(const Agreement& agreement) {
  return 2.2 * (1.0 - agreement.share * agreement.share) / std::sqrt(2.0 * agreement.pairs);
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double spread_of(const std::vector<double>& values, double mean) {
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// The quadratic form of phases corrected for a distance is a sum of terms that turn with
/// differences of wavenumbers, of which a channel plan has few.
std::map<std::int64_t, Complex> form_by_difference(const Channels& channels,
                                                   const Eigen::MatrixXcd& inverse) {
  constexpr double kSameSlope = 1e-5;  // [rad/m]
  std::map<std::int64_t, Complex> form;
  for (Eigen::Index i = 0; i < inverse.rows(); ++i) {
    for (Eigen::Index j = 0; j < inverse.cols(); ++j) {
      const double difference = channels.wavenumbers[i] - channels.wavenumbers[j];
      form[std::llround(difference / kSameSlope)] +=
          std::conj(channels.phases[i]) * inverse(i, j) * channels.phases[j];
    }
  }
  return form;
}

}  // namespace

ChannelTurns channel_offsets(const LocalizationProblem& problem) {
  ChannelTurns offsets;
  if (!problem.has_phases) return offsets;
  for (auto& [antenna, references] : reduced_references(problem)) {
    offsets[antenna] = offsets_by(std::move(references));
  }
  for (const auto& [tag, samples] : problem.samples) {
    for (const auto& [antenna, series] : samples) {
      if (problem.offset_known.count(antenna) == 0) continue;
      for (const PhaseSample& sample : series) offsets[antenna][sample.frequency_hz] = {};
    }
  }
  return offsets;
}

bool is_out_of_order(const std::vector<std::vector<FixedReads>>& tags) {
  constexpr std::size_t kFewest = 10;    // Channels.
  constexpr double kFewestPairs = 10.0;  // Tags read on both channels.
  constexpr double kClearly = 3.0;       // Standard errors.
  std::set<double> carriers;
  for (const auto& tag : tags) {
    for (const FixedReads& reads : tag) {
      for (const auto& [carrier, phase] : reads.channels) carriers.insert(carrier);
    }
  }
  if (carriers.size() < kFewest) return false;
  std::vector<double> neighbours;
  std::vector<double> best;
  for (auto carrier = carriers.begin(); carrier != carriers.end(); ++carrier) {
    double most = 0.0;
    for (auto other = carriers.begin(); other != carriers.end(); ++other) {
      if (other == carrier) continue;
      const Agreement agreement = agreement_of(tags, *carrier, *other);
      if (agreement.pairs < kFewestPairs) continue;
      const bool is_next = std::next(carrier) == other;
      if (is_next) neighbours.push_back(agreement.share);
      if (!is_next) most = std::max(most, agreement.share - luck_of(agreement));
    }
    best.push_back(most);
  }
  if (neighbours.size() < kFewest) return false;
  const double mean = mean_of(neighbours);
  const double error =
      spread_of(neighbours, mean) / std::sqrt(static_cast<double>(neighbours.size()));
  return mean + kClearly * error < mean_of(best);
}

RangeLikelihood range_likelihood(const FixedReads& reads, const ChannelTurns& offsets,
                                 const PhaseField& field, double max_m, double step_m) {
  const auto of_antenna = offsets.find(reads.antenna);
  if (of_antenna == offsets.end()) return {};
  const Channels channels = channels_of(reads, of_antenna->second);
  if (static_cast<std::size_t>(channels.phases.size()) < kFewestChannels) return {};
  const Eigen::MatrixXcd covariance = covariance_of(channels, field);
  const Eigen::LLT<Eigen::MatrixXcd> root(covariance);
  const Eigen::MatrixXcd inverse =
      root.solve(Eigen::MatrixXcd::Identity(covariance.rows(), covariance.cols()));
  const double log_det = 2.0 * root.matrixLLT().diagonal().real().array().log().sum();
  const auto form = form_by_difference(channels, inverse);
  RangeLikelihood likelihood{0.0, step_m, {}};
  likelihood.log.resize(static_cast<Eigen::Index>(max_m / step_m) + 2);
  for (Eigen::Index k = 0; k < likelihood.log.size(); ++k) {
    const double distance = static_cast<double>(k) * step_m;
    double square = 0.0;
    for (const auto& [difference, term] : form) {
      square += (term * std::polar(1.0, 1e-5 * static_cast<double>(difference) * distance)).real();
    }
    likelihood.log[k] = -0.5 * (square + log_det);
  }
  return likelihood;
}

double most_likely(const RangeLikelihood& of, double distance_m, double reach_m) {
  const auto last = of.log.size() - 1;
  const auto at = [&](double distance) {
    const double place = (distance - of.first_m) / of.step_m;
    return std::clamp<Eigen::Index>(std::lround(place), 0, last);
  };
  const Eigen::Index begin = at(distance_m - reach_m);
  return of.log.segment(begin, at(distance_m + reach_m) - begin + 1).maxCoeff();
}

}  // namespace tagfield
