// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/scan/scan_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "tagfield/base/units.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// A path is straight if it deviates from its line by less than this fraction of a wavelength.
constexpr double kStraight = 1.0 / 8.0;
constexpr double kPlace = 1.0 / 20.0;  ///< Reads this close together share a position [λ].
constexpr double kGap = 1.0 / 4.0;     ///< Phases are not unwrapped across longer gaps [λ].
constexpr double kShortest = 1.0;      ///< Shorter scans give directions at best [λ].

ScanLine line_of(const std::vector<PhaseSample>& series) {
  ScanLine line;
  for (const PhaseSample& sample : series) {
    line.middle += sample.p_WA.head<2>() / static_cast<double>(series.size());
  }
  const auto furthest = [&](const Eigen::Vector2d& from) -> Eigen::Vector2d {
    return std::max_element(series.begin(), series.end(),
                            [&](const PhaseSample& a, const PhaseSample& b) {
                              return (a.p_WA.head<2>() - from).norm() <
                                     (b.p_WA.head<2>() - from).norm();
                            })
        ->p_WA.head<2>();
  };
  const Eigen::Vector2d begin = series.front().p_WA.head<2>();
  const Eigen::Vector2d end = furthest(begin);
  if ((end - begin).norm() > 0.0) line.along = (end - begin).normalized();
  line.middle = begin + line.along * line.along.dot(line.middle - begin);
  return line;
}

/// Maximum deviation of the path from the line and from its height [m].
double straying(const ScanLine& line, const std::vector<PhaseSample>& series) {
  double most = 0.0;
  for (const PhaseSample& sample : series) {
    most = std::max(most, std::abs(line.left().dot(sample.p_WA.head<2>() - line.middle)));
    most = std::max(most, std::abs(sample.p_WA.z() - series.front().p_WA.z()));
  }
  return most;
}

/// Sum of the reads of one channel at one position.
struct Cell {
  std::complex<double> waves = 0.0;
  double decibels = 0.0;
  double along_m = 0.0;
  double reads = 0.0;
};

using ScanChannel = std::map<int, Cell>;  ///< By position.

std::map<double, ScanChannel> channels_of(const ScanLine& line, double cell_m,
                                          const std::vector<PhaseSample>& series) {
  std::map<double, ScanChannel> channels;
  for (const PhaseSample& sample : series) {
    const double along = line.along.dot(sample.p_WA.head<2>() - line.middle);
    const int place = static_cast<int>(std::lround(along / cell_m));
    Cell& cell = channels[sample.frequency_hz][place];
    cell.waves += std::polar(1.0, sample.phase_rad);
    cell.decibels += sample.rssi_dbm;
    cell.along_m += along;
    cell.reads += 1.0;
  }
  for (auto& [carrier, places] : channels) {
    for (auto& [place, cell] : places) {
      cell.waves /= std::max(std::abs(cell.waves), 1e-12);
      cell.decibels /= cell.reads;
      cell.along_m /= cell.reads;
    }
  }
  return channels;
}

