// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/tag_store.h"

#include <algorithm>

#include "tagfield/gen2/tag_epc.h"

namespace tagfield::llrp {
namespace {

/// Code of the operation's result (§15.2.1.5): success, tag error, no response, and, if the result
/// distinguishes them, overrun and lock.
std::uint8_t code_of(MemoryResult result, OpKind kind) {
  const bool is_write =
      kind == OpKind::kWrite || kind == OpKind::kBlockWrite || kind == OpKind::kBlockErase;
  switch (result) {
    case MemoryResult::kSuccess:
      return 0;
    case MemoryResult::kOverrun:
      return 1;
    case MemoryResult::kLocked:
      return kind == OpKind::kRead ? 1 : 2;
    case MemoryResult::kZeroPassword:
      return 1;
    case MemoryResult::kWrongPassword:
      break;
  }
  // The tag does not answer.
  if (is_write) return 5;
  if (kind == OpKind::kKill) return 4;
  return kind == OpKind::kLock ? 3 : 2;
}

LockState state_of(std::uint8_t privilege) {
  return {privilege == 0 || privilege == 1, privilege == 1 || privilege == 2};
}

MemoryResult lock_all(const OpSpec& op, MemoryBanks& tag) {
  for (const LockRequest& lock : op.locks) {
    const MemoryResult result =
        tag.lock(op.password, static_cast<LockField>(lock.field), state_of(lock.privilege));
    if (result != MemoryResult::kSuccess) return result;
  }
  return MemoryResult::kSuccess;
}

void write_result(const OpSpec& op, MemoryBanks& tag, std::uint16_t type, ByteWriter& out) {
  const MemoryResult result =
      tag.write(op.password, static_cast<Bank>(op.bank), op.pointer, op.words);
  const bool is_done = result == MemoryResult::kSuccess;
  out.parameter(type, [&] {
    out.u8(code_of(result, op.kind));
    out.u16(op.id);
    out.u16(is_done ? static_cast<std::uint16_t>(op.words.size()) : std::uint16_t{0});
  });
}

void read_result(const OpSpec& op, const MemoryBanks& tag, ByteWriter& out) {
  Words words;
  const MemoryResult result =
      tag.read(op.password, static_cast<Bank>(op.bank), op.pointer, op.count, words);
  out.parameter(349, [&] {
    out.u8(code_of(result, op.kind));
    out.u16(op.id);
    out.u16(static_cast<std::uint16_t>(words.size()));
    for (const std::uint16_t word : words) out.u16(word);
  });
}

void plain_result(std::uint16_t type, MemoryResult result, const OpSpec& op, ByteWriter& out) {
  out.parameter(type, [&] {
    out.u8(code_of(result, op.kind));
    out.u16(op.id);
  });
}

}  // namespace

MemoryBanks& TagStore::of(const std::string& id) {
  return tags_.try_emplace(id, epc_of_id(id)).first->second;
}

void operate(const OpSpec& op, MemoryBanks& tag, ByteWriter& result) {
  switch (op.kind) {
    case OpKind::kRead:
      return read_result(op, tag, result);
    case OpKind::kWrite:
      return write_result(op, tag, 350, result);
    case OpKind::kBlockWrite:
      return write_result(op, tag, 354, result);
    case OpKind::kKill:
      return plain_result(351, tag.kill(op.password), op, result);
    case OpKind::kLock:
      return plain_result(352, lock_all(op, tag), op, result);
    case OpKind::kBlockErase:
      break;
  }
  return plain_result(
      353, tag.write(op.password, static_cast<Bank>(op.bank), op.pointer, Words(op.count, 0)), op,
      result);
}

bool is_meant(const MemoryMask& mask, const MemoryBanks& tag) {
  return tag.matches(static_cast<Bank>(mask.bank), mask.pointer, mask.count, mask.mask,
                     mask.data) == mask.match;
}

bool is_selected(const std::vector<TagFilter>& filters, const MemoryBanks& tag) {
  // Effect of a Select on matching and on other tags, by its action (§15.2.1.2.1.3): 1 selects, 0
  // unselects, -1 does nothing.
  constexpr int kMatching[] = {1, 1, -1, 0, 0, -1};
  constexpr int kOthers[] = {0, -1, 0, -1, 1, 1};
  // Tags are initially unselected if the first Select only adds.
  bool is_in = filters.empty() || (filters.front().action != 1 && filters.front().action != 5);
  for (const TagFilter& filter : filters) {
    const int effect = (is_meant(filter.mask, tag) ? kMatching : kOthers)[filter.action];
    if (effect >= 0) is_in = effect == 1;
  }
  return is_in;
}

}  // namespace tagfield::llrp
