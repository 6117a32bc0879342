// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/antenna_facts.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

bool is_circular(const AntennaPattern& pattern) {
  // A wire's field is linear, whatever else is set.
  return pattern.shape != PatternShape::kDipole &&
         pattern.polarization != PolarizationKind::kLinear;
}

/// The largest product of the gain in a direction and the share of its power that a linearly
/// polarized antenna can receive there. It is mostly, but not always, half of the peak gain: aside
/// of the boresight the waves of crossed wires are elliptical.
double peak_gain_for_linear(const AntennaPattern& circular) {
  constexpr int kSteps = 36;
  double peak = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double off = kPi * i / kSteps;
    for (int k = 0; k < 2 * kSteps; ++k) {
      const double about = kPi * k / kSteps;
      const Eigen::Vector3d u_A(std::cos(off), std::sin(off) * std::cos(about),
                                std::sin(off) * std::sin(about));
      const Eigen::Vector3cd e = field_direction(circular, u_A);
      const double share = 0.5 * (1.0 + std::abs(e.cwiseProduct(e).sum()));
      peak = std::max(peak, gain(circular, u_A) * share);
    }
  }
  return peak;
}

/// Loss [dB] between antennas turned as they match best: 0, or about 3 between a circular and a
/// linear one.
double polarization_loss_db(const AntennaPattern& a, const AntennaPattern& b) {
  if (is_circular(a) == is_circular(b)) return 0.0;
  const AntennaPattern& circular = is_circular(a) ? a : b;
  return to_db(peak_gain(circular) / peak_gain_for_linear(circular));
}

double range_for_kind(const RadioModel& radio, const TagModel& kind) {
  if (!radio.effects.polarization || !radio.effects.patterns)
    return free_space_range_m(radio, kind);
  TagModel mismatched = kind;
  mismatched.detuning_db += polarization_loss_db(radio.antenna, kind.antenna);
  return free_space_range_m(radio, mismatched);
}

}  // namespace

bool meets_world(const AntennaParameters& antenna) { return physical(antenna) != nullptr; }

double nominal_range_m(const AntennaParameters& antenna,
                       const std::vector<std::shared_ptr<const TagModel>>& kinds) {
  const RadioModel* const radio = physical(antenna);
  if (radio == nullptr) return paper(antenna).range_m;
  if (kinds.empty()) return range_for_kind(*radio, *default_tag_model());
  double longest_m = 0.0;
  for (const auto& kind : kinds) longest_m = std::max(longest_m, range_for_kind(*radio, *kind));
  return longest_m;
}

double largest_range_m(const AntennaParameters& antenna,
                       const std::vector<std::shared_ptr<const TagModel>>& kinds) {
  const RadioModel* const radio = physical(antenna);
  return nominal_range_m(antenna, kinds) * (radio == nullptr ? 1.0 : max_field_factor(*radio));
}

double nominal_frequency_hz(const AntennaParameters& antenna) {
  const RadioModel* const radio = physical(antenna);
  return radio == nullptr ? paper(antenna).model.frequency_hz : radio->plan.carriers_hz.front();
}

std::optional<StatedPhase> stated_phase(const AntennaParameters& antenna) {
  if (physical(antenna) != nullptr) return std::nullopt;
  const PaperModel& model = paper(antenna).model;
  return StatedPhase{model.phase_offset_rad, model.phase_noise_rad};
}

std::optional<double> transmit_power_dbm(const AntennaParameters& antenna) {
  const RadioModel* const radio = physical(antenna);
  if (radio == nullptr) return std::nullopt;
  return radio->transmit_power_dbm;
}

std::optional<PolarizationKind> polarization_of(const AntennaParameters& antenna) {
  const RadioModel* const radio = physical(antenna);
  if (radio == nullptr || !radio->effects.polarization || radio->X_AR) return std::nullopt;
  return is_circular(radio->antenna) ? radio->antenna.polarization : PolarizationKind::kLinear;
}

}  // namespace tagfield