/// Combines all channels, each rotated to agree best with the others.
ScanChannel in_agreement(const std::map<double, ScanChannel>& channels) {
  constexpr int kRounds = 4;
  const auto longest = std::max_element(
      channels.begin(), channels.end(),
      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  ScanChannel together = longest->second;
  for (int round = 0; round < kRounds; ++round) {
    ScanChannel sum;
    for (const auto& [carrier, places] : channels) {
      std::complex<double> turn = 0.0;
      for (const auto& [place, cell] : places) {
        const auto other = together.find(place);
        if (other != together.end()) turn += cell.waves * std::conj(other->second.waves);
      }
      if (std::abs(turn) < 1e-9) continue;
      const std::complex<double> back = std::conj(turn) / std::abs(turn);
      for (const auto& [place, cell] : places) {
        Cell& all = sum[place];
        all.waves += back * cell.waves;
        all.decibels += cell.decibels;
        all.along_m += cell.along_m;
        all.reads += 1.0;
      }
    }
    together = std::move(sum);
  }
  for (auto& [place, cell] : together) {
    cell.decibels /= cell.reads;
    cell.along_m /= cell.reads;
  }
  return together;
}

/// The section without a gap that has the most positions.
std::vector<Cell> longest_segment(const ScanChannel& places, double gap_m) {
  std::vector<Cell> longest;
  std::vector<Cell> segment;
  for (const auto& [place, cell] : places) {
    if (!segment.empty() && cell.along_m - segment.back().along_m > gap_m) segment.clear();
    segment.push_back(cell);
    if (segment.size() > longest.size()) longest = segment;
  }
  return longest;
}

/// Independent samples of a diffuse field: n² over the sum of its squared correlations,
/// sin(kd)/(kd), over all pairs of positions.
double independent_samples(const ScanField& scan) {
  double sum = 0.0;
  for (const double a : scan.along_m) {
    for (const double b : scan.along_m) {
      const double x = scan.wavenumber * std::abs(a - b);
      const double correlation = x > 1e-6 ? std::sin(x) / x : 1.0;
      sum += correlation * correlation;
    }
  }
  const auto count = static_cast<double>(scan.along_m.size());
  return count * count / sum;
}

void fill(const std::vector<Cell>& cells, bool doubled, ScanField& scan) {
  const auto count = static_cast<Eigen::Index>(cells.size());
  scan.along_m.resize(count);
  scan.field.resize(count);
  const double ways = doubled ? 4.0 : 2.0;
  double phase = std::arg(cells.front().waves);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Cell& cell = cells[static_cast<std::size_t>(i)];
    phase += wrap_to_pi(std::arg(cell.waves) - phase);
    scan.along_m[i] = cell.along_m;
    // Without RSSI, all positions count equally.
    const double amplitude =
        cell.decibels > kNoRssi + 1.0 ? std::pow(10.0, cell.decibels / 40.0) : 1.0;
    scan.field[i] = std::polar(amplitude, phase / ways);
  }
  scan.field /= std::sqrt(scan.field.abs2().sum());
  scan.begin_m = scan.along_m[0];
  scan.end_m = scan.along_m[count - 1];
  scan.samples = independent_samples(scan);
}

double mean_carrier(const std::vector<PhaseSample>& series) {
  double low = series.front().frequency_hz;
  double high = low;
  for (const PhaseSample& sample : series) {
    low = std::min(low, sample.frequency_hz);
    high = std::max(high, sample.frequency_hz);
  }
  return 0.5 * (low + high);
}

const std::vector<PhaseSample>* longest_series(const SamplesOfTag& samples) {
  const std::vector<PhaseSample>* longest = nullptr;
  for (const auto& [antenna, series] : samples) {
    if (extent_of(series) < kStillExtent) continue;
    if (longest == nullptr || series.size() > longest->size()) longest = &series;
  }
  return longest;
}

}  // namespace

ScanField scan_field(const LocalizationProblem& problem, const std::string& tag,
                     const SamplesOfTag& samples) {
  ScanField scan;
  scan.why_not = why_not_locatable(samples);
  if (!scan.why_not.empty()) return scan;
  const std::vector<PhaseSample>& series = *longest_series(samples);
  const double carrier = mean_carrier(series);
  const double lambda = wavelength(carrier) * problem.multiple();
  scan.line = line_of(series);
  scan.wavenumber = kTwoPi / lambda;
  scan.up_m = plane_height(problem, tag) - series.front().p_WA.z();
  if (extent_of(series) > kLongestScan) {
    scan.why_not = fmt::format("the scan is {:.1f} m long, at most {:.1f} m are processed as one",
                               extent_of(series), kLongestScan);
    return scan;
  }
  const double strays = straying(scan.line, series);
  if (strays > kStraight * lambda) {
    scan.why_not = fmt::format("the antenna's path is not straight: it strays by {:.2f} m", strays);
    return scan;
  }
  const ScanChannel together = in_agreement(channels_of(scan.line, kPlace * lambda, series));
  const std::vector<Cell> cells = longest_segment(together, kGap * lambda);
  if (cells.size() < kFewestReads ||
      cells.back().along_m - cells.front().along_m < kShortest * lambda) {
    scan.why_not = "the phase could not be followed over a wavelength of the antenna's path";
    return scan;
  }
  fill(cells, problem.pi_ambiguity, scan);
  return scan;
}

}  // namespace tagfield
