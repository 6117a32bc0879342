// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/capabilities.h"

#include <algorithm>
#include <cmath>

#include "adapters/llrp/rf_modes.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield::llrp {
namespace {

// That of a common four-port reader, so that clients use the vendor's extension.
constexpr std::uint32_t kModel = 2001002;
constexpr const char* kFirmware = "tagfield";
constexpr double kPaperPower_dbm = 30.0;
// Codes of §16.2.4: the United States and the FCC, Germany and ETSI, unspecified.
constexpr std::uint16_t kUnitedStates = 840;
constexpr std::uint16_t kGermany = 276;
constexpr std::uint16_t kFcc = 1;
constexpr std::uint16_t kEtsi = 2;

const RadioModel* model_of(const Ports& ports) {
  for (const LiveAntenna& antenna : ports.antennas) {
    if (const RadioModel* const model = physical(antenna.spec.parameters)) return model;
  }
  return nullptr;
}

void write_device(const Ports& ports, ByteWriter& writer) {
  writer.parameter(137, [&] {
    writer.u16(static_cast<std::uint16_t>(ports.antennas.size()));
    writer.u16(0x4000);  // has a clock; antennas' properties can't be set
    writer.u32(kImpinj);
    writer.u32(kModel);
    writer.text(kFirmware);
    writer.parameter(139, [&] {
      writer.u16(1);
      writer.s16(0);
    });
    writer.parameter(141, [&] {
      writer.u16(0);
      writer.u16(0);
    });
    for (std::size_t i = 1; i <= ports.antennas.size(); ++i) {
      writer.parameter(140, [&] {
        writer.u16(static_cast<std::uint16_t>(i));
        writer.u16(1);
        writer.u8(1);
      });
    }
  });
}

void write_llrp(ByteWriter& writer) {
  writer.parameter(142, [&] {
    writer.u8(0x48);  // reports buffer fill levels, and holds reports on request
    writer.u8(7);
    writer.u16(0);
    writer.u32(kMaxRoSpecs);
    writer.u32(kMaxAiSpecs);
    writer.u32(1);  // InventoryParameterSpec per AISpec
    writer.u32(kMaxAccessSpecs);
    writer.u32(kMaxOpSpecs);
  });
}

std::uint32_t to_khz(double hz) { return static_cast<std::uint32_t>(std::lround(hz / 1e3)); }

void write_frequencies(const Ports& ports, ByteWriter& writer) {
  const std::vector<double> channels = channels_of(ports);
  const auto write_channels = [&] {
    writer.u16(static_cast<std::uint16_t>(channels.size()));
    for (const double hz : channels) writer.u32(to_khz(hz));
  };
  writer.parameter(146, [&] {
    writer.flag(hops(ports));
    if (hops(ports)) {
      writer.parameter(147, [&] {
        writer.u8(1);
        writer.u8(0);
        write_channels();
      });
    } else {
      writer.parameter(148, write_channels);
    }
  });
}

void write_mode(const RfMode& mode, const LinkSettings& link, ByteWriter& writer) {
  const auto cycles = static_cast<unsigned>(link.encoding);
  const auto tari_ns = static_cast<std::uint32_t>(std::lround(link.tari_s * 1e9));
  unsigned encoding = 0;
  while (1U << encoding < cycles) ++encoding;
  writer.parameter(329, [&] {
    writer.u32(mode.id);
    writer.flag(link.divide_ratio == DivideRatio::k64_3);
    writer.u8(static_cast<std::uint8_t>(encoding));
    writer.u8(0);
    writer.u8(encoding < 2 ? 2 : 3);
    writer.u32(static_cast<std::uint32_t>(std::lround(link.blf_hz / cycles)));
    writer.u32(static_cast<std::uint32_t>(std::lround(link.data1_tari * 1e3)));
    writer.u32(tari_ns);
    writer.u32(tari_ns);
    writer.u32(0);
  });
}

void write_regulation(const Ports& ports, ByteWriter& writer) {
  const RadioModel* const model = model_of(ports);
  const std::string plan = model != nullptr ? model->plan.name : "";
  const bool is_fcc = plan == "fcc";
  const bool is_etsi = plan.rfind("etsi", 0) == 0;
  writer.parameter(143, [&] {
    writer.u16(is_fcc ? kUnitedStates : is_etsi ? kGermany : std::uint16_t{0});
    writer.u16(is_fcc ? kFcc : is_etsi ? kEtsi : std::uint16_t{0});
    writer.parameter(144, [&] {
      std::uint16_t index = 0;
      for (const double dbm : powers_of(ports)) {
        writer.parameter(145, [&] {
          writer.u16(++index);
          writer.s16(static_cast<std::int16_t>(std::lround(dbm * 100.0)));
        });
      }
      write_frequencies(ports, writer);
      const LinkSettings own = model != nullptr && model->gen2 ? model->gen2->link : LinkSettings{};
      writer.parameter(328, [&] {
        for (const RfMode& mode : rf_modes()) write_mode(mode, mode.link.value_or(own), writer);
      });
    });
  });
}

void write_gen2(ByteWriter& writer) {
  writer.parameter(327, [&] {
    writer.u8(0xc0);  // erases and writes blocks
    writer.u16(kMaxFilters);
  });
}

}  // namespace

