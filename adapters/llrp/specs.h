// SPDX-License-Identifier: Apache-2.0
/// @file
/// Specifications from clients: ROSpecs, AccessSpecs, configuration.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adapters/llrp/wire.h"
#include "tagfield/base/time.h"

namespace tagfield::llrp {

/// Impinj's private enterprise number, which identifies its extension.
inline constexpr std::uint32_t kImpinj = 25882;

/// Parameter types used in several source files (§16.3).
enum ParameterType : std::uint16_t {
  kUtcTimestamp = 128,
  kRoSpec = 177,
  kAccessSpec = 207,
  kAntennaConfiguration = 222,
  kEventsAndReports = 226,
  kRoReportSpec = 237,
  kAccessReportSpec = 239,
  kReaderEventNotificationSpec = 244,
  kKeepaliveSpec = 220,
  kCustomParameter = 1023,
};

/// Limits, which the capabilities state.
inline constexpr std::size_t kMaxRoSpecs = 32;
inline constexpr std::size_t kMaxAiSpecs = 64;  ///< Per ROSpec.
inline constexpr std::size_t kMaxAccessSpecs = 1024;
inline constexpr std::size_t kMaxOpSpecs = 16;  ///< Per AccessSpec.
inline constexpr std::size_t kMaxFilters = 8;   ///< Per antenna.

/// Throws Fault if there are `count` already, of at most `most`.
void require_room(std::size_t count, std::size_t most, const char* what);

/// A pattern to compare with bits of a tag's memory.
struct MemoryMask {
  unsigned bank = 1;
  std::uint16_t pointer = 0;  ///< First bit.
  std::uint16_t count = 0;    ///< Bits.
  Bytes mask;                 ///< Which bits are compared; all if from a Select.
  Bytes data;
  bool match = true;  ///< If false, tags that differ match.
};

/// A state-unaware Select (§15.2.1.2.1.1): determines which tags take part.
struct TagFilter {
  MemoryMask mask;
  std::uint8_t action = 0;
};

/// AntennaConfiguration (§12.2.6); missing values stay unchanged.
struct AntennaSetting {
  std::optional<std::uint16_t> power_index;
  std::optional<std::uint16_t> hop_table;
  std::optional<std::uint16_t> channel_index;
  std::optional<std::uint16_t> mode_index;
  std::optional<std::uint8_t> session;
  std::optional<std::uint16_t> tag_population;
  std::optional<std::uint16_t> search_mode;   ///< Impinj's: 1 single, 2 dual target, 3 focus.
  std::optional<bool> asks_for_b;             ///< State B in state-aware singulation.
  std::vector<std::uint16_t> fixed_channels;  ///< Impinj's list, from 1 on.
  std::optional<std::vector<TagFilter>> filters;
};
/// Overrides `setting` with the values in `over`.
void merge(const AntennaSetting& over, AntennaSetting& setting);

/// Settings by antenna ID; 0 means all.
using AntennaSettings = std::map<std::uint16_t, AntennaSetting>;

enum class StopAt : std::uint8_t { kNull = 0, kDuration = 1, kGpi = 2, kTagObservation = 3 };

struct AiSpec {
  std::vector<std::uint16_t> antennas;  ///< 0: all.
  StopAt stop = StopAt::kNull;
  Duration duration{};
  std::uint8_t observation = 0;  ///< 0: until N tags are seen; 1: until no new one is for T.
  std::uint16_t tags = 0;
  Duration quiet{};    ///< Its T.
  Duration timeout{};  ///< 0 for none.
  std::uint16_t inventory_spec = 0;
  AntennaSettings settings;
};

/// Contents of a report (§14.2.1), and when it is sent.
struct ReportSpec {
  std::uint8_t trigger = 2;  ///< 0 none, 1 N tags or end of AISpec, 2 or end of ROSpec.
  std::uint16_t n = 0;       ///< 0 for no limit.
  bool ro_spec = true, spec_index = true, inventory_spec = true, antenna = true, channel = true,
       peak_rssi = true, first_seen = true, last_seen = true, seen_count = true, access_spec = true;
  bool crc = false, pc = false;
  bool phase = false, fine_rssi = false, doppler = false;  ///< Impinj's.
};

enum class StartAt : std::uint8_t { kNull = 0, kImmediate = 1, kPeriodic = 2, kGpi = 3 };

struct RoSpec {
  std::uint32_t id = 0;
  std::uint8_t priority = 0;  ///< 0 to 7; 0 is the highest.
  StartAt start = StartAt::kNull;
  Duration offset{};
  Duration period{};
  std::optional<std::uint64_t> start_utc_us;
  StopAt stop = StopAt::kNull;
  Duration duration{};
  std::vector<AiSpec> specs;
  std::optional<ReportSpec> report;
  Bytes whole;  ///< The parameter as received.
};

enum class OpKind { kRead, kWrite, kKill, kLock, kBlockErase, kBlockWrite };

struct LockRequest {
  std::uint8_t privilege = 0;  ///< 0 read and write, 1 permalock, 2 permaunlock, 3 unlock.
  std::uint8_t field = 0;      ///< 0 kill, 1 access password, 2 EPC, 3 TID, 4 user memory.
};

struct OpSpec {
  OpKind kind = OpKind::kRead;
  std::uint16_t id = 0;
  std::uint32_t password = 0;
  unsigned bank = 0;
  std::uint16_t pointer = 0;  ///< Word.
  std::uint16_t count = 0;    ///< Words to read or to erase.
  std::vector<std::uint16_t> words;
  std::vector<LockRequest> locks;
};

/// When results of operations are reported (§14.2.2).
enum class AccessReportAt : std::uint8_t { kRoReport = 0, kEndOfAccessSpec = 1 };

struct AccessSpec {
  std::uint32_t id = 0;
  std::uint16_t antenna = 0;        ///< 0: all.
  std::uint32_t ro_spec = 0;        ///< 0: all.
  std::uint16_t operations = 0;     ///< Number after which it is deleted; 0 for never.
  std::vector<MemoryMask> targets;  ///< All must match.
  std::vector<OpSpec> ops;
  std::optional<AccessReportAt> report;
  Bytes whole;
};

/// Decode the content of parameters, without their headers. Throw Fault.
RoSpec ro_spec_of(const Parameter& parameter);
AccessSpec access_spec_of(const Parameter& parameter);
ReportSpec report_spec_of(ByteReader content);
AccessReportAt access_report_of(ByteReader content);
/// Adds the setting in an AntennaConfiguration.
void read_antenna_setting(ByteReader content, AntennaSettings& settings);

void write_report_spec(const ReportSpec& spec, ByteWriter& writer);

}  // namespace tagfield::llrp
