// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/internal/setting_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/error.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"

namespace tagfield::settings_internal {
namespace {

AntennaPattern& pattern_of(AntennaDraft& draft) { return draft.model.antenna; }
AntennaPattern& pattern_of(TagModel& tag) { return tag.antenna; }

std::vector<PatternSample> table_in(const std::string& text) {
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.empty() || numbers.size() % 3 != 0) {
    throw Error("expected triples: angle [deg], gain in the horizontal cut, in the vertical [dBi]");
  }
  std::vector<PatternSample> table;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    table.push_back({radians(numbers[i]), numbers[i + 1], numbers[i + 2]});
  }
  return table;
}

template <class T>
void add_pattern_settings(std::vector<Setting<T>>& all) {
  constexpr double kDegree = radians(1.0);
  all.push_back(word<T>(
      "pattern", {"isotropic", "patch", "dipole", "table"}, "shape of the gain over direction",
      [](T& t, std::size_t i) { pattern_of(t).shape = static_cast<PatternShape>(i); }));
  all.push_back(number<T>("gain_dbi", "dBi", "maximum gain",
                          [](T& t) -> double& { return pattern_of(t).gain_dbi; }));
  all.push_back({{"beam_width_deg", "deg", "half-power width of a patch's lobe, in both planes"},
                 [](T& t, const std::string& text) {
                   const double width = radians(number_in(text));
                   pattern_of(t).beam_width_rad = width;
                   pattern_of(t).vertical_beam_width_rad = width;
                 }});
  all.push_back(number<T>(
      "vertical_beam_width_deg", "deg", "likewise in the vertical plane, if it is different",
      [](T& t) -> double& { return pattern_of(t).vertical_beam_width_rad; }, kDegree));
  all.push_back(number<T>("front_to_back_db", "dB", "front-to-back ratio of a patch",
                          [](T& t) -> double& { return pattern_of(t).front_to_back_db; }));
  all.push_back({{"pattern_table", "deg dBi dBi",
                  "triples: angle off the boresight, gain in the "
                  "horizontal cut, gain in the vertical cut"},
                 [](T& t, const std::string& text) { pattern_of(t).table = table_in(text); }});
  all.push_back(word<T>(
      "polarization", {"linear", "right_circular", "left_circular"}, "of the field",
      [](T& t, std::size_t i) { pattern_of(t).polarization = static_cast<PolarizationKind>(i); }));
  all.push_back(number<T>(
      "tilt_deg", "deg", "of a linear polarization or a dipole: 0 along z, growing towards y",
      [](T& t) -> double& { return pattern_of(t).tilt_rad; }, kDegree));
}

void set_without(AntennaDraft& draft, const std::string& text) {
  for (const std::string& name : words_in(text)) {
    const auto* const found =
        std::find_if(kEffectSwitches.begin(), kEffectSwitches.end(),
                     [&](const EffectSwitch& effect) { return name == effect.name; });
    if (found == kEffectSwitches.end()) {
      std::vector<std::string> names;
      names.reserve(kEffectSwitches.size());
      for (const EffectSwitch& effect : kEffectSwitches) names.emplace_back(effect.name);
      throw Error(fmt::format("there is no effect '{}'{}", name, suggestion(name, names)));
    }
    draft.model.effects.*found->on = false;
  }
}

void set_receive_pose(AntennaDraft& draft, const std::string& text) {
  const std::vector<double> n = numbers_in(text);
  if (n.size() != 3 && n.size() != 6) throw Error("expected x y z or x y z roll pitch yaw");
  const Eigen::Vector3d rpy =
      n.size() == 6 ? Eigen::Vector3d(n[3], n[4], n[5]) : Eigen::Vector3d::Zero();
  draft.model.X_AR = from_xyz_rpy({n[0], n[1], n[2]}, rpy);
}

