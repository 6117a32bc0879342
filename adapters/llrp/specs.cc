// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/specs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

namespace tagfield::llrp {
namespace {

using std::chrono::milliseconds;

constexpr std::uint8_t kGen2 = 1;  ///< ProtocolID.

void require_field(bool holds, const std::string& what) {
  if (!holds) throw Fault(Status::kFieldError, what);
}

void require_at_most(std::size_t most, std::size_t count, const char* what) {
  if (count <= most) return;
  throw Fault(Status::kOverflowParameter, fmt::format("at most {} {}", most, what));
}

void require_no_gpi(bool asks) {
  if (asks)
    throw Fault(Status::kUnsupportedParameter, "this reader has no inputs to be triggered by");
}

TagFilter filter_of(ByteReader content) {
  content.u8();  // Truncation has no effect here.
  const std::vector<Parameter> inner = parameters_of(content);
  require_known(inner, {332, 333, 334});
  if (find(inner, 333)) {
    throw Fault(Status::kUnsupportedParameter, "filters by a tag's state are not supported");
  }
  TagFilter filter;
  ByteReader mask = require(inner, 332).content;
  filter.mask.bank = mask.u8() >> 6U;
  filter.mask.pointer = mask.u16();
  ByteReader::Bits bits = mask.bits();
  filter.mask.count = bits.count;
  filter.mask.data = std::move(bits.bytes);
  if (const auto action = find(inner, 334)) {
    ByteReader value = action->content;
    filter.action = value.u8();
    require_field(filter.action <= 5, "the filter's action must be from 0 to 5");
  }
  return filter;
}

/// Impinj's search mode and channels.
void read_impinj(ByteReader content, AntennaSetting& setting) {
  if (content.u32() != kImpinj) return;
  const std::uint32_t subtype = content.u32();
  if (subtype == 23) setting.search_mode = content.u16();
  if (subtype == 26) {
    const std::uint16_t mode = content.u16();
    content.u16();
    const std::vector<std::uint16_t> channels = content.u16_list();
    if (mode == 2) setting.fixed_channels = channels;
  }
}

void read_inventory_command(ByteReader content, AntennaSetting& setting) {
  const bool is_state_aware = (content.u8() & 0x80U) != 0;
  const std::vector<Parameter> inner = parameters_of(content);
  require_known(inner, {331, 335, 336});
  for (const Parameter& parameter : inner) {
    ByteReader value = parameter.content;
    if (parameter.type == 331) {
      if (!setting.filters) setting.filters.emplace();
      setting.filters->push_back(filter_of(value));
      require_at_most(kMaxFilters, setting.filters->size(), "filters per antenna");
    } else if (parameter.type == 335) {
      setting.mode_index = value.u16();
    } else if (parameter.type == 336) {
      setting.session = value.u8() >> 6U;
      setting.tag_population = value.u16();
      value.u32();  // The transit time has no effect.
      const auto action = find(parameters_of(value), 337);
      if (action && is_state_aware) {
        ByteReader flags = action->content;
        setting.asks_for_b = (flags.u8() & 0x80U) != 0;
      }
    } else {
      read_impinj(value, setting);
    }
  }
}

void read_stop(ByteReader content, AiSpec& spec) {
  const std::uint8_t type = content.u8();
  require_field(type <= 3, "an AISpec's stop trigger must be from 0 to 3");
  spec.stop = static_cast<StopAt>(type);
  spec.duration = milliseconds(content.u32());
  require_no_gpi(spec.stop == StopAt::kGpi);
  const auto observation = find(parameters_of(content), 185);
  if (spec.stop != StopAt::kTagObservation) return;
  if (!observation) throw Fault(Status::kMissingParameter, "parameter 185 is missing");
  ByteReader value = observation->content;
  spec.observation = value.u8();
  require_field(spec.observation <= 2, "a tag observation trigger must be from 0 to 2");
  if (spec.observation == 2) {
    throw Fault(Status::kUnsupportedParameter, "an AISpec can't be stopped after N attempts");
  }
  value.u8();
  spec.tags = value.u16();
  value.u16();  // Attempts.
  spec.quiet = milliseconds(value.u16());
  spec.timeout = milliseconds(value.u32());
}

AiSpec ai_spec_of(ByteReader content) {
  AiSpec spec;
  spec.antennas = content.u16_list();
  require_field(!spec.antennas.empty(), "an AISpec needs an antenna, or 0 for all");
  const std::set<std::uint16_t> different(spec.antennas.begin(), spec.antennas.end());
  require_field(different.size() == spec.antennas.size(), "an AISpec names an antenna twice");
  const std::vector<Parameter> inner = parameters_of(content);
  require_known(inner, {184, 186});
  read_stop(require(inner, 184).content, spec);
  bool has_inventory = false;
  for (const Parameter& parameter : inner) {
    if (parameter.type != 186) continue;
    require_field(!has_inventory, "an AISpec can have only one InventoryParameterSpec");
    has_inventory = true;
    ByteReader value = parameter.content;
    spec.inventory_spec = value.u16();
    require_field(spec.inventory_spec != 0, "an InventoryParameterSpec's ID can't be 0");
    require_field(value.u8() == kGen2, "the air protocol must be 1, EPC Gen2");
    for (const Parameter& setting : parameters_of(value)) {
      if (setting.type == kAntennaConfiguration) {
        read_antenna_setting(setting.content, spec.settings);
      }
    }
  }
  if (!has_inventory) throw Fault(Status::kMissingParameter, "parameter 186 is missing");
  return spec;
}

void read_boundary(ByteReader content, RoSpec& spec) {
  const std::vector<Parameter> inner = parameters_of(content);
  require_known(inner, {179, 182});
  ByteReader start = require(inner, 179).content;
  const std::uint8_t type = start.u8();
  require_field(type <= 3, "a ROSpec's start trigger must be from 0 to 3");
  spec.start = static_cast<StartAt>(type);
  require_no_gpi(spec.start == StartAt::kGpi);
  if (const auto periodic = find(parameters_of(start), 180)) {
    ByteReader value = periodic->content;
    spec.offset = milliseconds(value.u32());
    spec.period = milliseconds(value.u32());
    if (const auto utc = find(parameters_of(value), kUtcTimestamp)) {
      ByteReader stamp = utc->content;
      spec.start_utc_us = stamp.u64();
    }
  } else if (spec.start == StartAt::kPeriodic) {
    throw Fault(Status::kMissingParameter, "parameter 180 is missing");
  }
  ByteReader stop = require(inner, 182).content;
  const std::uint8_t stop_type = stop.u8();
  require_field(stop_type <= 2, "a ROSpec's stop trigger must be from 0 to 2");
  spec.stop = static_cast<StopAt>(stop_type);
  require_no_gpi(spec.stop == StopAt::kGpi);
  spec.duration = milliseconds(stop.u32());
}

/// Impinj's content selector.
void read_impinj_content(ByteReader content, ReportSpec& spec) {
  if (content.u32() != kImpinj || content.u32() != 50) return;
  for (const Parameter& parameter : parameters_of(content)) {
    if (parameter.type != kCustomParameter) continue;
    ByteReader value = parameter.content;
    if (value.u32() != kImpinj) continue;
    const std::uint32_t subtype = value.u32();
    if (subtype == 52) spec.phase = value.u16() != 0;
    if (subtype == 53) spec.fine_rssi = value.u16() != 0;
    if (subtype == 67) spec.doppler = value.u16() != 0;
  }
}

MemoryMask target_of(ByteReader content) {
  MemoryMask target;
  const std::uint8_t flags = content.u8();
  target.bank = flags >> 6U;
  target.match = (flags & 0x20U) != 0;
  target.pointer = content.u16();
  ByteReader::Bits mask = content.bits();
  ByteReader::Bits data = content.bits();
  target.count = std::min(mask.count, data.count);
  target.mask = std::move(mask.bytes);
  target.data = std::move(data.bytes);
  return target;
}

OpSpec op_of(const Parameter& parameter) {
  ByteReader content = parameter.content;
  OpSpec op;
  op.id = content.u16();
  op.password = content.u32();
  if (parameter.type == 343) {
    op.kind = OpKind::kKill;
    return op;
  }
  if (parameter.type == 344) {
    op.kind = OpKind::kLock;
    for (const Parameter& payload : parameters_of(content)) {
      if (payload.type != 345) continue;
      ByteReader value = payload.content;
      const LockRequest lock{value.u8(), value.u8()};
      require_field(lock.privilege <= 3 && lock.field <= 4,
                    "a lock's privilege is from 0 to 3, its field from 0 to 4");
      op.locks.push_back(lock);
    }
    if (op.locks.empty()) throw Fault(Status::kMissingParameter, "parameter 345 is missing");
    return op;
  }
  op.bank = content.u8() >> 6U;
  op.pointer = content.u16();
  const bool writes = parameter.type == 342 || parameter.type == 347;
  if (writes) {
    op.kind = parameter.type == 342 ? OpKind::kWrite : OpKind::kBlockWrite;
    op.words = content.u16_list();
    require_field(!op.words.empty(), "a write needs at least one word");
  } else {
    op.kind = parameter.type == 341 ? OpKind::kRead : OpKind::kBlockErase;
    op.count = content.u16();
  }
  return op;
}

void read_command(ByteReader content, AccessSpec& spec) {
  for (const Parameter& parameter : parameters_of(content)) {
    if (parameter.type == 338) {
      for (const Parameter& target : parameters_of(parameter.content)) {
        if (target.type == 339) spec.targets.push_back(target_of(target.content));
      }
    } else if (parameter.type == 341 || parameter.type == 342 || parameter.type == 343 ||
               parameter.type == 344 || parameter.type == 346 || parameter.type == 347) {
      spec.ops.push_back(op_of(parameter));
    } else if (parameter.type != kCustomParameter) {
      throw Fault(Status::kUnsupportedParameter,
                  fmt::format("operation {} is not supported", parameter.type));
    }
  }
  if (spec.ops.empty()) throw Fault(Status::kMissingParameter, "an AccessSpec needs an operation");
  require_at_most(kMaxOpSpecs, spec.ops.size(), "OpSpecs per AccessSpec");
}

template <class Value>
void take(const std::optional<Value>& over, std::optional<Value>& value) {
  if (over) value = over;
}

}  // namespace

void require_room(std::size_t count, std::size_t most, const char* what) {
  if (count < most) return;
  throw Fault(Status::kOverflowParameter, fmt::format("there are {} {} already", most, what));
}

void merge(const AntennaSetting& over, AntennaSetting& setting) {
  take(over.power_index, setting.power_index);
  take(over.hop_table, setting.hop_table);
  take(over.channel_index, setting.channel_index);
  take(over.mode_index, setting.mode_index);
  take(over.session, setting.session);
  take(over.tag_population, setting.tag_population);
  take(over.search_mode, setting.search_mode);
  take(over.asks_for_b, setting.asks_for_b);
  take(over.filters, setting.filters);
  if (!over.fixed_channels.empty()) setting.fixed_channels = over.fixed_channels;
}

void read_antenna_setting(ByteReader content, AntennaSettings& settings) {
  const std::uint16_t antenna = content.u16();
  const std::vector<Parameter> inner = parameters_of(content);
  require_known(inner, {223, 224, 330});
  AntennaSetting read;
  if (const auto transmitter = find(inner, 224)) {
    ByteReader value = transmitter->content;
    read.hop_table = value.u16();
    read.channel_index = value.u16();
    read.power_index = value.u16();
  }
  for (const Parameter& parameter : inner) {
    if (parameter.type == 330) read_inventory_command(parameter.content, read);
  }
  merge(read, settings[antenna]);
}

RoSpec ro_spec_of(const Parameter& parameter) {
  ByteReader content = parameter.content;
  RoSpec spec;
  spec.whole = parameter.whole;
  spec.id = content.u32();
  spec.priority = content.u8();
  require_field(spec.id != 0, "a ROSpec's ID can't be 0");
  require_field(spec.priority <= 7, "a ROSpec's priority must be from 0 to 7");
  require_field(content.u8() == 0, "a ROSpec that is added must be disabled");
  const std::vector<Parameter> inner = parameters_of(content);
  require_known(inner, {178, 183, kRoReportSpec});
  read_boundary(require(inner, 178).content, spec);
  for (const Parameter& each : inner) {
    if (each.type == 183) spec.specs.push_back(ai_spec_of(each.content));
  }
  if (spec.specs.empty()) throw Fault(Status::kMissingParameter, "parameter 183 is missing");
  require_at_most(kMaxAiSpecs, spec.specs.size(), "AISpecs per ROSpec");
  if (const auto report = find(inner, kRoReportSpec)) spec.report = report_spec_of(report->content);
  return spec;
}

ReportSpec report_spec_of(ByteReader content) {
  ReportSpec spec;
  spec.trigger = content.u8();
  require_field(spec.trigger <= 2, "a report's trigger must be from 0 to 2");
  spec.n = content.u16();
  const std::vector<Parameter> inner = parameters_of(content);
  require_known(inner, {238});
  ByteReader selector = require(inner, 238).content;
  const std::uint16_t bits = selector.u16();
  bool* const enabled[] = {
      &spec.ro_spec,   &spec.spec_index, &spec.inventory_spec, &spec.antenna,    &spec.channel,
      &spec.peak_rssi, &spec.first_seen, &spec.last_seen,      &spec.seen_count, &spec.access_spec};
  for (unsigned i = 0; i < std::size(enabled); ++i) *enabled[i] = (bits >> (15U - i) & 1U) != 0;
  if (const auto memory = find(parameters_of(selector), 348)) {
    ByteReader value = memory->content;
    const std::uint8_t flags = value.u8();
    spec.crc = (flags & 0x80U) != 0;
    spec.pc = (flags & 0x40U) != 0;
  }
  for (const Parameter& parameter : inner) {
    if (parameter.type == kCustomParameter) read_impinj_content(parameter.content, spec);
  }
  return spec;
}

AccessReportAt access_report_of(ByteReader content) {
  const std::uint8_t trigger = content.u8();
  require_field(trigger <= 1, "an access report's trigger must be 0 or 1");
  return static_cast<AccessReportAt>(trigger);
}

void write_report_spec(const ReportSpec& spec, ByteWriter& writer) {
  writer.parameter(kRoReportSpec, [&] {
    writer.u8(spec.trigger);
    writer.u16(spec.n);
    writer.parameter(238, [&] {
      const bool enabled[] = {spec.ro_spec,    spec.spec_index, spec.inventory_spec, spec.antenna,
                              spec.channel,    spec.peak_rssi,  spec.first_seen,     spec.last_seen,
                              spec.seen_count, spec.access_spec};
      std::uint16_t bits = 0;
      for (unsigned i = 0; i < std::size(enabled); ++i) {
        if (enabled[i]) bits = static_cast<std::uint16_t>(bits | 1U << (15U - i));
      }
      writer.u16(bits);
      writer.parameter(348, [&] {
        writer.u8(static_cast<std::uint8_t>((spec.crc ? 0x80U : 0U) | (spec.pc ? 0x40U : 0U)));
      });
    });
    if (!spec.phase && !spec.fine_rssi && !spec.doppler) return;
    writer.custom(kImpinj, 50, [&] {
      writer.custom(kImpinj, 52, [&] { writer.u16(spec.phase ? 1 : 0); });
      writer.custom(kImpinj, 53, [&] { writer.u16(spec.fine_rssi ? 1 : 0); });
      writer.custom(kImpinj, 67, [&] { writer.u16(spec.doppler ? 1 : 0); });
    });
  });
}

AccessSpec access_spec_of(const Parameter& parameter) {
  ByteReader content = parameter.content;
  AccessSpec spec;
  spec.whole = parameter.whole;
  spec.id = content.u32();
  spec.antenna = content.u16();
  require_field(spec.id != 0, "an AccessSpec's ID can't be 0");
  require_field(content.u8() == kGen2, "the air protocol must be 1, EPC Gen2");
  require_field((content.u8() & 0x80U) == 0, "an AccessSpec that is added must be disabled");
  spec.ro_spec = content.u32();
  const std::vector<Parameter> inner = parameters_of(content);
  require_known(inner, {208, 209, kAccessReportSpec});
  ByteReader stop = require(inner, 208).content;
  const std::uint8_t type = stop.u8();
  require_field(type <= 1, "an AccessSpec's stop trigger must be 0 or 1");
  const std::uint16_t count = stop.u16();
  spec.operations = type == 1 ? count : 0;
  read_command(require(inner, 209).content, spec);
  if (const auto report = find(inner, kAccessReportSpec)) {
    spec.report = access_report_of(report->content);
  }
  return spec;
}

}  // namespace tagfield::llrp
