// SPDX-License-Identifier: Apache-2.0
/// @file
/// A tag's memory banks, passwords and locks (Gen2 v2, 6.3.2.1), and access to them by readers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace tagfield {

using Words = std::vector<std::uint16_t>;

/// Memory banks by number (6.3.2.1).
enum class Bank : std::uint8_t { kReserved = 0, kEpc = 1, kTid = 2, kUser = 3 };

/// The individually lockable parts (6.3.2.12.3.5, Lock's payload).
enum class LockField : std::uint8_t { kKillPassword, kAccessPassword, kEpc, kTid, kUser };

/// The result of a command.
enum class MemoryResult {
  kSuccess,
  kOverrun,        ///< There is no such word.
  kLocked,         ///< The tag's state does not allow writing, or reading.
  kWrongPassword,  ///< The tag does not answer.
  kZeroPassword,   ///< A tag whose kill password is 0 can't be killed.
};

/// A lock's two bits (Table 6.53): whether a password is needed, and whether that is permanent.
struct LockState {
  bool needs_password = false;
  bool is_permanent = false;
};

/// One tag's memory. A password of 0 means no password: such a tag is always in its secured state,
/// in which locked memory can be written.
class MemoryBanks {
 public:
  /// A tag with an EPC of 0 to 31 words, a TID, no passwords, and `user_words` words of user
  /// memory.
  explicit MemoryBanks(const Words& epc,
                       Words tid = {0xE200, 0x0000, 0x0000, 0x0000, 0x0000, 0x0000},
                       std::size_t user_words = 32);

  /// The EPC, with the length given in the PC word.
  [[nodiscard]] Words epc() const;
  /// Protocol control: the EPC's length in its five highest bits.
  [[nodiscard]] std::uint16_t pc() const { return banks_[1][1]; }
  /// CRC-16 over PC and EPC, as sent by the tag (6.3.2.1.2.1).
  [[nodiscard]] std::uint16_t crc() const;
  [[nodiscard]] bool is_killed() const { return killed_; }

  /// Reads `count` words starting at `pointer`, or all remaining ones if it is 0, into `out`.
  MemoryResult read(std::uint32_t password, Bank bank, std::size_t pointer, std::size_t count,
                    Words& out) const;
  /// Writes nothing if not all words fit.
  MemoryResult write(std::uint32_t password, Bank bank, std::size_t pointer, const Words& words);
  /// Sets both bits of a field's lock, as Lock does; a permanent lock can't be changed.
  MemoryResult lock(std::uint32_t password, LockField field, LockState state);
  MemoryResult kill(std::uint32_t password);

  /// Whether `count` bits of the bank starting at bit `pointer` equal `data`, most significant bit
  /// first, where `mask` is set; an empty mask compares all bits. The EPC bank begins with its CRC.
  [[nodiscard]] bool matches(Bank bank, std::size_t pointer, std::size_t count,
                             const std::vector<std::uint8_t>& mask,
                             const std::vector<std::uint8_t>& data) const;

 private:
  [[nodiscard]] std::uint32_t password_at(std::size_t word) const;
  [[nodiscard]] bool is_secured(std::uint32_t password) const;
  [[nodiscard]] const LockState& lock_of(Bank bank, std::size_t word) const;
  [[nodiscard]] bool bit(Bank bank, std::size_t at) const;

  std::array<Words, 4> banks_;
  std::array<LockState, 5> locks_{};
  bool killed_ = false;
};

/// CRC-16 of Annex F (CCITT, preset FFFF, inverted) over words, most significant byte first.
std::uint16_t crc16(const Words& words);

}  // namespace tagfield
