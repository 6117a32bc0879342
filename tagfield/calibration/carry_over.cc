// SPDX-License-Identifier: Apache-2.0
#include "tagfield/calibration/carry_over.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tagfield/base/units.h"
#include "tagfield/fit/circular_mean.h"

namespace tagfield {
namespace {

constexpr double kClearly = 2.0;     ///< Standard errors by which a mean must differ from 0.
constexpr double kAgree_rad = 0.25;  ///< Largest rms scatter of a channel's offsets that agree.

using OfAntenna = std::vector<const AntennaCalibration*>;

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double rms_about(const std::vector<double>& values, double middle, double freedom) {
  double squares = 0.0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / freedom);
}

/// Rms error of predicting each value by the mean of the others: n/(n − 1) times its deviation from
/// the mean of all.
double missed_by_others(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  return n / (n - 1.0) * rms_about(values, mean_of(values), n);
}

/// A parameter taken from each experiment. `unit` is a thousandth of its unit [m or s].
struct Figure {
  const char* name;
  const char* unit;
  std::function<const CalibratedValue&(const AntennaCalibration&)> of;
  std::function<CalibratedValue&(AntennaCalibration&)> in;
};

CalibratedValue carried(const std::string& antenna, const Figure& figure, const OfAntenna& all,
                        Diagnostics& diagnostics) {
  std::vector<double> values;
  double own = 0.0;
  for (const AntennaCalibration* one : all) {
    if (!figure.of(*one).observable) return {0.0, figure.of(*one).sigma, false};
    values.push_back(figure.of(*one).value);
    own += figure.of(*one).sigma * figure.of(*one).sigma / static_cast<double>(all.size());
  }
  const auto n = static_cast<double>(values.size());
  const double mean = mean_of(values);
  const double scatter = rms_about(values, mean, n - 1.0);
  const double left = rms_about(values, 0.0, n);
  const bool helps = missed_by_others(values) < 0.5 * left &&
                     std::abs(mean) > kClearly * std::max(scatter, std::sqrt(own)) / std::sqrt(n);
  if (helps) return {mean, std::sqrt(std::max(scatter * scatter, own) * (1.0 + 1.0 / n)), true};
  if (left > kClearly * std::sqrt(own)) {
    diagnostics.warn(fmt::format(
        "antenna '{}': {} does not carry over: it differs by {:.1f} {} from experiment to "
        "experiment, while each by itself determines it to {:.1f} {}; left as it was",
        antenna, figure.name, 1e3 * scatter, figure.unit, 1e3 * std::sqrt(own), figure.unit));
  }
  return {0.0, left, false};
}

std::vector<Figure> figures() {
  std::vector<Figure> all;
  constexpr const char* kNames[] = {"position x", "position y", "position z"};
  all.reserve(std::size(kNames));
  for (int i = 0; i < 3; ++i) {
    all.push_back(
        {kNames[i], "mm",
         [i](const AntennaCalibration& a) -> const CalibratedValue& { return a.phase_centre_m[i]; },
         [i](AntennaCalibration& a) -> CalibratedValue& { return a.phase_centre_m[i]; }});
  }
  all.push_back(
      {"latency", "ms",
       [](const AntennaCalibration& a) -> const CalibratedValue& { return a.time_offset_s; },
       [](AntennaCalibration& a) -> CalibratedValue& { return a.time_offset_s; }});
  return all;
}

/// Offsets of the channels on which all experiments have one and agree.
std::vector<ChannelOffset> carried_offsets(const OfAntenna& all) {
  std::vector<ChannelOffset> carried;
  for (const ChannelOffset& first : all.front()->offsets) {
    CircularMean mean;
    std::vector<double> values;
    ChannelOffset offset = first;
    offset.reads = 0;
    for (const AntennaCalibration* one : all) {
      for (const ChannelOffset& of : one->offsets) {
        if (of.frequency_hz != first.frequency_hz) continue;
        mean.add(of.value_rad);
        values.push_back(of.value_rad);
        offset.reads += of.reads;
      }
    }
    double squares = 0.0;
    for (const double value : values) squares += std::pow(wrap_to_pi(value - mean.value()), 2);
    offset.value_rad = wrap_to_two_pi(mean.value());
    offset.sigma_rad =
        std::max(first.sigma_rad, std::sqrt(squares / static_cast<double>(values.size())));
    if (values.size() == all.size() && offset.sigma_rad < kAgree_rad) carried.push_back(offset);
  }
  return carried;
}

double median_noise(const OfAntenna& all) {
  std::vector<double> noises;
  for (const AntennaCalibration* one : all) noises.push_back(one->noise_rad);
  std::sort(noises.begin(), noises.end());
  return noises[noises.size() / 2];
}

bool tells_anything(const AntennaCalibration& antenna) {
  return antenna.phase_sign < 0 || !antenna.offsets.empty() || antenna.time_offset_s.observable ||
         std::any_of(std::begin(antenna.phase_centre_m), std::end(antenna.phase_centre_m),
                     [](const CalibratedValue& value) { return value.observable; });
}

AntennaCalibration antenna_of(const std::string& name, const OfAntenna& all,
                              Diagnostics& diagnostics) {
  AntennaCalibration antenna;
  antenna.phase_sign = all.front()->phase_sign;
  antenna.noise_rad = median_noise(all);
  for (const AntennaCalibration* one : all) {
    antenna.reads += one->reads;
    antenna.tag_scatter_rad = std::max(antenna.tag_scatter_rad, one->tag_scatter_rad);
  }
  for (const Figure& figure : figures()) {
    figure.in(antenna) = carried(name, figure, all, diagnostics);
  }
  antenna.offsets = carried_offsets(all);
  if (antenna.offsets.empty()) {
    diagnostics.warn(fmt::format("antenna '{}': no offset carries over", name));
  }
  return antenna;
}

}  // namespace

Calibration carried_over(const std::vector<Calibration>& experiments, Diagnostics& diagnostics) {
  if (experiments.size() < 3) {
    throw Error("at least three experiments are needed to see whether a calibration carries over");
  }
  Calibration result;
  result.pi_ambiguity = std::any_of(experiments.begin(), experiments.end(),
                                    [](const Calibration& one) { return one.pi_ambiguity; });
  for (const auto& [name, first] : experiments.front().antennas) {
    OfAntenna all;
    for (const Calibration& one : experiments) {
      const auto found = one.antennas.find(name);
      const bool is_alike =
          found != one.antennas.end() && found->second.phase_sign == first.phase_sign;
      if (is_alike) all.push_back(&found->second);
    }
    if (all.size() < experiments.size()) {
      diagnostics.warn(fmt::format(
          "antenna '{}' is left out: {} of {} experiments calibrated it with the same sign", name,
          all.size(), experiments.size()));
      continue;
    }
    AntennaCalibration antenna = antenna_of(name, all, diagnostics);
    if (tells_anything(antenna)) result.antennas[name] = std::move(antenna);
  }
  return result;
}

}  // namespace tagfield
