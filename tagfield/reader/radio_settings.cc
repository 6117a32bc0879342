#include "tagfield/reader/radio_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <sstream>

#include "tagfield/base/number.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// One key: what it is for, and how its value gets into a T. Throws Error without the place.
template <class T>
struct Setting {
  SettingHelp help;
  std::function<void(T&, const std::string&)> set;
};

double number_in(const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value || !std::isfinite(*value)) {
    throw Error(fmt::format("is '{}', expected a finite number", text));
  }
  return *value;
}

int whole_in(const std::string& text) {
  const double value = number_in(text);
  if (std::floor(value) != value || std::abs(value) > 1e9) {
    throw Error(fmt::format("is '{}', expected a whole number", text));
  }
  return static_cast<int>(value);
}

bool truth_in(const std::string& text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  throw Error(fmt::format("is '{}', expected true or false", text));
}

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : words_in(text)) numbers.push_back(number_in(word));
  return numbers;
}

std::size_t choice_in(const std::string& text, const std::vector<std::string>& choices) {
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end()) {
    throw Error(fmt::format("is '{}', expected {}", text, fmt::join(choices, ", ")));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::string one_of(const std::vector<std::string>& choices) {
  return fmt::format("{}", fmt::join(choices, " | "));
}

/// A number with a unit that is `factor` of the member's.
template <class T>
Setting<T> number(const char* key, const char* unit, const char* meaning,
                  std::function<double&(T&)> member, double factor = 1.0) {
  return {{key, unit, meaning}, [member, factor](T& model, const std::string& text) {
            member(model) = factor * number_in(text);
          }};
}

template <class T>
Setting<T> word(const char* key, const std::vector<std::string>& choices, const char* meaning,
                std::function<void(T&, std::size_t)> set) {
  return {{key, one_of(choices), meaning}, [choices, set](T& model, const std::string& text) {
            set(model, choice_in(text, choices));
          }};
}

/// A plan is put together from several keys.
struct AntennaDraft {
  RadioModel model;
  Gen2Reader gen2;
  bool takes_inventory = false;
};

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
  all.push_back(number<T>("gain_dbi", "dBi", "greatest gain",
                          [](T& t) -> double& { return pattern_of(t).gain_dbi; }));
  all.push_back({{"beam_width_deg", "deg", "half-power width of a patch's lobe, in both planes"},
                 [](T& t, const std::string& text) {
                   const double width = radians(number_in(text));
                   pattern_of(t).beam_width_rad = width;
                   pattern_of(t).vertical_beam_width_rad = width;
                 }});
  all.push_back(number<T>(
      "vertical_beam_width_deg", "deg", "likewise in the vertical plane, where it is another",
      [](T& t) -> double& { return pattern_of(t).vertical_beam_width_rad; }, kDegree));
  all.push_back(number<T>("front_to_back_db", "dB", "how much weaker a patch's back is",
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
  all.push_back({{"reflection_order", "", "most reflections of a path, 0 to 3"},
                 [](D& d, const std::string& text) { d.model.reflection_order = whole_in(text); }});
  all.push_back({{"diffuse_k_db", "dB",
                  "power of all single paths over that of diffuse waves "
                  "(Rice's K); no such waves where not given"},
                 [](D& d, const std::string& text) { d.model.diffuse_k_db = number_in(text); }});
  all.push_back({{"without", "effects",
                  "effects to leave out: patterns, polarization, occlusion, "
                  "reflections, diffuse, noise, quantization, hopping, "
                  "phase_offsets, half_turns, inventory"},
                 set_without});
}

void add_plan_settings(std::vector<Setting<AntennaDraft>>& all) {
  using D = AntennaDraft;
  all.push_back({{"frequency_hz", "Hz", "one carrier for good"}, [](D& d, const std::string& text) {
                   d.model.plan = fixed_plan(number_in(text));
                 }});
  all.push_back(
      {{"channel_plan", "etsi_low | etsi_high | fcc | china | fixed", "carriers to hop on"},
       [](D& d, const std::string& text) {
         if (text != "fixed") d.model.plan = known_plan(text);
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
  of_hardware("sensitivity_dbm", "dBm", "least power of a reply that is heard",
              &ReaderHardware::sensitivity_dbm);
  of_hardware("noise_figure_db", "dB", "of the receiver, its own carrier's leakage included",
              &ReaderHardware::noise_figure_db);
  of_hardware("bandwidth_hz", "Hz", "of the reply's data", &ReaderHardware::bandwidth_hz);
  of_hardware("averaged_bits", "", "bits over which the phase is measured",
              &ReaderHardware::averaged_bits);
  of_hardware("phase_floor_rad", "rad", "phase noise of the strongest replies",
              &ReaderHardware::phase_floor_rad);
  of_hardware("phase_steps", "", "steps of a turn, 0 for none", &ReaderHardware::phase_steps);
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
                        "one read an update of all that is heard, "
                        "or slots of EPC Gen2",
                        [](D& d, std::size_t i) { d.takes_inventory = i == 1; }));
  all.push_back(
      word<D>("session", {"s0", "s1", "s2", "s3"}, "flags that tags keep it in",
              [](D& d, std::size_t i) { d.gen2.inventory.session = static_cast<Session>(i); }));
  all.push_back(
      word<D>("target", {"a", "b", "alternate"}, "tags to ask for",
              [](D& d, std::size_t i) { d.gen2.inventory.target = static_cast<Target>(i); }));
  all.push_back(
      {{"adaptive_q", "true | false", "whether Q follows the tags' number"},
       [](D& d, const std::string& text) { d.gen2.inventory.adaptive_q = truth_in(text); }});
  const auto whole = [&](const char* key, const char* meaning, int InventorySettings::*member) {
    all.push_back({{key, "", meaning}, [member](D& d, const std::string& text) {
                     d.gen2.inventory.*member = whole_in(text);
                   }});
  };
  whole("start_q", "Q of the first round, which has 2^Q slots", &InventorySettings::start_q);
  whole("min_q", "least Q", &InventorySettings::min_q);
  whole("max_q", "greatest Q", &InventorySettings::max_q);
  const auto real = [&](const char* key, const char* unit, const char* meaning,
                        double InventorySettings::*member) {
    all.push_back(number<D>(key, unit, meaning,
                            [member](D& d) -> double& { return d.gen2.inventory.*member; }));
  };
  real("q_step", "", "C of the adaptive Q", &InventorySettings::q_step);
  all.push_back(
      {{"capture_db", "dB",
        "how much stronger than all others together a reply is made "
        "out; never where not given"},
       [](D& d, const std::string& text) { d.gen2.inventory.capture_db = number_in(text); }});
  real("power_up_s", "s", "carrier before the first Query", &InventorySettings::power_up_s);
  real("round_overhead_s", "s", "lost before each Query", &InventorySettings::round_overhead_s);
  real("slot_overhead_s", "s", "lost after each slot", &InventorySettings::slot_overhead_s);
  real("read_overhead_s", "s", "lost after each read", &InventorySettings::read_overhead_s);
  all.push_back(number<D>("port_dwell_s", "s", "time at one antenna before the next one's turn",
                          [](D& d) -> double& { return d.gen2.port_dwell_s; }));
  all.push_back(word<D>("sharing", {"channel", "time"}, "how readers keep apart",
                        [](D& d, std::size_t i) { d.model.sharing = static_cast<AirSharing>(i); }));
}

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
    table.push_back(number<TagModel>("sensitivity_dbm", "dBm", "least power that makes it answer",
                                     [](TagModel& t) -> double& { return t.sensitivity_dbm; }));
    table.push_back(number<TagModel>("modulation_db", "dB", "backscattered over absorbed power",
                                     [](TagModel& t) -> double& { return t.modulation_db; }));
    table.push_back(number<TagModel>("detuning_db", "dB", "loss by what it is mounted on, one way",
                                     [](TagModel& t) -> double& { return t.detuning_db; }));
    return table;
  }();
  return all;
}

template <class T>
const Setting<T>* find(const std::vector<Setting<T>>& table, const std::string& key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Setting<T>& setting) {
    return setting.help.key == key;
  });
  return found == table.end() ? nullptr : &*found;
}