std::uint16_t Ports::id_of(const std::string& antenna) const {
  for (std::size_t i = 0; i < antennas.size(); ++i) {
    if (antennas[i].spec.parameters.name == antenna) return static_cast<std::uint16_t>(i + 1);
  }
  return 0;
}

Ports ports_of(const LiveWorld& world, const std::string& reader, const Ports& before) {
  Ports ports = before;
  for (LiveAntenna& antenna : ports.antennas) antenna.is_faulty = true;
  ports.is_empty.assign(ports.antennas.size(), true);
  for (const LiveAntenna& antenna : world.antennas()) {
    if (antenna.spec.parameters.reader != reader) continue;
    const auto place = static_cast<std::size_t>(antenna.port - 1);
    if (place >= ports.antennas.size()) {
      // An antenna that was added and removed between two checks never existed for clients.
      LiveAntenna none = antenna;
      none.spec.parameters.name.clear();
      none.is_faulty = true;
      ports.antennas.resize(place + 1, none);
      ports.is_empty.resize(place + 1, true);
    }
    ports.antennas[place] = antenna;
    ports.is_empty[place] = false;
  }
  return ports;
}

std::vector<double> powers_of(const Ports& ports) {
  double max_dbm = 0.0;
  bool any = false;
  for (const LiveAntenna& antenna : ports.antennas) {
    const auto dbm = transmit_power_dbm(antenna.spec.parameters);
    if (!dbm) continue;
    max_dbm = any ? std::max(max_dbm, *dbm) : *dbm;
    any = true;
  }
  return any ? power_table(max_dbm) : std::vector<double>{kPaperPower_dbm};
}

std::vector<double> channels_of(const Ports& ports) {
  if (const RadioModel* const model = model_of(ports)) return model->plan.carriers_hz;
  if (ports.antennas.empty()) return {};
  return {nominal_frequency_hz(ports.antennas.front().spec.parameters)};
}

bool hops(const Ports& ports) {
  const RadioModel* const model = model_of(ports);
  return model != nullptr && model->plan.carriers_hz.size() > 1 && model->effects.hopping &&
         model->plan.name.rfind("etsi", 0) != 0;
}

void write_capabilities(const Ports& ports, std::uint8_t requested, ByteWriter& writer) {
  const auto is_asked = [&](std::uint8_t part) { return requested == 0 || requested == part; };
  if (is_asked(1)) write_device(ports, writer);
  if (is_asked(2)) write_llrp(writer);
  if (is_asked(3)) write_regulation(ports, writer);
  if (is_asked(4)) write_gen2(writer);
}

}  // namespace tagfield::llrp
