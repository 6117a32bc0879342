// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/reader_configuration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "adapters/llrp/rf_modes.h"
#include "tagfield/gen2/tag_epc.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield::llrp {
namespace {

constexpr std::uint16_t kLastEvent = 8;
constexpr std::uint16_t kReaderChooses = 1000;  ///< RF mode.
constexpr std::uint16_t kUsualTags = 16;
constexpr std::uint16_t kHopTable = 1;  ///< The only one.
/// Impinj's search modes.
constexpr std::uint16_t kSingleTarget = 1;
constexpr std::uint16_t kDualTarget = 2;
constexpr std::uint16_t kFocus = 3;

void read_events(ByteReader content, std::set<std::uint16_t>& events) {
  for (const Parameter& state : parameters_of(content)) {
    if (state.type != 245) continue;
    ByteReader value = state.content;
    const std::uint16_t kind = value.u16();
    if ((value.u8() & 0x80U) != 0) {
      events.insert(kind);
    } else {
      events.erase(kind);
    }
  }
}

void read_keepalive(ByteReader content, Duration& keepalive) {
  const std::uint8_t trigger = content.u8();
  const std::chrono::milliseconds every(content.u32());
  if (trigger > 1) throw Fault(Status::kFieldError, "a keepalive's trigger must be 0 or 1");
  if (trigger == 1 && every.count() == 0) {
    throw Fault(Status::kFieldError, "a keepalive's period must be longer than 0 ms");
  }
  keepalive = trigger == 1 ? Duration(every) : Duration{};
}

void read_parameter(const Parameter& parameter, ReaderConfiguration& configuration) {
  ByteReader content = parameter.content;
  switch (parameter.type) {
    case kReaderEventNotificationSpec:
      return read_events(content, configuration.events);
    case kAntennaConfiguration:
      return read_antenna_setting(content, configuration.antennas);
    case kRoReportSpec:
      configuration.report = report_spec_of(content);
      return;
    case kAccessReportSpec:
      configuration.access_report = access_report_of(content);
      return;
    case kKeepaliveSpec:
      return read_keepalive(content, configuration.keepalive);
    case kEventsAndReports:
      configuration.holds_reports = (content.u8() & 0x80U) != 0;
      return;
    case kCustomParameter:
      return;  // Vendor settings have no effect in simulation.
    default:
      throw Fault(Status::kUnsupportedParameter,
                  fmt::format("parameter {} can't be set here", parameter.type));
  }
}

void write_identification(const std::string& name, ByteWriter& out) {
  out.parameter(218, [&] {
    out.u8(1);
    const Words id = epc_of_id(name);
    out.u16(static_cast<std::uint16_t>(id.size() * 2));
    for (const std::uint16_t word : id) out.u16(word);
  });
}

void write_properties(const LiveAntenna& antenna, std::uint16_t id, ByteWriter& out) {
  const RadioModel* const model = physical(antenna.spec.parameters);
  const double gain_dbi = model == nullptr ? 0.0 : model->antenna.gain_dbi;
  out.parameter(221, [&] {
    out.flag(!antenna.is_faulty);
    out.u16(id);
    out.s16(static_cast<std::int16_t>(std::lround(gain_dbi * 100.0)));
  });
}

void write_antenna(const AntennaSetting& setting, const Ports& ports, std::uint16_t id,
                   ByteWriter& out) {
  const std::vector<double> powers = powers_of(ports);
  const RadioModel* const model = physical(ports.antennas[id - 1U].spec.parameters);
  const double own_dbm = model == nullptr ? powers.front() : model->transmit_power_dbm;
  out.parameter(kAntennaConfiguration, [&] {
    out.u16(id);
    out.parameter(223, [&] { out.u16(1); });
    out.parameter(224, [&] {
      out.u16(hops(ports) ? kHopTable : 0);
      out.u16(setting.channel_index.value_or(hops(ports) ? 0 : 1));
      out.u16(setting.power_index.value_or(power_index_of(powers, own_dbm)));
    });
    out.parameter(330, [&] {
      out.u8(0);
      out.parameter(335, [&] {
        out.u16(setting.mode_index.value_or(kReaderChooses));
        out.u16(0);
      });
      out.parameter(336, [&] {
        out.u8(static_cast<std::uint8_t>(setting.session.value_or(0) << 6U));
        out.u16(setting.tag_population.value_or(kUsualTags));
        out.u32(0);
      });
    });
  });
}

void write_events(const std::set<std::uint16_t>& events, ByteWriter& out) {
  out.parameter(kReaderEventNotificationSpec, [&] {
    for (std::uint16_t kind = 0; kind <= kLastEvent; ++kind) {
      out.parameter(245, [&] {
        out.u16(kind);
        out.flag(events.count(kind) > 0);
      });
    }
  });
}

void write_keepalive(Duration keepalive, ByteWriter& out) {
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(keepalive).count();
  out.parameter(kKeepaliveSpec, [&] {
    out.u8(ms > 0 ? 1 : 0);
    out.u32(static_cast<std::uint32_t>(ms));
  });
}

/// The AISpec's antennas; all if 0 is among them.
std::vector<std::uint16_t> antennas_of(const AiSpec& spec, const Ports& ports) {
  if (std::find(spec.antennas.begin(), spec.antennas.end(), 0) == spec.antennas.end()) {
    return spec.antennas;
  }
  std::vector<std::uint16_t> all;
  for (std::size_t i = 1; i <= ports.antennas.size(); ++i) {
    all.push_back(static_cast<std::uint16_t>(i));
  }
  return all;
}

/// Q for this many tags: at least as many slots.
int q_for(std::uint16_t tags) {
  int q = 0;
  while (q < 15 && (1U << static_cast<unsigned>(q)) < tags) ++q;
  return q;
}

void require_antenna(std::uint16_t id, const Ports& ports) {
  if (id <= ports.antennas.size()) return;
  throw Fault(Status::kFieldError, fmt::format("there is no antenna {}", id));
}

std::optional<double> power_at(std::optional<std::uint16_t> index, const Ports& ports) {
  if (!index) return std::nullopt;
  const std::vector<double> powers = powers_of(ports);
  if (*index == 0 || *index > powers.size()) {
    throw Fault(Status::kFieldError, fmt::format("there is no transmit power {}", *index));
  }
  // In the paper's model it is the only one, and has no effect.
  return powers.size() > 1 ? std::optional(powers[*index - 1U]) : std::nullopt;
}

void set_inventory(const AntennaSetting& setting, ReaderDuty& duty) {
  if (setting.session) duty.session = static_cast<Session>(*setting.session);
  if (setting.tag_population) duty.start_q = q_for(*setting.tag_population);
  if (setting.asks_for_b) duty.target = *setting.asks_for_b ? Target::kB : Target::kA;
  const std::uint16_t search = setting.search_mode.value_or(0);
  if (search == kSingleTarget || search == kFocus) duty.target = Target::kA;
  if (search == kDualTarget) duty.target = Target::kAlternate;
  if (search == kFocus) duty.session = Session::kS1;
}

const RfMode& mode_at(std::uint16_t index) {
  const RfMode* const mode = find_mode(index);
  if (mode != nullptr) return *mode;
  throw Fault(Status::kFieldError, fmt::format("there is no RF mode {}", index));
}

void set_mode(const AntennaSetting& setting, const RadioModel* model, ReaderDuty& duty) {
  if (!setting.mode_index) return;
  duty.link = mode_at(*setting.mode_index).link;
  if (duty.link && model != nullptr && model->gen2) {
    duty.link->epc_bits = model->gen2->link.epc_bits;
  }
}

void require_channel(std::uint16_t channel, const std::vector<double>& channels) {
  if (channel > 0 && channel <= channels.size()) return;
  throw Fault(Status::kFieldError, fmt::format("there is no channel {}", channel));
}

void set_channels(const AntennaSetting& setting, const Ports& ports, const RadioModel* model,
                  ReaderDuty& duty) {
  const std::vector<double> channels = channels_of(ports);
  std::vector<std::uint16_t> wanted = setting.fixed_channels;
  if (wanted.empty() && !hops(ports) && channels.size() > 1 &&
      setting.channel_index.value_or(0) > 0) {
    wanted = {*setting.channel_index};
  }
  if (wanted.empty()) return;
  ChannelPlan plan = model != nullptr ? model->plan : fixed_plan(channels.front());
  plan.carriers_hz.clear();
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (const std::uint16_t channel : wanted) {
    require_channel(channel, channels);
    plan.carriers_hz.push_back(channels[channel - 1U]);
  }
  duty.plan = std::move(plan);
}

/// Throws Fault if the reader's tables lack an entry that the setting names.
void check_setting(const AntennaSetting& setting, const Ports& ports) {
  power_at(setting.power_index, ports);
  if (setting.mode_index) mode_at(*setting.mode_index);
  const std::vector<double> channels = channels_of(ports);
  for (const std::uint16_t channel : setting.fixed_channels) require_channel(channel, channels);
  if (hops(ports)) {
    // The channel is ignored (§12.2.6.2).
    if (setting.hop_table.value_or(kHopTable) == kHopTable) return;
    throw Fault(Status::kFieldError, fmt::format("there is no hop table {}", *setting.hop_table));
  }
  // The hop table is ignored, and without a channel the reader chooses.
  const std::uint16_t channel = setting.channel_index.value_or(0);
  if (channel > 0) require_channel(channel, channels);
}

/// Same for the settings of several antennas.
void check_settings(const AntennaSettings& settings, const Ports& ports) {
  for (const auto& [id, setting] : settings) {
    require_antenna(id, ports);
    check_setting(setting, ports);
  }
}

}  // namespace