template <class T>
std::vector<SettingHelp> helps(const std::vector<Setting<T>>& table) {
  std::vector<SettingHelp> all;
  all.reserve(table.size());
  for (const Setting<T>& setting : table) all.push_back(setting.help);
  return all;
}

template <class T>
void apply(const std::vector<Setting<T>>& table, const std::vector<RawParameter>& parameters,
           T& model) {
  for (const RawParameter& parameter : parameters) {
    const Setting<T>* const setting = find(table, parameter.key);
    if (setting == nullptr) continue;
    try {
      setting->set(model, parameter.value);
    } catch (const Error& error) {
      fail(parameter.location, fmt::format("{} {}", parameter.key, error.what()));
    }
  }
}

/// The place of the parameter that a complaint names first, or `otherwise`.
Location place_of(const std::string& complaint, const std::vector<RawParameter>& parameters,
                  const Location& otherwise) {
  const std::string key = complaint.substr(0, complaint.find(' '));
  const auto found = std::find_if(parameters.rbegin(), parameters.rend(),
                                  [&](const RawParameter& p) { return p.key == key; });
  return found == parameters.rend() ? otherwise : found->location;
}

template <class Model>
void check_at(const Model& model, const std::vector<RawParameter>& parameters,
              const Location& location, Diagnostics& diagnostics) {
  Diagnostics found;
  try {
    check(model, found);
  } catch (const Error& error) {
    fail(place_of(error.what(), parameters, location), error.what());
  }
  for (const std::string& warning : found.warnings()) diagnostics.warn(location, warning);
}

