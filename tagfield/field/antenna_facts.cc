// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/antenna_facts.h"

#include "tagfield/reader/radio_model.h"

namespace tagfield {

bool meets_world(const AntennaParameters& antenna) { return physical(antenna) != nullptr; }

double nominal_range_m(const AntennaParameters& antenna) {
  const RadioModel* const radio = physical(antenna);
  return radio == nullptr ? paper(antenna).range_m : max_range_m(*radio, *default_tag_model());
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
  // A wire's field is linear, whatever else is set.
  if (radio->antenna.shape == PatternShape::kDipole) return PolarizationKind::kLinear;
  return radio->antenna.polarization;
}

}  // namespace tagfield