ReaderConfiguration configured(const ReaderConfiguration& before, const Ports& ports,
                               ByteReader message) {
  const bool resets = (message.u8() & 0x80U) != 0;
  ReaderConfiguration configuration = resets ? ReaderConfiguration{} : before;
  for (const Parameter& parameter : parameters_of(message))
    read_parameter(parameter, configuration);
  check_settings(configuration.antennas, ports);
  return configuration;
}

void write_configuration(const ReaderConfiguration& configuration, const std::string& name,
                         const Ports& ports, ByteReader message, ByteWriter& out) {
  const std::uint16_t antenna = message.u16();
  const std::uint8_t requested = message.u8();
  if (requested > 11) throw Fault(Status::kFieldError, "the requested data must be from 0 to 11");
  require_antenna(antenna, ports);
  const auto is_asked = [&](std::uint8_t part) { return requested == 0 || requested == part; };
  const auto for_each_antenna = [&](const std::function<void(std::uint16_t)>& write) {
    for (std::size_t i = 1; i <= ports.antennas.size(); ++i) {
      if (antenna == 0 || antenna == i) write(static_cast<std::uint16_t>(i));
    }
  };
  if (is_asked(1)) write_identification(name, out);
  if (is_asked(2)) {
    for_each_antenna([&](std::uint16_t id) { write_properties(ports.antennas[id - 1U], id, out); });
  }
  if (is_asked(3)) {
    for_each_antenna([&](std::uint16_t id) {
      write_antenna(setting_of(configuration, {}, id), ports, id, out);
    });
  }
  if (is_asked(5)) write_events(configuration.events, out);
  if (is_asked(4)) write_report_spec(configuration.report, out);
  if (is_asked(6)) {
    out.parameter(kAccessReportSpec,
                  [&] { out.u8(static_cast<std::uint8_t>(configuration.access_report)); });
  }
  if (is_asked(7)) out.parameter(217, [&] { out.u32(0); });
  if (is_asked(8)) write_keepalive(configuration.keepalive, out);
  if (is_asked(11)) {
    out.parameter(kEventsAndReports, [&] { out.flag(configuration.holds_reports); });
  }
}

