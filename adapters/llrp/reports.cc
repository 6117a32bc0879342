// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/reports.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield::llrp {
namespace {

/// More than any reader's buffer holds; reports are then sent regardless of the trigger.
constexpr std::size_t kMaxGathered = 10'000;
constexpr double kPhaseSteps = 4096.0;

std::int16_t clamped(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
}

std::uint16_t phase_step(double phase_rad) {
  const double falling = wrap_to_two_pi(-phase_rad);
  return static_cast<std::uint16_t>(std::lround(falling / (2.0 * kPi) * kPhaseSteps) % 4096);
}

void write_epc(const Words& epc, ByteWriter& writer) {
  const auto words = [&] {
    for (const std::uint16_t word : epc) writer.u16(word);
  };
  if (epc.size() == 6) {
    writer.fixed(13);
    words();
    return;
  }
  writer.parameter(241, [&] {
    writer.u16(static_cast<std::uint16_t>(epc.size() * 16));
    words();
  });
}

void write_selected(const TagReport& report, const ReportSpec& spec, ByteWriter& writer) {
  if (spec.ro_spec) {
    writer.fixed(9);
    writer.u32(report.ro_spec);
  }
  if (spec.spec_index) {
    writer.fixed(14);
    writer.u16(report.spec_index);
  }
  if (spec.inventory_spec) {
    writer.fixed(10);
    writer.u16(report.inventory_spec);
  }
  if (spec.antenna) {
    writer.fixed(1);
    writer.u16(report.antenna);
  }
  if (spec.peak_rssi) {
    writer.fixed(6);
    const double dbm = std::clamp(report.peak_rssi_dbm, -128.0, 127.0);
    writer.u8(static_cast<std::uint8_t>(static_cast<std::int8_t>(std::lround(dbm))));
  }
  if (spec.channel) {
    writer.fixed(7);
    writer.u16(report.channel);
  }
  if (spec.first_seen) {
    writer.fixed(2);
    writer.u64(report.first_us);
  }
  if (spec.last_seen) {
    writer.fixed(4);
    writer.u64(report.last_us);
  }
  if (spec.seen_count) {
    writer.fixed(8);
    writer.u16(report.seen);
  }
}

void write_impinj(const TagReport& report, const ReportSpec& spec, ByteWriter& writer) {
  if (spec.phase) writer.custom(kImpinj, 56, [&] { writer.u16(phase_step(report.phase_rad)); });
  if (spec.fine_rssi) {
    writer.custom(kImpinj, 57, [&] { writer.s16(clamped(report.peak_rssi_dbm * 100.0)); });
  }
  if (spec.doppler && report.doppler_hz) {
    writer.custom(kImpinj, 68, [&] { writer.s16(clamped(*report.doppler_hz * 16.0)); });
  }
}

}  // namespace

void write_report(const TagReport& report, const ReportSpec& spec, ByteWriter& writer) {
  writer.parameter(240, [&] {
    write_epc(report.epc, writer);
    write_selected(report, spec, writer);
    if (spec.crc) {
      writer.fixed(11);
      writer.u16(report.crc);
    }
    if (spec.pc) {
      writer.fixed(12);
      writer.u16(report.pc);
    }
    if (spec.access_spec && report.access_spec != 0) {
      writer.fixed(16);
      writer.u32(report.access_spec);
    }
    writer.bytes(report.op_results);
    write_impinj(report, spec, writer);
  });
}

void ReportGathering::add(const TagReport& report) {
  const auto selected = [](bool is, std::uint16_t value) { return is ? value : std::uint16_t{0}; };
  const Key key(report.epc, selected(spec_.antenna, report.antenna),
                selected(spec_.channel, report.channel),
                selected(spec_.spec_index, report.spec_index),
                selected(spec_.inventory_spec, report.inventory_spec));
  const auto found = places_.find(key);
  if (found == places_.end() || !report.op_results.empty()) {
    if (report.op_results.empty()) places_[key] = reports_.size();
    reports_.push_back(report);
    return;
  }
  TagReport& same = reports_[found->second];
  same.last_us = report.last_us;
  same.peak_rssi_dbm = std::max(same.peak_rssi_dbm, report.peak_rssi_dbm);
  same.phase_rad = report.phase_rad;
  same.doppler_hz = report.doppler_hz;
  if (same.seen < 0xffff) ++same.seen;
}

bool ReportGathering::is_full() const {
  const bool counts = spec_.trigger != 0 && spec_.n > 0;
  return reports_.size() >= (counts ? std::size_t{spec_.n} : kMaxGathered);
}

std::vector<Bytes> ReportGathering::take() {
  std::vector<Bytes> all;
  all.reserve(reports_.size());
  for (const TagReport& report : reports_) {
    ByteWriter writer;
    write_report(report, spec_, writer);
    all.push_back(writer.written());
  }
  reports_.clear();
  places_.clear();
  return all;
}

}  // namespace tagfield::llrp
