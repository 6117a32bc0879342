// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/wire.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace tagfield::llrp {
namespace {

/// KEEPALIVE with the ID 7: version 1, type 62, ten bytes (§8.1 and §16.1.1).
TEST(Wire, AHeaderIsTenBytes) {
  EXPECT_EQ(to_bytes({62, 7, {}}), (Bytes{0x04, 0x3e, 0, 0, 0, 10, 0, 0, 0, 7}));
  const Bytes custom = to_bytes({1023, 0x01020304, {0xaa}});
  EXPECT_EQ(custom, (Bytes{0x07, 0xff, 0, 0, 0, 11, 1, 2, 3, 4, 0xaa}));
  EXPECT_EQ(length_in(custom.data()), 11U);
  const Message message = message_of(custom);
  EXPECT_EQ(message.type, 1023);
  EXPECT_EQ(message.id, 0x01020304U);
  EXPECT_EQ(message.body, Bytes{0xaa});
}

TEST(Wire, HeadersOfOthersAreRefused) {
  const auto status = [](Bytes header) {
    try {
      length_in(header.data());
    } catch (const Fault& fault) {
      return fault.status();
    }
    return Status::kSuccess;
  };
  EXPECT_EQ(status({0x08, 0x3e, 0, 0, 0, 10, 0, 0, 0, 7}), Status::kUnsupportedVersion);
  EXPECT_EQ(status({0x04, 0x3e, 0, 0, 0, 9, 0, 0, 0, 7}), Status::kInvalid);
  EXPECT_EQ(status({0x04, 0x3e, 0xff, 0, 0, 10, 0, 0, 0, 7}), Status::kInvalid);
}

/// LLRPStatus (287): M_Success without text, with which every response begins.
TEST(Wire, ParametersHaveTypeAndLength) {
  ByteWriter writer;
  writer.parameter(287, [&] {
    writer.u16(0);
    writer.text("");
  });
  EXPECT_EQ(writer.written(), (Bytes{0x01, 0x1f, 0, 8, 0, 0, 0, 0}));
  const std::vector<Parameter> all = parameters_of(ByteReader(writer.written()));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].type, 287);
  EXPECT_EQ(all[0].content.left(), 4U);
  EXPECT_EQ(all[0].whole, writer.written());
}

/// AntennaID (1), PeakRSSI (6) and EPC-96 (13): a 7-bit type and no length.
TEST(Wire, SomeParametersHaveAFixedLength) {
  Bytes bytes = {0x81, 0, 3, 0x86, 0xc4, 0x8d};
  for (std::uint8_t i = 0; i < 12; ++i) bytes.push_back(i);
  const std::vector<Parameter> all = parameters_of(ByteReader(bytes));
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].type, 1);
  EXPECT_EQ(ByteReader(all[0].content).u16(), 3);
  EXPECT_EQ(all[1].type, 6);
  EXPECT_EQ(all[2].type, 13);
  EXPECT_EQ(all[2].content.left(), 12U);
}

TEST(Wire, BrokenParametersAreRefused) {
  for (const Bytes& bytes : {Bytes{0x01}, Bytes{0x01, 0x1f, 0}, Bytes{0x01, 0x1f, 0, 3},
                             Bytes{0x01, 0x1f, 0, 9, 0}, Bytes{0x81, 0}, Bytes{0xff, 0, 0}}) {
    EXPECT_THROW(parameters_of(ByteReader(bytes)), Fault);
  }
}

TEST(Wire, AParameterStandsOnceOrIsRequired) {
  const Bytes twice = {0, 177, 0, 4, 0, 177, 0, 4};
  EXPECT_THROW(find(parameters_of(ByteReader(twice)), 177), Fault);
  EXPECT_THROW(require(parameters_of(ByteReader(twice)), 178), Fault);
  EXPECT_THROW(require_known(parameters_of(ByteReader(twice)), {178}), Fault);
}

RC_GTEST_PROP(Wire, WhatIsWrittenIsRead,
              (std::uint8_t a, std::uint16_t b, std::uint32_t c, std::uint64_t d,
               const std::vector<std::uint8_t>& e)) {
  ByteWriter writer;
  writer.u8(a);
  writer.u16(b);
  writer.u32(c);
  writer.u64(d);
  writer.bytes(e);
  ByteReader reader(writer.written());
  RC_ASSERT(reader.u8() == a);
  RC_ASSERT(reader.u16() == b);
  RC_ASSERT(reader.u32() == c);
  RC_ASSERT(reader.u64() == d);
  RC_ASSERT(reader.bytes(e.size()) == e);
  RC_ASSERT(reader.left() == 0U);
  RC_ASSERT_THROWS_AS(reader.u8(), Fault);
}

/// Any bytes are a whole number of parameters, or cause a Fault.
RC_GTEST_PROP(Wire, AnyBytesAreParametersOrAFault, (const std::vector<std::uint8_t>& bytes)) {
  try {
    std::size_t size = 0;
    for (const Parameter& parameter : parameters_of(ByteReader(bytes))) {
      size += parameter.whole.size();
    }
    RC_ASSERT(size == bytes.size());
  } catch (const Fault&) {
  }
}

}  // namespace
}  // namespace tagfield::llrp