AntennaSetting setting_of(const ReaderConfiguration& configuration, const AntennaSettings& over,
                          std::uint16_t antenna) {
  AntennaSetting setting;
  for (const AntennaSettings* settings : {&configuration.antennas, &over}) {
    for (const std::uint16_t id : {std::uint16_t{0}, antenna}) {
      const auto found = settings->find(id);
      if (found != settings->end()) merge(found->second, setting);
    }
  }
  return setting;
}

ReaderDuty duty_of(const ReaderConfiguration& configuration, const Ports& ports,
                   const AiSpec& spec) {
  check_settings(spec.settings, ports);
  ReaderDuty duty;
  const std::vector<std::uint16_t> ids = antennas_of(spec, ports);
  for (const std::uint16_t id : ids) {
    require_antenna(id, ports);
    if (ports.is_empty[id - 1U]) continue;
    duty.antennas.push_back(
        {ports.antennas[id - 1U].spec.parameters.name,
         power_at(setting_of(configuration, spec.settings, id).power_index, ports)});
  }
  if (ids.empty()) return duty;
  const AntennaSetting setting = setting_of(configuration, spec.settings, ids.front());
  const RadioModel* const model = physical(ports.antennas[ids.front() - 1U].spec.parameters);
  set_inventory(setting, duty);
  set_mode(setting, model, duty);
  set_channels(setting, ports, model, duty);
  return duty;
}

}  // namespace tagfield::llrp
