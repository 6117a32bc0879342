// SPDX-License-Identifier: Apache-2.0
#include "tagfield/epc/epc.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

struct Example {
  const char* id;
  const char* tag;
  const char* hex;
};

// Section E.3 of the Tag Data Standard 1.13.
constexpr Example kExamples[] = {
    {"urn:epc:id:sgtin:0614141.812345.6789", "urn:epc:tag:sgtin-96:3.0614141.812345.6789",
     "3074257BF7194E4000001A85"},
    {"urn:epc:id:sscc:0614141.1234567890", "urn:epc:tag:sscc-96:3.0614141.1234567890",
     "3174257BF4499602D2000000"},
    {"urn:epc:id:sgln:0614141.12345.5678", "urn:epc:tag:sgln-96:3.0614141.12345.5678",
     "3274257BF46072000000162E"},
    {"urn:epc:id:grai:0614141.12345.5678", "urn:epc:tag:grai-96:3.0614141.12345.5678",
     "3374257BF40C0E400000162E"},
    {"urn:epc:id:giai:0614141.5678", "urn:epc:tag:giai-96:3.0614141.5678",
     "3474257BF40000000000162E"},
    {"urn:epc:id:gsrn:0614141.1234567890", "urn:epc:tag:gsrn-96:3.0614141.1234567890",
     "2D74257BF4499602D2000000"},
    {"urn:epc:id:gsrnp:0614141.1234567890", "urn:epc:tag:gsrnp-96:3.0614141.1234567890",
     "2E74257BF4499602D2000000"},
    {"urn:epc:id:gdti:0614141.12345.5678", "urn:epc:tag:gdti-96:3.0614141.12345.5678",
     "2C74257BF46072000000162E"},
    {"urn:epc:id:cpi:0614141.98765.12345", "urn:epc:tag:cpi-96:3.0614141.98765.12345",
     "3C74257BF400C0E680003039"},
    {"urn:epc:id:gid:31415.271828.1414", "urn:epc:tag:gid-96:31415.271828.1414",
     "350007AB70425D4000000586"},
    {"urn:epc:id:usdod:CAGEY.5678", "urn:epc:tag:usdod-96:3.CAGEY.5678",
     "2F320434147455900000162E"},
};

TEST(Epc, HasTheBitsOfTheStandardsExamples) {
  for (const Example& example : kExamples) {
    const Epc epc = epc_from_uri(example.tag);
    EXPECT_EQ(hex_of(epc_bytes(epc)), example.hex) << example.tag;
    EXPECT_EQ(epc_from_bytes(bytes_of_hex(example.hex)), epc) << example.tag;
    EXPECT_EQ(tag_uri(epc), example.tag);
    EXPECT_EQ(id_uri(epc), example.id);
  }
}

TEST(Epc, OfAPureIdentityHasTheFilterOfAllOthers) {
  for (const Example& example : kExamples) {
    const Epc epc = epc_from_uri(example.id);
    EXPECT_EQ(epc.filter, 0);
    EXPECT_EQ(id_uri(epc_from_bytes(epc_bytes(epc))), example.id);
  }
}

// The ends of the partition tables, computed by hand: a prefix of 12 digits leaves no digit for an
// SGLN, one of 6 leaves 62 bits for a GIAI.
TEST(Epc, TakesTheLongestAndTheShortestPrefixes) {
  EXPECT_EQ(hex_of(epc_bytes(epc_from_uri("urn:epc:id:sgln:000000000001..0"))),
            "320000000000040000000000");
  EXPECT_EQ(hex_of(epc_bytes(epc_from_uri("urn:epc:id:giai:000000.4611686018427387903"))),
            "341800003FFFFFFFFFFFFFFF");
  EXPECT_EQ(hex_of(epc_bytes(epc_from_uri("urn:epc:id:sgtin:999999999999.9.274877906943"))),
            "3003A352943FFE7FFFFFFFFF");
}

