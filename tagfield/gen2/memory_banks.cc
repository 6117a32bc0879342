// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/memory_banks.h"

#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxEpcWords = 31;
/// Words of the EPC bank before the EPC: CRC and PC.
constexpr std::size_t kEpcBegins = 2;

/// The length in a PC word.
std::size_t epc_words(std::uint16_t pc) { return pc >> 11U; }

std::size_t number(Bank bank) { return static_cast<std::size_t>(bank); }
std::size_t number(LockField field) { return static_cast<std::size_t>(field); }

}  // namespace

std::uint16_t crc16(const Words& words) {
  unsigned crc = 0xffff;
  for (const std::uint16_t word : words) {
    crc ^= word;
    for (int i = 0; i < 16; ++i)
      crc = (crc & 0x8000U) != 0 ? (crc << 1U ^ 0x1021U) & 0xffffU : crc << 1U;
  }
  return static_cast<std::uint16_t>(~crc);
}

MemoryBanks::MemoryBanks(const Words& epc, Words tid, std::size_t user_words) {
  if (epc.size() > kMaxEpcWords) throw Error("an EPC has at most 496 bits");
  banks_[number(Bank::kReserved)].assign(4, 0);
  Words& bank = banks_[number(Bank::kEpc)];
  bank = {0, static_cast<std::uint16_t>(epc.size() << 11U)};
  bank.insert(bank.end(), epc.begin(), epc.end());
  // Space for an EPC of 96 bits.
  if (bank.size() < kEpcBegins + 6) bank.resize(kEpcBegins + 6, 0);
  banks_[number(Bank::kTid)] = std::move(tid);
  banks_[number(Bank::kUser)].assign(user_words, 0);
}

Words MemoryBanks::epc() const {
  const Words& bank = banks_[number(Bank::kEpc)];
  const std::size_t stated = epc_words(pc());
  const std::size_t there = bank.size() - kEpcBegins;
  return {bank.begin() + kEpcBegins,
          bank.begin() + kEpcBegins + static_cast<std::ptrdiff_t>(stated < there ? stated : there)};
}

std::uint16_t MemoryBanks::crc() const {
  Words sent = epc();
  sent.insert(sent.begin(), pc());
  return crc16(sent);
}

std::uint32_t MemoryBanks::password_at(std::size_t word) const {
  const Words& reserved = banks_[number(Bank::kReserved)];
  return static_cast<std::uint32_t>(reserved[word]) << 16U | reserved[word + 1];
}

/// Whether the tag enters its secured state: with the access password, or if it has none.
bool MemoryBanks::is_secured(std::uint32_t password) const {
  return password_at(2) == 0 || password == password_at(2);
}

const LockState& MemoryBanks::lock_of(Bank bank, std::size_t word) const {
  if (bank == Bank::kReserved) {
    return locks_[number(word < 2 ? LockField::kKillPassword : LockField::kAccessPassword)];
  }
  const LockField field = bank == Bank::kEpc   ? LockField::kEpc
                          : bank == Bank::kTid ? LockField::kTid
                                               : LockField::kUser;
  return locks_[number(field)];
}

MemoryResult MemoryBanks::read(std::uint32_t password, Bank bank, std::size_t pointer,
                               std::size_t count, Words& out) const {
  const Words& words = banks_[number(bank)];
  if (password != 0 && !is_secured(password)) return MemoryResult::kWrongPassword;
  if (count == 0 && pointer < words.size()) count = words.size() - pointer;
  if (count == 0 || pointer > words.size() || count > words.size() - pointer) {
    return MemoryResult::kOverrun;
  }
  for (std::size_t i = pointer; i < pointer + count; ++i) {
    // A locked password can be read only in the secured state, and never if its lock is permanent;
    // other banks are always readable.
    const LockState& lock = lock_of(bank, i);
    const bool is_hidden = bank == Bank::kReserved && lock.needs_password &&
                           (lock.is_permanent || !is_secured(password));
    if (is_hidden) return MemoryResult::kLocked;
  }
  out.assign(words.begin() + static_cast<std::ptrdiff_t>(pointer),
             words.begin() + static_cast<std::ptrdiff_t>(pointer + count));
  if (bank == Bank::kEpc && pointer == 0) out.front() = crc();
  return MemoryResult::kSuccess;
}

MemoryResult MemoryBanks::write(std::uint32_t password, Bank bank, std::size_t pointer,
                                const Words& words) {
  Words& stored = banks_[number(bank)];
  if (password != 0 && !is_secured(password)) return MemoryResult::kWrongPassword;
  if (pointer > stored.size() || words.size() > stored.size() - pointer) {
    return MemoryResult::kOverrun;
  }
  for (std::size_t i = pointer; i < pointer + words.size(); ++i) {
    const LockState& lock = lock_of(bank, i);
    const bool is_forbidden = lock.needs_password && (lock.is_permanent || !is_secured(password));
    // The tag computes its CRC itself, and its TID is fixed.
    const bool is_own = bank == Bank::kTid || (bank == Bank::kEpc && i == 0);
    if (is_forbidden || is_own) return MemoryResult::kLocked;
  }
  // A tag refuses a length that its EPC memory does not hold.
  const bool sets_pc = bank == Bank::kEpc && pointer <= 1 && pointer + words.size() > 1;
  if (sets_pc && epc_words(words[1 - pointer]) > stored.size() - kEpcBegins) {
    return MemoryResult::kOverrun;
  }
  for (std::size_t i = 0; i < words.size(); ++i) stored[pointer + i] = words[i];
  return MemoryResult::kSuccess;
}

MemoryResult MemoryBanks::lock(std::uint32_t password, LockField field, LockState state) {
  if (password != 0 && !is_secured(password)) return MemoryResult::kWrongPassword;
  if (!is_secured(password)) return MemoryResult::kLocked;
  LockState& now = locks_[number(field)];
  const bool changes =
      now.needs_password != state.needs_password || now.is_permanent != state.is_permanent;
  if (now.is_permanent && changes) return MemoryResult::kLocked;
  now = state;
  return MemoryResult::kSuccess;
}

MemoryResult MemoryBanks::kill(std::uint32_t password) {
  if (password_at(0) == 0) return MemoryResult::kZeroPassword;
  if (password != password_at(0)) return MemoryResult::kWrongPassword;
  killed_ = true;
  return MemoryResult::kSuccess;
}

bool MemoryBanks::bit(Bank bank, std::size_t at) const {
  const std::uint32_t word = bank == Bank::kEpc && at < 16 ? crc() : banks_[number(bank)][at / 16];
  return (word >> (15U - at % 16) & 1U) != 0;
}

bool MemoryBanks::matches(Bank bank, std::size_t pointer, std::size_t count,
                          const std::vector<std::uint8_t>& mask,
                          const std::vector<std::uint8_t>& data) const {
  const auto bit_of = [](const std::vector<std::uint8_t>& bytes, std::size_t at) {
    return (std::uint32_t{bytes[at / 8]} >> (7U - at % 8) & 1U) != 0;
  };
  if (pointer + count > banks_[number(bank)].size() * 16 || data.size() * 8 < count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    const bool counts = mask.empty() || (i / 8 < mask.size() && bit_of(mask, i));
    if (counts && bit(bank, pointer + i) != bit_of(data, i)) return false;
  }
  return true;
}

}  // namespace tagfield
