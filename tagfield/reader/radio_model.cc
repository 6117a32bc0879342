// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/radio_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tagfield/base/range_check.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

double peak_dbi(const AntennaPattern& pattern) { return to_db(peak_gain(pattern)); }

void warn_of_conducted_power(const RadioModel& model, Diagnostics& diagnostics) {
  const std::optional<double> max_dbm = max_conducted_dbm(model.plan);
  const double conducted_dbm = model.transmit_power_dbm - model.cable_loss_db;
  if (!max_dbm || conducted_dbm <= *max_dbm + 0.05) return;
  diagnostics.warn(
      fmt::format("{:.1f} dBm into the antenna is more than the {:.1f} dBm that the channel plan "
                  "'{}' allows with {} carriers",
                  conducted_dbm, *max_dbm, model.plan.name, model.plan.carriers_hz.size()));
}

void warn_of_power(const RadioModel& model, Diagnostics& diagnostics) {
  warn_of_conducted_power(model, diagnostics);
  if (!(model.plan.max_erp_dbm > 0.0)) return;
  const double eirp_dbm = model.transmit_power_dbm - model.cable_loss_db + peak_dbi(model.antenna);
  const double max_dbm = model.plan.max_erp_dbm + kDipole_dbi;
  if (eirp_dbm <= max_dbm + 0.05) return;
  diagnostics.warn(
      fmt::format("{:.1f} dBm EIRP is more than the {:.1f} dBm that the channel plan "
                  "'{}' allows",
                  eirp_dbm, max_dbm, model.plan.name));
}

}  // namespace

RadioEffects no_effects() {
  RadioEffects effects;
  for (const EffectSwitch& effect : kEffectSwitches) effects.*effect.on = false;
  return effects;
}

LinkSettings reply_link_of(const RadioModel& model) {
  return model.gen2 ? model.gen2->link : LinkSettings{};
}

TransmitSpectrum transmit_spectrum_of(const RadioModel& model) {
  constexpr double kDenseTari = 2.5;
  const double dense_hz = kDenseTari / reply_link_of(model).tari_s;
  const bool is_dense = model.spectrum_mask == SpectrumMask::kDense;
  return {model.spectrum_mask, is_dense ? dense_hz : model.plan.channel_hz};
}

void check(const RadioModel& model, Diagnostics& diagnostics) {
  check(model.antenna, diagnostics);
  check(model.hardware);
  check(model.plan);
  require_in_range("reflection_order", model.reflection_order, 0, kMaxBounces);
  require_in_range("transmit_power_dbm", model.transmit_power_dbm, -50.0, 60.0);
  require_in_range("cable_loss_db", model.cable_loss_db, 0.0, 100.0);
  require_in_range("phase_offset_rad", model.phase_offset_rad, -1e6, 1e6);
  if (model.diffuse_k_db) require_in_range("diffuse_k_db", *model.diffuse_k_db, -40.0, 100.0);
  if (model.hardware.sensitivity_dbm >= model.transmit_power_dbm) {
    throw Error(fmt::format("sensitivity_dbm must be below transmit_power_dbm ({:g}), is {:g}",
                            model.transmit_power_dbm, model.hardware.sensitivity_dbm));
  }
  if (model.gen2) {
    check(model.gen2->link);
    check(model.gen2->inventory);
    require_in_range("port_dwell_s", model.gen2->port_dwell_s, 1e-3, 1e4);
  }
  warn_of_power(model, diagnostics);
}

void check(const TagModel& tag, Diagnostics& diagnostics) {
  check(tag.antenna, diagnostics);
  require_in_range("sensitivity_dbm", tag.sensitivity_dbm, -100.0, 30.0);
  require_in_range("modulation_db", tag.modulation_db, -60.0, 0.0);
  require_in_range("detuning_db", tag.detuning_db, 0.0, 100.0);
}

std::shared_ptr<const TagModel> default_tag_model() {
  TagModel tag;
  tag.name = "dipole";
  tag.antenna.shape = PatternShape::kDipole;
  tag.antenna.gain_dbi = kDipole_dbi;
  return std::make_shared<const TagModel>(tag);
}

double free_space_range_m(const RadioModel& model, const TagModel& tag) {
  constexpr double kMost = 1e6;
  const double lambda_m = wavelength(model.plan.carriers_hz.front());
  const double radiated_dbm =
      model.transmit_power_dbm - model.cable_loss_db + peak_dbi(model.antenna);
  const double tag_dbi = peak_dbi(tag.antenna) - tag.detuning_db;
  const double to_tag_db = radiated_dbm + tag_dbi - tag.sensitivity_dbm;
  const double both_ways_db = radiated_dbm + peak_dbi(model.antenna) - model.cable_loss_db +
                              2.0 * tag_dbi + tag.modulation_db - model.hardware.sensitivity_dbm;
  const double loss_db = std::min(to_tag_db, 0.5 * both_ways_db);
  return std::min(kMost, lambda_m / (4.0 * kPi) * amplitude_from_db(loss_db));
}

double max_field_factor(const RadioModel& model) {
  const bool has_others = (model.effects.reflections && model.reflection_order > 0) ||
                          (model.effects.diffraction && model.diffraction) ||
                          (model.effects.diffuse && model.diffuse_k_db);
  return (has_others ? 2.0 : 1.0) * (couples_tags(model) ? 2.0 : 1.0);
}

double max_range_m(const RadioModel& model, const TagModel& tag) {
  return max_field_factor(model) * free_space_range_m(model, tag);
}

}  // namespace tagfield