TEST(Epc, SaysWhatIsWrongWithAUri) {
  const auto says = [](const char* uri, const char* part) {
    const std::string message = error_of([&] { epc_from_uri(uri); });
    EXPECT_TRUE(contains(message, part)) << message;
    EXPECT_TRUE(contains(message, uri)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  says("urn:epc:id:sgtin:0614141.81234.6789", "item reference '81234' must be 6 digits");
  says("urn:epc:id:sgtin:06141.81234567.6789", "company prefix '06141' must have 6 to 12 digits");
  says("urn:epc:id:sgtin:061414a.812345.6789", "company prefix '061414a' must be 7 digits");
  says("urn:epc:id:sgtin:0614141.812345", "needs 3 fields between dots, has 2");
  says("urn:epc:id:sgtin:0614141.812345.06789", "without leading zeros");
  says("urn:epc:id:sgtin:0614141.812345.A7", "serial number 'A7' must be a number");
  says("urn:epc:id:sgtin:0614141.812345.274877906944", "does not fit into 38 bits");
  says("urn:epc:id:sgtin:0614141.812345.99999999999999999999999", "does not fit");
  says("urn:epc:id:cpi:000000000001.1000.1", "does not fit into 11 bits and 3 digits");
  says("urn:epc:tag:sgtin-96:8.0614141.812345.6789", "filter 8 must be 0 to 7");
  says("urn:epc:tag:usdod-96:16.CAGEY.1", "filter");
  says("urn:epc:id:usdod:CAGIY.1", "except I and O");
  says("urn:epc:tag:sgtin-198:3.0614141.812345.6789", "'sgtin-198' is not a scheme of 96 bits");
  says("urn:epc:id:sgtin-96:3.0614141.812345.6789", "'sgtin-96' is not a scheme");
  says("urn:epc:id:sgtin", "'sgtin' is not a scheme");
  says("urn:epc:raw:96.x3074257BF7194E4000001A85", "must begin with urn:epc:id:");
}

TEST(Epc, SaysWhatIsWrongWithBits) {
  const auto says = [](const char* hex, const char* part) {
    const std::string message = error_of([&] { epc_from_bytes(bytes_of_hex(hex)); });
    EXPECT_TRUE(contains(message, part)) << message;
    EXPECT_TRUE(contains(message, hex)) << message;
  };
  says("E2801160600002054CC2096F", "header E2 is not that of a scheme");
  says("307C257BF7194E4000001A85", "partition 7 must be 0 to 6");
  says("3174257BF4499602D2000001", "last bits must be zero");
  says("3077FFFFFFFFFE4000001A85", "company prefix 16777215 has more than 7 digits");
  says("2F3204341474559000001", "must be 24 hexadecimal digits");
  says("3074257BF7194E4000001AXY", "must be 24 hexadecimal digits");
  says("2F3204341474F590000016FF", "CAGE");
}

TEST(Epc, IsFoundInATagsIdWhereThereIsOne) {
  EXPECT_EQ(epc_of("3074257bf7194e4000001a85"), epc_from_uri(kExamples[0].tag));
  EXPECT_EQ(epc_of(kExamples[0].tag), epc_from_uri(kExamples[0].tag));
  EXPECT_FALSE(epc_of("E2801160600002054CC2096F"));
  EXPECT_FALSE(epc_of("pallet 7"));
  EXPECT_FALSE(epc_of("urn:epc:id:sgtin:0614141"));
}

TEST(BitsOfId, AreDigitsOfWholeWordsOrOfUris) {
  EXPECT_EQ(bits_of_id("e2801160600002054cc2096f"), "E2801160600002054CC2096F");
  EXPECT_EQ(bits_of_id("abcd"), "ABCD");
  EXPECT_EQ(bits_of_id(kExamples[0].tag), kExamples[0].hex);
  for (const char* id : {"", "abc", "abcde", "tag4", "urn:epc:id:sgtin:1"}) {
    EXPECT_EQ(bits_of_id(id), "") << id;
  }
}

TEST(Epc, OfNoSchemeHasARawUri) {
  EXPECT_EQ(raw_uri("e2801160600002054cc2096f"), "urn:epc:raw:96.xE2801160600002054CC2096F");
  EXPECT_EQ(raw_uri("ABCD"), "urn:epc:raw:16.xABCD");
}

/// Any bits under a scheme's header are either rejected or round-trip through both URIs.
RC_GTEST_PROP(Epc, BitsComeBackThroughTheirUri, ()) {
  EpcBytes bytes = *rc::gen::container<EpcBytes>(rc::gen::arbitrary<std::uint8_t>());
  bytes[0] = *rc::gen::element<std::uint8_t>(0x2C, 0x2D, 0x2E, 0x2F, 0x30, 0x31, 0x32, 0x33, 0x34,
                                             0x35, 0x3C);
  if (*rc::gen::arbitrary<bool>()) bytes[9] = bytes[10] = bytes[11] = 0;
  std::optional<Epc> epc = epc_of(hex_of(bytes));
  RC_PRE(epc.has_value());
  RC_ASSERT(hex_of(epc_bytes(epc_from_uri(tag_uri(*epc)))) == hex_of(bytes));
  epc->filter = 0;
  RC_ASSERT(epc_from_uri(id_uri(*epc)) == *epc);
}

/// The decimal digits of any SGTIN, by independent arithmetic.
RC_GTEST_PROP(Epc, AnSgtinHoldsItsThreeNumbers, ()) {
  const int digits = *rc::gen::inRange(6, 13);
  const auto text = [](int length) {
    std::string all;
    for (int i = 0; i < length; ++i) all += static_cast<char>('0' + *rc::gen::inRange(0, 10));
    return all;
  };
  const std::string prefix = text(digits);
  const std::string item = text(13 - digits);
  const auto serial = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 38U);
  const EpcBytes bytes = epc_bytes({EpcScheme::kSgtin, 5, {prefix, item, std::to_string(serial)}});
  std::string bits;
  for (const std::uint8_t byte : bytes) {
    for (int bit = 7; bit >= 0; --bit) bits += (byte >> bit & 1) != 0 ? '1' : '0';
  }
  constexpr std::size_t kPrefixBits[] = {40, 37, 34, 30, 27, 24, 20};
  const std::size_t split = 14 + kPrefixBits[12 - digits];
  const auto number = [&](std::size_t begin, std::size_t end) {
    return std::stoull(bits.substr(begin, end - begin), nullptr, 2);
  };
  RC_ASSERT(number(0, 8) == 0x30);
  RC_ASSERT(number(8, 11) == 5);
  RC_ASSERT(number(11, 14) == static_cast<unsigned long long>(12 - digits));
  RC_ASSERT(number(14, split) == std::stoull(prefix));
  RC_ASSERT(number(split, 58) == std::stoull(item));
  RC_ASSERT(number(58, 96) == serial);
}

}  // namespace
}  // namespace tagfield
