// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/memory_banks.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

using Result = MemoryResult;

Words read(const MemoryBanks& tag, Bank bank, std::size_t pointer, std::size_t count,
           std::uint32_t password = 0) {
  Words words;
  EXPECT_EQ(tag.read(password, bank, pointer, count, words), Result::kSuccess);
  return words;
}

TEST(MemoryBanks, TheEpcStandsAfterCrcAndPc) {
  const MemoryBanks tag({0x1111, 0x2222, 0x3333});
  EXPECT_EQ(tag.pc(), 0x1800);  // three words
  EXPECT_EQ(tag.epc(), (Words{0x1111, 0x2222, 0x3333}));
  EXPECT_EQ(read(tag, Bank::kEpc, 1, 4), (Words{0x1800, 0x1111, 0x2222, 0x3333}));
  EXPECT_EQ(read(tag, Bank::kEpc, 0, 1), (Words{tag.crc()}));
}

/// CRC-16/GENIBUS of "123456789" is D64E; for an even number of its digits, by long division.
TEST(MemoryBanks, CrcIsTheStandards) {
  const auto by_division = [](const std::vector<std::uint8_t>& bytes) {
    unsigned crc = 0xffff;
    for (const std::uint8_t byte : bytes) {
      for (unsigned bit = 0x80; bit != 0; bit >>= 1U) {
        const bool carry = ((crc & 0x8000U) != 0) != ((byte & bit) != 0);
        crc = (crc << 1U & 0xffffU) ^ (carry ? 0x1021U : 0U);
      }
    }
    return crc ^ 0xffffU;
  };
  EXPECT_EQ(by_division({'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0xD64EU);
  EXPECT_EQ(crc16({0x3132, 0x3334, 0x3536, 0x3738}),
            by_division({'1', '2', '3', '4', '5', '6', '7', '8'}));
}

TEST(MemoryBanks, WrittenEpcIsTheNewOne) {
  MemoryBanks tag({0x1111, 0x2222, 0x3333, 0x4444, 0x5555, 0x6666});
  EXPECT_EQ(tag.write(0, Bank::kEpc, 2, {0xabcd}), Result::kSuccess);
  EXPECT_EQ(tag.epc().front(), 0xabcd);
  EXPECT_EQ(tag.write(0, Bank::kEpc, 1, {0x1000}), Result::kSuccess);  // two words only
  EXPECT_EQ(tag.epc(), (Words{0xabcd, 0x2222}));
}

/// EPC memory is at least 96 bits, so six words can be given, but no more.
TEST(MemoryBanks, ALengthThatDoesNotFitIsRefused) {
  MemoryBanks tag({0x1111});
  EXPECT_EQ(tag.write(0, Bank::kEpc, 1, {0x4800}), Result::kOverrun);
  EXPECT_EQ(tag.write(0, Bank::kEpc, 1, {0x3800, 0xabcd}), Result::kOverrun);
  EXPECT_EQ(tag.pc(), 0x0800);
  EXPECT_EQ(tag.epc(), Words{0x1111});
  EXPECT_EQ(tag.write(0, Bank::kEpc, 2, {0xf800}), Result::kSuccess);  // not the PC
  EXPECT_EQ(tag.write(0, Bank::kEpc, 1, {0x3000, 0xabcd}), Result::kSuccess);
  EXPECT_EQ(tag.epc(), (Words{0xabcd, 0, 0, 0, 0, 0}));
}

TEST(MemoryBanks, NothingIsWrittenBeyondTheEnd) {
  MemoryBanks tag({0x1111}, {0xE200}, 4);
  EXPECT_EQ(tag.write(0, Bank::kUser, 2, {1, 2}), Result::kSuccess);
  EXPECT_EQ(tag.write(0, Bank::kUser, 3, {7, 8}), Result::kOverrun);
  EXPECT_EQ(read(tag, Bank::kUser, 0, 0), (Words{0, 0, 1, 2}));
  Words unused;
  EXPECT_EQ(tag.read(0, Bank::kUser, 4, 0, unused), Result::kOverrun);
  EXPECT_EQ(tag.read(0, Bank::kUser, 65535, 65535, unused), Result::kOverrun);
  EXPECT_EQ(tag.write(0, Bank::kTid, 0, {1}), Result::kLocked);
  EXPECT_EQ(tag.write(0, Bank::kEpc, 0, {1}), Result::kLocked);
}

TEST(MemoryBanks, ALockAsksForThePassword) {
  MemoryBanks tag({0x1111});
  EXPECT_EQ(tag.write(0, Bank::kReserved, 2, {0xdead, 0xbeef}), Result::kSuccess);
  EXPECT_EQ(tag.lock(0, LockField::kUser, {true, false}), Result::kLocked);
  EXPECT_EQ(tag.lock(1, LockField::kUser, {true, false}), Result::kWrongPassword);
  EXPECT_EQ(tag.lock(0xdeadbeef, LockField::kUser, {true, false}), Result::kSuccess);
  EXPECT_EQ(tag.write(0, Bank::kUser, 0, {1}), Result::kLocked);
  EXPECT_EQ(tag.write(0x1, Bank::kUser, 0, {1}), Result::kWrongPassword);
  EXPECT_EQ(tag.write(0xdeadbeef, Bank::kUser, 0, {1}), Result::kSuccess);
  EXPECT_EQ(read(tag, Bank::kUser, 0, 1), (Words{1}));  // always readable
  // A locked password can't be read without the access password.
  EXPECT_EQ(tag.lock(0xdeadbeef, LockField::kAccessPassword, {true, false}), Result::kSuccess);
  Words unused;
  EXPECT_EQ(tag.read(0, Bank::kReserved, 2, 2, unused), Result::kLocked);
  EXPECT_EQ(read(tag, Bank::kReserved, 2, 2, 0xdeadbeef), (Words{0xdead, 0xbeef}));
}

TEST(MemoryBanks, WhatIsForGoodIsForGood) {
  MemoryBanks tag({0x1111});
  EXPECT_EQ(tag.lock(0, LockField::kUser, {true, true}), Result::kSuccess);
  EXPECT_EQ(tag.write(0, Bank::kUser, 0, {1}), Result::kLocked);
  EXPECT_EQ(tag.lock(0, LockField::kUser, {false, false}), Result::kLocked);
  EXPECT_EQ(tag.lock(0, LockField::kEpc, {false, true}), Result::kSuccess);
  EXPECT_EQ(tag.lock(0, LockField::kEpc, {true, false}), Result::kLocked);
  EXPECT_EQ(tag.write(0, Bank::kEpc, 2, {5}), Result::kSuccess);
}

TEST(MemoryBanks, OnlyWithAPasswordIsATagKilled) {
  MemoryBanks tag({0x1111});
  EXPECT_EQ(tag.kill(0), Result::kZeroPassword);
  EXPECT_EQ(tag.write(0, Bank::kReserved, 0, {0, 7}), Result::kSuccess);
  EXPECT_EQ(tag.kill(8), Result::kWrongPassword);
  EXPECT_FALSE(tag.is_killed());
  EXPECT_EQ(tag.kill(7), Result::kSuccess);
  EXPECT_TRUE(tag.is_killed());
}

TEST(MemoryBanks, MasksAreComparedBitByBit) {
  const MemoryBanks tag({0xa5f0});
  EXPECT_TRUE(tag.matches(Bank::kEpc, 32, 8, {}, {0xa5}));
  EXPECT_TRUE(tag.matches(Bank::kEpc, 36, 8, {}, {0x5f}));
  EXPECT_FALSE(tag.matches(Bank::kEpc, 36, 8, {}, {0x5e}));
  EXPECT_TRUE(tag.matches(Bank::kEpc, 36, 8, {0xfe}, {0x5e}));
  EXPECT_TRUE(tag.matches(Bank::kEpc, 32, 0, {}, {}));
  EXPECT_FALSE(tag.matches(Bank::kEpc, 32, 16, {}, {0xa5}));       // too little data
  EXPECT_FALSE(tag.matches(Bank::kUser, 32 * 16, 1, {}, {0x80}));  // past the end
  const auto crc = static_cast<std::uint8_t>(tag.crc() >> 8U);
  EXPECT_TRUE(tag.matches(Bank::kEpc, 0, 8, {}, {crc}));
}

}  // namespace
}  // namespace tagfield
