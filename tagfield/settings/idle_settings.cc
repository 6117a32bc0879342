// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/idle_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "tagfield/reader/radio_model.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace {

using Why = std::optional<std::string>;

template <std::size_t N>
bool is_any(const std::string& key, const std::array<std::string_view, N>& keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// Settings of an inventory's link, rounds and port cycle.
constexpr std::array<std::string_view, 20> kOfInventory = {
    "session",         "target",          "adaptive_q",   "start_q",    "min_q",
    "max_q",           "q_step",          "capture_db",   "power_up_s", "round_overhead_s",
    "slot_overhead_s", "read_overhead_s", "port_dwell_s", "tari_us",    "data1_tari",
    "blf_khz",         "divide_ratio",    "encoding",     "pilot",      "epc_bits"};
constexpr std::array<std::string_view, 3> kOfAdaptiveQ = {"min_q", "max_q", "q_step"};
constexpr std::array<std::string_view, 3> kOfLobe = {"beam_width_deg", "vertical_beam_width_deg",
                                                     "front_to_back_db"};

const char* name_of(PatternShape shape) {
  switch (shape) {
    case PatternShape::kIsotropic:
      return "isotropic";
    case PatternShape::kPatch:
      return "patch";
    case PatternShape::kDipole:
      return "dipole";
    case PatternShape::kTable:
      return "table";
  }
  return "";
}

Why why_idle_in(const std::string& key, const AntennaPattern& pattern) {
  const bool is_dipole = pattern.shape == PatternShape::kDipole;
  if (is_any(key, kOfLobe) && pattern.shape != PatternShape::kPatch) {
    return fmt::format("with pattern: {}; expected patch", name_of(pattern.shape));
  }
  if (key == "gain_dbi" && pattern.shape == PatternShape::kTable) {
    return "with pattern: table, which has its own gains";
  }
  if (key == "pattern_table" && pattern.shape != PatternShape::kTable) {
    return fmt::format("with pattern: {}; expected table", name_of(pattern.shape));
  }
  if (key == "polarization" && is_dipole && pattern.polarization != PolarizationKind::kLinear) {
    return "with pattern: dipole, whose polarization is linear";
  }
  if (key == "tilt_deg" && !is_dipole && pattern.polarization != PolarizationKind::kLinear) {
    return "with a circular polarization";
  }
  return std::nullopt;
}

Why why_idle_in_link_budget(const std::string& key, const RadioModel& model) {
  constexpr const char* kWhy = "with model: link_budget; expected multipath";
  const RawParameter* const kind = last_of(model.settings, "model");
  if (kind == nullptr || kind->value != to_string(PropagationModel::kLinkBudget)) return {};
  if (key == "reflection_order" && model.reflection_order > 0) return kWhy;
  if (key == "diffraction" && model.diffraction) return kWhy;
  if (key == "diffuse_k_db") return kWhy;
  return std::nullopt;
}

Why why_idle_in_plan(const std::string& key, const RadioModel& model) {
  const std::vector<double>& carriers_hz = model.plan.carriers_hz;
  const bool hops = carriers_hz.size() > 1;
  if (key == "dwell_s" && !hops) return "with a single carrier";
  if (key == "frequency_hz" &&
      (hops ||
       carriers_hz !=
           fixed_plan(number_in(last_of(model.settings, "frequency_hz")->value)).carriers_hz)) {
    return "beside channel_plan or carriers_hz, which name other carriers";
  }
  return std::nullopt;
}

Why why_idle_in_inventory(const std::string& key, const RadioModel& model) {
  if (!model.gen2) {
    if (is_any(key, kOfInventory)) return "without inventory: gen2";
  } else if (!model.gen2->inventory.adaptive_q && is_any(key, kOfAdaptiveQ)) {
    return "with adaptive_q: false";
  }
  return std::nullopt;
}

}  // namespace

Why why_idle(const std::string& key, const RadioModel& model) {
  if (last_of(model.settings, key) == nullptr) return std::nullopt;
  for (const Why& why : {why_idle_in(key, model.antenna), why_idle_in_link_budget(key, model),
                         why_idle_in_plan(key, model), why_idle_in_inventory(key, model)}) {
    if (why) return why;
  }
  return std::nullopt;
}

Why why_idle(const std::string& key, const TagModel& tag) { return why_idle_in(key, tag.antenna); }

}  // namespace tagfield
