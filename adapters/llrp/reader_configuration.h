// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reader configuration set by clients, as opposed to the operations that they start.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "adapters/llrp/capabilities.h"
#include "adapters/llrp/specs.h"
#include "tagfield/base/time.h"
#include "tagfield/live/reader_duty.h"

namespace tagfield::llrp {

/// As set by SET_READER_CONFIG; default values are those after a reset.
struct ReaderConfiguration {
  AntennaSettings antennas;
  ReportSpec report;
  std::set<std::uint16_t> events;  ///< Kinds of §13.1.6.1 that are reported.
  Duration keepalive{};            ///< 0 for none.
  bool holds_reports = false;      ///< After a reconnection, until the client requests them.
  AccessReportAt access_report = AccessReportAt::kRoReport;
};

/// The configuration of a reader with these ports after a SET_READER_CONFIG. Throws Fault if
/// something in it can't be set.
ReaderConfiguration configured(const ReaderConfiguration& before, const Ports& ports,
                               ByteReader message);

/// Response to a GET_READER_CONFIG for the reader `name`. Throws Fault.
void write_configuration(const ReaderConfiguration& configuration, const std::string& name,
                         const Ports& ports, ByteReader message, ByteWriter& out);

/// An antenna's settings: `over` takes precedence over the configuration, and settings of a single
/// antenna over those of all.
AntennaSetting setting_of(const ReaderConfiguration& configuration, const AntennaSettings& over,
                          std::uint16_t antenna);

/// The duty of the world's reader for an AISpec: its antennas, their powers, and session, Q, RF
/// mode and channels of the first of them. Throws Fault if a table has no such entry.
ReaderDuty duty_of(const ReaderConfiguration& configuration, const Ports& ports,
                   const AiSpec& spec);

}  // namespace tagfield::llrp
