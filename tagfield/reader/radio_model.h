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

/// What is simulated. Each effect can be switched off by itself.
struct RadioEffects {
  bool patterns = true;       ///< Gain over direction, of antennas and tags.
  bool polarization = true;   ///< Of both ends.
  bool occlusion = true;      ///< By what stands between.
  bool reflections = true;    ///< From flat surfaces.
  bool diffraction = true;    ///< Around edges, where it is asked for.
  bool bodies = true;         ///< Things that move, where they have a material.
  bool diffuse = true;        ///< Waves from everywhere, where a K factor is given.
  bool noise = true;          ///< Of phase, RSSI and Doppler.
  bool quantization = true;   ///< Steps of what is reported.
  bool hopping = true;        ///< Changing carriers; else the first one for good.
  bool phase_offsets = true;  ///< One of each channel and each port.
  bool half_turns = true;     ///< π ambiguity, with Miller replies.
  bool inventory = true;      ///< Gen2 slots, where an inventory is given.
  bool interference = true;   ///< By other readers, where it is asked for.
  bool coupling = true;       ///< Of tags near one another, where it is asked for.
};

/// An effect's name in scenarios and its switch.
struct EffectSwitch {
  const char* name;
  const char* what;  ///< For people.
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
    {"half_turns", "π ambiguity of the phase", &RadioEffects::half_turns},
    {"inventory", "Gen2 inventory", &RadioEffects::inventory},
    {"interference", "interference of readers", &RadioEffects::interference},
    {"coupling", "coupling of tags", &RadioEffects::coupling},
}};

/// All off.
RadioEffects no_effects();

/// How a reader takes inventory over its antennas.
struct Gen2Reader {
  LinkSettings link;
  InventorySettings inventory;
  double port_dwell_s = 0.2;  ///< Time at one antenna before the next one's turn.
};

/// How readers that hear one another keep apart.
enum class AirSharing {
  kChannel,  ///< Each on a channel of its own.
  kTime,     ///< By turns, a port's dwell each.
};

/// All that is physical of one antenna. Its frame A: boresight along x, z up.
struct RadioModel {
  RadioEffects effects;
  int reflection_order = 0;   ///< Most bounces of a path: 0 to 3.
  bool diffraction = false;   ///< Waves bend around edges.
  bool interference = false;  ///< What other readers send disturbs its links.
  bool tag_coupling = false;  ///< Tags near one another change what each takes in.
  SpectrumMask spectrum_mask = SpectrumMask::kDense;  ///< That what it sends keeps to.
  /// Power of all single paths over that of diffuse waves (Rice's K) [dB]; none for no such waves.
  std::optional<double> diffuse_k_db;
  AntennaPattern antenna;
  std::optional<RigidTransform> X_AR;  ///< A receiving antenna of its own, with the same pattern.
  double transmit_power_dbm = 30.0;    ///< At the reader's port.
  double cable_loss_db = 0.0;          ///< One way; 0 or more.
  ReaderHardware hardware;
  ChannelPlan plan;
  double phase_offset_rad = 0.0;  ///< φ0, on top of what channels and ports add.
  std::optional<Gen2Reader> gen2;
  AirSharing sharing = AirSharing::kChannel;
  /// What it was made of, for whoever writes it down: `model`, and keys of radio_settings.h in the
  /// order in which they were applied.
  std::vector<RawParameter> settings{};
};

/// Whether other readers' signals disturb it; whether tags' coupling counts.
inline bool is_disturbed(const RadioModel& model) {
  return model.interference && model.effects.interference;
}
inline bool couples_tags(const RadioModel& model) {
  return model.tag_coupling && model.effects.coupling;
}

/// What it sends, as its mask bounds it: channels of 2.5/Tari, or of the plan's width.
TransmitSpectrum transmit_spectrum_of(const RadioModel& model);
/// Of its tags' replies, without an inventory as well.
LinkSettings reply_link_of(const RadioModel& model);

/// Throws Error naming the parameter that is out of its range; what is odd is warned of: more
/// radiated power than the plan allows, a gain above its lobe's limit.
void check(const RadioModel& model, Diagnostics& diagnostics);

/// A kind of tag.
struct TagModel {
  std::string name;
  AntennaPattern antenna;          ///< Frame T: face along x, z up.
  double sensitivity_dbm = -18.0;  ///< Least power at the chip that makes it answer.
  double modulation_db = -5.0;     ///< Backscattered over absorbed power; 0 or less.
  double detuning_db = 0.0;        ///< Loss by what the tag is mounted on, each way; 0 or more.
  std::vector<RawParameter> settings{};  ///< What it was made of, as of RadioModel.
};

/// Throws Error naming the parameter that is out of its range.
void check(const TagModel& tag, Diagnostics& diagnostics);

/// A half-wave dipole along z with a chip of −18 dBm.
std::shared_ptr<const TagModel> default_tag_model();

/// Distance beyond which no tag of gain and sensitivity like `tag`'s can be read, all paths adding
/// up [m]: the free-space range at the greatest gains and with fields of twice the direct one's.
double most_range_m(const RadioModel& model, const TagModel& tag);

}  // namespace tagfield
