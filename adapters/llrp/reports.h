// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reports of reads: accumulated as the report specification requires, and encoded.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "adapters/llrp/specs.h"
#include "tagfield/gen2/memory_banks.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield::llrp {

/// One TagReportData (§14.2.3).
struct TagReport {
  Words epc;
  std::uint16_t pc = 0;
  std::uint16_t crc = 0;
  std::uint32_t ro_spec = 0;
  std::uint16_t spec_index = 0;
  std::uint16_t inventory_spec = 0;
  std::uint16_t antenna = 0;
  std::uint16_t channel = 0;
  double peak_rssi_dbm = 0.0;
  double phase_rad = 0.0;  ///< Of the last read, increasing with distance as in TagRead.
  std::optional<double> doppler_hz;
  std::uint64_t first_us = 0;  ///< UTC.
  std::uint64_t last_us = 0;
  std::uint16_t seen = 1;
  std::uint32_t access_spec = 0;
  Bytes op_results;  ///< Encoded parameters, one after the other.
};

/// Writes only the contents that `spec` selects. The vendor's phase decreases with distance, as
/// reported by its readers: 4096 steps per cycle.
void write_report(const TagReport& report, const ReportSpec& spec, ByteWriter& writer);

/// Accumulates reads of one ROSpec until they are to be sent.
class ReportGathering {
 public:
  explicit ReportGathering(const ReportSpec& spec) : spec_(spec) {}

  /// Reads that agree in all selected fields that don't accumulate are merged into one report,
  /// except for reads with results of operations.
  void add(const TagReport& report);
  /// Whether there are `n` reports.
  [[nodiscard]] bool is_full() const;
  /// Removes all reports and returns them encoded.
  std::vector<Bytes> take();
  [[nodiscard]] const ReportSpec& spec() const { return spec_; }

 private:
  using Key = std::tuple<Words, std::uint16_t, std::uint16_t, std::uint16_t, std::uint16_t>;
  ReportSpec spec_;
  std::vector<TagReport> reports_;
  std::map<Key, std::size_t> places_;
};

}  // namespace tagfield::llrp
