// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a client sets a reader to, as opposed to what it has it do.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "adapters/llrp/capabilities.h"
#include "adapters/llrp/specs.h"
#include "tagfield/base/time.h"
#include "tagfield/live/reader_duty.h"

namespace tagfield::llrp {

/// As SET_READER_CONFIG sets it; what it begins with is as after a reset.
struct ReaderConfiguration {
  AntennaSettings antennas;
  ReportSpec report;
  std::set<std::uint16_t> events;  ///< Kinds of §13.1.6.1 that are told.
  Duration keepalive{};            ///< 0 for none.
  bool holds_reports = false;      ///< Of a time without a client, until the next one asks.
  std::uint8_t access_report = 0;
};

/// After a SET_READER_CONFIG. Throws Fault where something in it can't be set.
ReaderConfiguration configured(const ReaderConfiguration& before, ByteReader message);

/// What a GET_READER_CONFIG asks for, of the reader `name`. Throws Fault.
void write_configuration(const ReaderConfiguration& configuration, const std::string& name,
                         const Ports& ports, ByteReader message, ByteWriter& out);

/// An antenna's settings: those of `over` above those of the configuration, its own above those of
/// all.
AntennaSetting setting_of(const ReaderConfiguration& configuration, const AntennaSettings& over,
                          std::uint16_t antenna);

/// What the world's reader is to do for an AISpec: its antennas, their powers, and of the first of
/// them session, Q, RF mode and channels. Throws Fault where a table has no such entry.
ReaderDuty duty_of(const ReaderConfiguration& configuration, const Ports& ports,
                   const AiSpec& spec);

}  // namespace tagfield::llrp