void add_power_settings(std::vector<Setting<AntennaDraft>>& all) {
  using D = AntennaDraft;
  all.push_back(number<D>("transmit_power_dbm", "dBm", "power at the reader's port",
                          [](D& d) -> double& { return d.model.transmit_power_dbm; }));
  all.push_back(number<D>("cable_loss_db", "dB", "between port and antenna, one way",
                          [](D& d) -> double& { return d.model.cable_loss_db; }));
  all.push_back({{"receive_pose", "m rad",
                  "receiving antenna in the sending one's frame: x y z "
                  "roll pitch yaw; else one antenna does both"},
                 set_receive_pose});
  all.push_back({{"reflection_order", "", "maximum number of reflections of a path, 0 to 3"},
                 [](D& d, const std::string& text) { d.model.reflection_order = whole_in(text); }});
  all.push_back(word<D>("diffraction", {"off", "on"}, "whether waves bend around edges",
                        [](D& d, std::size_t i) { d.model.diffraction = i == 1; }));
  all.push_back(word<D>("tag_coupling", {"off", "on"},
                        "whether nearby tags couple and change the power that each receives",
                        [](D& d, std::size_t i) { d.model.tag_coupling = i == 1; }));
  all.push_back(word<D>("interference", {"off", "on"},
                        "whether simultaneous transmissions of other readers disturb its links",
                        [](D& d, std::size_t i) { d.model.interference = i == 1; }));
  all.push_back(
      word<D>("spectrum_mask", {"multiple", "dense"},
              "of Gen2, that limits its emissions outside its channel",
              [](D& d, std::size_t i) { d.model.spectrum_mask = static_cast<SpectrumMask>(i); }));
  all.push_back({{"diffuse_k_db", "dB",
                  "power of all single paths over that of diffuse waves "
                  "(Rice's K); no such waves where not given"},
                 [](D& d, const std::string& text) { d.model.diffuse_k_db = number_in(text); }});
  all.push_back({{"without", "effects",
                  "effects to leave out: patterns, polarization, occlusion, "
                  "reflections, diffraction, bodies, diffuse, noise, quantization, hopping, "
                  "phase_offsets, pi_ambiguity, inventory, interference, coupling"},
                 set_without});
}

void add_plan_settings(std::vector<Setting<AntennaDraft>>& all) {
  using D = AntennaDraft;
  all.push_back(
      {{"frequency_hz", "Hz", "a single fixed carrier"},
       [](D& d, const std::string& text) { d.model.plan = fixed_plan(number_in(text)); }});
  all.push_back(
      {{"channel_plan", "etsi_low | etsi_high | fcc | china | fixed", "carriers to hop on"},
       [](D& d, const std::string& text) {
         if (text != "fixed") {
           d.model.plan = known_plan(text);
         } else if (d.model.plan.carriers_hz.size() > 1) {
           throw Error("fixed needs frequency_hz, as a profile gives several carriers");
         }
       }});
  all.push_back(
      {{"carriers_hz", "Hz", "carriers to hop on, instead of the plan's"},
       [](D& d, const std::string& text) { d.model.plan.carriers_hz = numbers_in(text); }});
  all.push_back(number<D>("dwell_s", "s", "time on each carrier",
                          [](D& d) -> double& { return d.model.plan.dwell_s; }));
  all.push_back(number<D>("phase_offset_rad", "rad", "φ0, on top of channels' and ports' offsets",
                          [](D& d) -> double& { return d.model.phase_offset_rad; }));
}

void add_receiver_settings(std::vector<Setting<AntennaDraft>>& all) {
  using D = AntennaDraft;
  const auto of_hardware = [&](const char* key, const char* unit, const char* meaning,
                               double ReaderHardware::*member) {
    all.push_back(number<D>(key, unit, meaning,
                            [member](D& d) -> double& { return d.model.hardware.*member; }));
  };
  of_hardware("sensitivity_dbm", "dBm", "minimum power of a reply that is decoded",
              &ReaderHardware::sensitivity_dbm);
  of_hardware("noise_figure_db", "dB", "of the receiver, its own carrier's leakage included",
              &ReaderHardware::noise_figure_db);
  of_hardware("bandwidth_hz", "Hz", "of the reply's data", &ReaderHardware::bandwidth_hz);
  of_hardware("averaged_bits", "", "bits over which the phase is measured",
              &ReaderHardware::averaged_bits);
  of_hardware("phase_floor_rad", "rad", "phase noise of the strongest replies",
              &ReaderHardware::phase_floor_rad);
  of_hardware("phase_steps", "", "steps per cycle, 0 for none", &ReaderHardware::phase_steps);
  of_hardware("rssi_step_db", "dB", "0 for none", &ReaderHardware::rssi_step_db);
  of_hardware("doppler_step_hz", "Hz", "0 for none", &ReaderHardware::doppler_step_hz);
  of_hardware("reply_s", "s", "length of the reply that Doppler is measured in",
              &ReaderHardware::reply_s);
}

void add_link_settings(std::vector<Setting<AntennaDraft>>& all) {
  using D = AntennaDraft;
  all.push_back(number<D>(
      "tari_us", "µs", "length of a data-0", [](D& d) -> double& { return d.gen2.link.tari_s; },
      1e-6));
  all.push_back(number<D>("data1_tari", "Tari", "length of a data-1",
                          [](D& d) -> double& { return d.gen2.link.data1_tari; }));
  all.push_back(number<D>(
      "blf_khz", "kHz", "backscatter link frequency",
      [](D& d) -> double& { return d.gen2.link.blf_hz; }, 1e3));
  all.push_back(word<D>("divide_ratio", {"8", "64/3"}, "DR", [](D& d, std::size_t i) {
    d.gen2.link.divide_ratio = i == 0 ? DivideRatio::k8 : DivideRatio::k64_3;
  }));
  all.push_back(word<D>("encoding", {"fm0", "miller2", "miller4", "miller8"}, "of tags' replies",
                        [](D& d, std::size_t i) {
                          constexpr Encoding kAll[] = {Encoding::kFm0, Encoding::kMiller2,
                                                       Encoding::kMiller4, Encoding::kMiller8};
                          d.gen2.link.encoding = kAll[i];
                        }));
  all.push_back({{"pilot", "true | false", "pilot tone before replies (TRext)"},
                 [](D& d, const std::string& text) { d.gen2.link.pilot = truth_in(text); }});
  all.push_back({{"epc_bits", "", "length of the tags' EPC"},
                 [](D& d, const std::string& text) { d.gen2.link.epc_bits = whole_in(text); }});
}