AntennaDraft default_draft(PropagationModel model) {
  AntennaDraft draft;
  draft.model.antenna.shape = PatternShape::kPatch;
  draft.model.antenna.gain_dbi = 8.0;
  draft.model.antenna.beam_width_rad = radians(65.0);
  draft.model.antenna.vertical_beam_width_rad = radians(65.0);
  draft.model.antenna.polarization = PolarizationKind::kRightCircular;
  draft.model.plan = fixed_plan(865.7e6);
  constexpr int kUsualOrder = 2;
  draft.model.reflection_order = model == PropagationModel::kMultipath ? kUsualOrder : 0;
  return draft;
}

/// In the order of PropagationModel.
constexpr std::array<const char*, 3> kModels = {"paper", "link_budget", "multipath"};

/// Those of the table, which alone were applied.
template <class T>
void add_settings(const std::vector<Setting<T>>& table, const std::vector<RawParameter>& parameters,
                  std::vector<RawParameter>& settings) {
  std::copy_if(parameters.begin(), parameters.end(), std::back_inserter(settings),
               [&](const RawParameter& p) { return find(table, p.key) != nullptr; });
}

}  // namespace

const char* to_string(PropagationModel model) {
  return kModels.at(static_cast<std::size_t>(model));
}

PropagationModel propagation_model(const RawParameter& parameter) {
  try {
    return static_cast<PropagationModel>(
        choice_in(parameter.value, {kModels.begin(), kModels.end()}));
  } catch (const Error& error) {
    fail(parameter.location, fmt::format("{} {}", parameter.key, error.what()));
  }
}

const std::vector<SettingHelp>& antenna_settings() {
  static const std::vector<SettingHelp> all = helps(antenna_table());
  return all;
}

const std::vector<SettingHelp>& tag_settings() {
  static const std::vector<SettingHelp> all = helps(tag_table());
  return all;
}

bool is_antenna_setting(const std::string& key) { return find(antenna_table(), key) != nullptr; }
bool is_tag_setting(const std::string& key) { return find(tag_table(), key) != nullptr; }

std::shared_ptr<const RadioModel> radio_model_from(PropagationModel model,
                                                   const std::vector<RawParameter>& parameters,
                                                   const Location& location,
                                                   Diagnostics& diagnostics) {
  AntennaDraft draft = default_draft(model);
  apply(antenna_table(), parameters, draft);
  if (draft.takes_inventory) draft.model.gen2 = draft.gen2;
  // A link budget has no other paths, whatever the antenna's multipath would have.
  if (model == PropagationModel::kLinkBudget) {
    draft.model.effects.reflections = false;
    draft.model.effects.diffuse = false;
  }
  check_at(draft.model, parameters, location, diagnostics);
  draft.model.settings = {{"model", to_string(model), location}};
  add_settings(antenna_table(), parameters, draft.model.settings);
  return std::make_shared<const RadioModel>(draft.model);
}

std::shared_ptr<const TagModel> tag_model_from(const std::string& name,
                                               const std::vector<RawParameter>& parameters,
                                               const Location& location, Diagnostics& diagnostics) {
  TagModel tag = *default_tag_model();
  tag.name = name;
  apply(tag_table(), parameters, tag);
  check_at(tag, parameters, location, diagnostics);
  add_settings(tag_table(), parameters, tag.settings);
  return std::make_shared<const TagModel>(tag);
}

}  // namespace tagfield
