// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/access_specs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "adapters/llrp/report_queue.h"

namespace tagfield::llrp {
namespace {

// Messages (§16.3).
constexpr std::uint16_t kDeleteAccessSpec = 41;
constexpr std::uint16_t kEnableAccessSpec = 42;

void append(std::vector<Bytes> some, std::vector<Bytes>& all) {
  for (Bytes& one : some) all.push_back(std::move(one));
}

}  // namespace

void AccessSpecs::add(const Message& message, const Ports& ports) {
  const AccessSpec spec = access_spec_of(only_parameter(message, kAccessSpec));
  if (entries_.count(spec.id) > 0) {
    throw Fault(Status::kFieldError, fmt::format("there is an AccessSpec {} already", spec.id));
  }
  require_room(entries_.size(), kMaxAccessSpecs, "AccessSpecs");
  if (spec.antenna > ports.antennas.size()) {
    throw Fault(Status::kFieldError, fmt::format("there is no antenna {}", spec.antenna));
  }
  entries_[spec.id].spec = spec;
}

std::vector<Bytes> AccessSpecs::change(const Message& message) {
  const std::uint32_t id = id_in(message);
  if (id != 0 && entries_.count(id) == 0) {
    throw Fault(Status::kFieldError, fmt::format("there is no AccessSpec {}", id));
  }
  std::vector<Bytes> results;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    const bool is_it = id == 0 || entry->first == id;
    if (is_it) entry->second.is_enabled = message.type == kEnableAccessSpec;
    if (is_it && message.type != kEnableAccessSpec) {
      append(std::exchange(entry->second.results, {}), results);
    }
    const bool is_deleted = is_it && message.type == kDeleteAccessSpec;
    entry = is_deleted ? entries_.erase(entry) : std::next(entry);
  }
  return results;
}

void AccessSpecs::write_all(ByteWriter& out) const {
  for (const auto& [id, entry] : entries_) {
    Bytes whole = entry.spec.whole;
    // After the header, ID, antenna and protocol.
    whole[11] = static_cast<std::uint8_t>(entry.is_enabled ? 0x80 : 0);
    out.bytes(whole);
  }
}

AccessEntry* AccessSpecs::for_tag(const TagReport& report, const MemoryBanks& tag) {
  for (auto& [id, entry] : entries_) {
    const AccessSpec& spec = entry.spec;
    const bool is_for_it =
        entry.is_enabled && (spec.antenna == 0 || spec.antenna == report.antenna) &&
        (spec.ro_spec == 0 || spec.ro_spec == report.ro_spec) &&
        std::all_of(spec.targets.begin(), spec.targets.end(),
                    [&](const MemoryMask& target) { return is_meant(target, tag); });
    if (is_for_it) return &entry;
  }
  return nullptr;
}

std::vector<Bytes> AccessSpecs::end_if_done(AccessEntry& entry) {
  const std::uint16_t operations = entry.spec.operations;
  const bool is_done = operations == 0 || entry.done >= operations;
  std::vector<Bytes> results;
  if (is_done || entry.results.size() >= kMaxPending) results = std::exchange(entry.results, {});
  const std::uint32_t id = entry.spec.id;
  if (is_done && operations > 0) entries_.erase(id);
  return results;
}

std::vector<Bytes> AccessSpecs::take_results() {
  std::vector<Bytes> results;
  for (auto& [id, entry] : entries_) append(std::exchange(entry.results, {}), results);
  return results;
}

void execute(AccessEntry& entry, MemoryBanks& tag, TagReport& report) {
  ByteWriter results;
  for (const OpSpec& op : entry.spec.ops) operate(op, tag, results);
  report.access_spec = entry.spec.id;
  report.op_results = results.written();
  ++entry.done;
}

}  // namespace tagfield::llrp
