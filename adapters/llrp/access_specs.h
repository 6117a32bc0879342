// SPDX-License-Identifier: Apache-2.0
/// @file
/// AccessSpecs of a reader: which operations it executes on tags that it has singulated, and the
/// reports of those that are only sent when the AccessSpec ends.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "adapters/llrp/capabilities.h"
#include "adapters/llrp/reports.h"
#include "adapters/llrp/specs.h"
#include "adapters/llrp/tag_store.h"
#include "adapters/llrp/wire.h"

namespace tagfield::llrp {

/// An AccessSpec and its state.
struct AccessEntry {
  AccessSpec spec;
  bool is_enabled = false;
  std::uint16_t done = 0;        ///< Executions.
  std::vector<Bytes> results{};  ///< TagReportData to be sent when it ends.
};

/// Those that a client has added, by ID.
class AccessSpecs {
 public:
  /// Adds that of ADD_ACCESSSPEC. Throws Fault if it can't be executed.
  void add(const Message& message, const Ports& ports);
  /// Enables, disables or deletes one, or all (ID 0). Returns what those that end have to report.
  /// Throws Fault if there is none of this ID.
  std::vector<Bytes> change(const Message& message);
  void write_all(ByteWriter& out) const;

  /// The AccessSpec for the tag that has been singulated, or null.
  AccessEntry* for_tag(const TagReport& report, const MemoryBanks& tag);
  /// After an execution, deletes the AccessSpec if that was the last of its operations. One without
  /// a number of operations ends with each execution, as far as its reports are concerned. Returns
  /// what it has to report.
  std::vector<Bytes> end_if_done(AccessEntry& entry);
  /// Removes all results and returns them.
  std::vector<Bytes> take_results();

 private:
  std::map<std::uint32_t, AccessEntry> entries_;
};

/// Executes the operations on the tag, and adds their results to its report.
void execute(AccessEntry& entry, MemoryBanks& tag, TagReport& report);

}  // namespace tagfield::llrp
