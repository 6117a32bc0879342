// SPDX-License-Identifier: Apache-2.0
/// @file
/// The physical model of an antenna: link budget or multipath, and the reader behind it. See
/// docs/link_budget.md, docs/multipath.md and docs/reader.md.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/setting.h"
#include "tagfield/channel/antenna_pattern.h"
#include "tagfield/channel/path_gain.h"
#include "tagfield/gen2/inventory_settings.h"
#include "tagfield/gen2/link_timing.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/propagation/trace_paths.h"
#include "tagfield/reader/channel_plan.h"
#include "tagfield/reader/reader_hardware.h"
#include "tagfield/reader/transmit_spectrum.h"

namespace tagfield {

/// The simulated effects. Each can be switched off independently.
struct RadioEffects {
  bool patterns = true;       ///< Directional gain of antennas and tags.
  bool polarization = true;   ///< Of both ends.
  bool occlusion = true;      ///< By obstacles.
  bool reflections = true;    ///< From flat surfaces.
  bool diffraction = true;    ///< Around edges, if enabled.
  bool bodies = true;         ///< Moving objects that have a material.
  bool diffuse = true;        ///< Diffuse waves, if a K factor is given.
  bool noise = true;          ///< In phase, RSSI and Doppler.
  bool quantization = true;   ///< Of reported values.
  bool hopping = true;        ///< Changing carriers; else always the first one.
  bool phase_offsets = true;  ///< One per channel and per port.
  bool pi_ambiguity = true;   ///< π ambiguity of the phase, with Miller replies.
  bool inventory = true;      ///< Gen2 slots, if an inventory is given.
  bool interference = true;   ///< By other readers, if enabled.
  bool coupling = true;       ///< Of tags close to each other, if enabled.
};

/// An effect's name in scenarios and its flag.
struct EffectSwitch {
  const char* name;
  const char* what;  ///< For display.
  bool RadioEffects::*on;
};
constexpr std::array<EffectSwitch, 15> kEffectSwitches = {{
    {"patterns", "antenna patterns", &RadioEffects::patterns},
    {"polarization", "polarization", &RadioEffects::polarization},
    {"occlusion", "occlusion", &RadioEffects::occlusion},
    {"reflections", "reflections", &RadioEffects::reflections},
    {"diffraction", "diffraction", &RadioEffects::diffraction},
    {"bodies", "moving bodies", &RadioEffects::bodies},
    {"diffuse", "diffuse waves", &RadioEffects::diffuse},
    {"noise", "receiver's noise", &RadioEffects::noise},
    {"quantization", "steps of phase and RSSI", &RadioEffects::quantization},
    {"hopping", "channel hopping", &RadioEffects::hopping},
    {"phase_offsets", "phase offsets of channels and ports", &RadioEffects::phase_offsets},
    {"pi_ambiguity", "π ambiguity of the phase", &RadioEffects::pi_ambiguity},
    {"inventory", "Gen2 inventory", &RadioEffects::inventory},
    {"interference", "interference of readers", &RadioEffects::interference},
    {"coupling", "coupling of tags", &RadioEffects::coupling},
}};

/// All off.
RadioEffects no_effects();

/// How a reader inventories over its antennas.
struct Gen2Reader {
  LinkSettings link;
  InventorySettings inventory;
  double port_dwell_s = 0.2;  ///< Time on one antenna before switching to the next.
};

/// How readers within range of each other avoid interference.
enum class AirSharing {
  kChannel,  ///< Each on its own channel.
  kTime,     ///< In turns, one port dwell time each.
};

/// All physical parameters of one antenna. Its frame A: boresight along x, z up.
struct RadioModel {
  RadioEffects effects;
  int reflection_order = 0;   ///< Maximum number of reflections of a path: 0 to 3.
  bool diffraction = false;   ///< Diffraction around edges.
  bool interference = false;  ///< Signals of other readers disturb its links.
  bool tag_coupling = false;  ///< Tags close to each other change the power that each receives.
  SpectrumMask spectrum_mask = SpectrumMask::kDense;  ///< Limits its transmit spectrum.
  /// Power of all specular paths over that of diffuse waves (Rician K factor) [dB]; unset for no
  /// diffuse waves.
  std::optional<double> diffuse_k_db;
  AntennaPattern antenna;
  std::optional<RigidTransform> X_AR;  ///< Separate receiving antenna, same pattern.
  double transmit_power_dbm = 30.0;    ///< At the reader's port.
  double cable_loss_db = 0.0;          ///< Per direction; 0 or more.
  ReaderHardware hardware;
  ChannelPlan plan;
  double phase_offset_rad = 0.0;  ///< φ0, added to the offsets of channels and ports.
  std::optional<Gen2Reader> gen2;
  AirSharing sharing = AirSharing::kChannel;
  /// The settings it was created from, for writing them down: `model`, and keys of radio_settings.h
  /// in the order in which they were applied.
  std::vector<RawParameter> settings{};
};

/// Whether it reads tags by Gen2's inventory, slot by slot, and not all in range at each update.
inline bool takes_inventory(const RadioModel& model) {
  return model.gen2 && model.effects.inventory;
}

/// Whether signals of other readers disturb it; whether the coupling of tags is simulated.
inline bool is_disturbed(const RadioModel& model) {
  return model.interference && model.effects.interference;
}
inline bool couples_tags(const RadioModel& model) {
  return model.tag_coupling && model.effects.coupling;
}

/// Its transmit spectrum, bounded by the mask: channels of 2.5/Tari, or of the plan's width.
TransmitSpectrum transmit_spectrum_of(const RadioModel& model);
/// The link settings of its tags' replies, even without an inventory.
LinkSettings reply_link_of(const RadioModel& model);

/// Throws Error naming the parameter that is out of range; warns of suspicious values: more
/// radiated power than the plan allows, a gain above its lobe's limit.
void check(const RadioModel& model, Diagnostics& diagnostics);

/// A kind of tag.
struct TagModel {
  std::string name;
  AntennaPattern antenna;                ///< Frame T: face along x, z up.
  double sensitivity_dbm = -18.0;        ///< Minimum power at the chip for it to respond.
  double modulation_db = -5.0;           ///< Backscattered over absorbed power; 0 or less.
  double detuning_db = 0.0;              ///< Mounting loss each way; 0 or more.
  std::vector<RawParameter> settings{};  ///< The settings it was created from, as in RadioModel.
};

/// Throws Error naming the parameter that is out of range.
void check(const TagModel& tag, Diagnostics& diagnostics);

/// A half-wave dipole along z with a chip sensitivity of −18 dBm.
std::shared_ptr<const TagModel> default_tag_model();

/// Distance up to which tags with the gain and sensitivity of `tag` can be read in free space [m],
/// at peak gains.
double free_space_range_m(const RadioModel& model, const TagModel& tag);
/// By how much the field at a tag may exceed that of the direct path: assumed to be at most 2 where
/// other paths add to it, and twice that where other tags may focus it.
double max_field_factor(const RadioModel& model);
/// Upper bound on the distance at which such tags can be read [m]: the product of both.
double max_range_m(const RadioModel& model, const TagModel& tag);

}  // namespace tagfield