void add_inventory_settings(std::vector<Setting<AntennaDraft>>& all) {
  using D = AntennaDraft;
  all.push_back(word<D>("inventory", {"none", "gen2"},
                        "one read per update of every tag in reach, or slots of EPC Gen2",
                        [](D& d, std::size_t i) { d.takes_inventory = i == 1; }));
  all.push_back(
      word<D>("session", {"s0", "s1", "s2", "s3"}, "flags that tags keep it in",
              [](D& d, std::size_t i) { d.gen2.inventory.session = static_cast<Session>(i); }));
  all.push_back(
      word<D>("target", {"a", "b", "alternate"}, "tags to ask for",
              [](D& d, std::size_t i) { d.gen2.inventory.target = static_cast<Target>(i); }));
  all.push_back(
      {{"adaptive_q", "true | false", "whether Q adapts to the number of tags"},
       [](D& d, const std::string& text) { d.gen2.inventory.adaptive_q = truth_in(text); }});
  const auto whole = [&](const char* key, const char* meaning, int InventorySettings::*member) {
    all.push_back({{key, "", meaning}, [member](D& d, const std::string& text) {
                     d.gen2.inventory.*member = whole_in(text);
                   }});
  };
  whole("start_q", "Q of the first round, which has 2^Q slots", &InventorySettings::start_q);
  whole("min_q", "minimum Q, at most start_q", &InventorySettings::min_q);
  whole("max_q", "maximum Q, at least start_q", &InventorySettings::max_q);
  const auto real = [&](const char* key, const char* unit, const char* meaning,
                        double InventorySettings::*member) {
    all.push_back(number<D>(key, unit, meaning,
                            [member](D& d) -> double& { return d.gen2.inventory.*member; }));
  };
  real("q_step", "", "C of the adaptive Q", &InventorySettings::q_step);
  all.push_back(
      {{"capture_db", "dB",
        "by how much a reply must exceed all others together to be decoded; never where not given"},
       [](D& d, const std::string& text) { d.gen2.inventory.capture_db = number_in(text); }});
  real("power_up_s", "s", "carrier before the first Query", &InventorySettings::power_up_s);
  real("round_overhead_s", "s", "lost before each Query", &InventorySettings::round_overhead_s);
  real("slot_overhead_s", "s", "lost after each slot", &InventorySettings::slot_overhead_s);
  real("read_overhead_s", "s", "lost after each read", &InventorySettings::read_overhead_s);
  all.push_back(number<D>("port_dwell_s", "s", "time at one antenna before the next one's turn",
                          [](D& d) -> double& { return d.gen2.port_dwell_s; }));
  all.push_back(word<D>("sharing", {"channel", "time"}, "how readers share the air",
                        [](D& d, std::size_t i) { d.model.sharing = static_cast<AirSharing>(i); }));
}

}  // namespace

const std::vector<Setting<AntennaDraft>>& antenna_table() {
  static const std::vector<Setting<AntennaDraft>> all = [] {
    std::vector<Setting<AntennaDraft>> table;
    add_power_settings(table);
    add_pattern_settings(table);
    add_plan_settings(table);
    add_receiver_settings(table);
    add_inventory_settings(table);
    add_link_settings(table);
    return table;
  }();
  return all;
}

const std::vector<Setting<TagModel>>& tag_table() {
  static const std::vector<Setting<TagModel>> all = [] {
    std::vector<Setting<TagModel>> table;
    add_pattern_settings(table);
    table.push_back(number<TagModel>("sensitivity_dbm", "dBm", "minimum power at which it replies",
                                     [](TagModel& t) -> double& { return t.sensitivity_dbm; }));
    table.push_back(number<TagModel>("modulation_db", "dB", "backscattered over absorbed power",
                                     [](TagModel& t) -> double& { return t.modulation_db; }));
    table.push_back(number<TagModel>("detuning_db", "dB", "loss by what it is mounted on, one way",
                                     [](TagModel& t) -> double& { return t.detuning_db; }));
    return table;
  }();
  return all;
}

}  // namespace tagfield::settings_internal
