// SPDX-License-Identifier: Apache-2.0
#include "tagfield/epc/epc_pattern.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

constexpr const char* kSgtin = "urn:epc:tag:sgtin-96:3.0614141.812345.6789";
constexpr const char* kSgtinHex = "3074257BF7194E4000001A85";

bool is_meant(const char* pattern, const char* id) {
  return matches(parse_epc_pattern(pattern), epc_to_match(id));
}

std::string group(const char* pattern, const char* id) {
  return group_of(parse_epc_pattern(pattern), epc_to_match(id));
}

TEST(EpcPattern, MatchesFieldsOfTagUris) {
  for (const char* id : {kSgtin, kSgtinHex, "3074257bf7194e4000001a85"}) {
    EXPECT_TRUE(is_meant("urn:epc:pat:sgtin-96:3.0614141.*.*", id));
    EXPECT_TRUE(is_meant("urn:epc:pat:sgtin-96:*.*.*.*", id));
    EXPECT_TRUE(is_meant("urn:epc:pat:sgtin-96:3.0614141.812345.[6789-6789]", id));
    EXPECT_TRUE(is_meant("urn:epc:pat:sgtin-96:[2-3].0614141.[800000-899999].*", id));
    EXPECT_FALSE(is_meant("urn:epc:pat:sgtin-96:1.0614141.*.*", id));
    EXPECT_FALSE(is_meant("urn:epc:pat:sgtin-96:3.614141.*.*", id));
    EXPECT_FALSE(is_meant("urn:epc:pat:sgtin-96:3.0614141.812345.[6790-9999]", id));
    EXPECT_FALSE(is_meant("urn:epc:pat:sscc-96:3.0614141.*", id));
  }
}

TEST(EpcPattern, MatchesPureIdentitiesWhateverTheFilter) {
  EXPECT_TRUE(is_meant("urn:epc:idpat:sgtin:0614141.*.*", kSgtinHex));
  EXPECT_TRUE(is_meant("urn:epc:id:sgtin:0614141.812345.6789", kSgtinHex));
  EXPECT_TRUE(is_meant(kSgtin, kSgtinHex));
  EXPECT_FALSE(is_meant("urn:epc:tag:sgtin-96:1.0614141.812345.6789", kSgtinHex));
  EXPECT_TRUE(is_meant("urn:epc:pat:gid-96:31415.*.*", "urn:epc:id:gid:31415.271828.1414"));
}

TEST(EpcPattern, MatchesTheFirstHexadecimalDigits) {
  EXPECT_TRUE(is_meant("30*", kSgtinHex));
  EXPECT_TRUE(is_meant("3074257b*", kSgtin));
  EXPECT_TRUE(is_meant("E280*", "E2801160600002054CC2096F"));
  EXPECT_TRUE(is_meant(kSgtinHex, kSgtin));
  EXPECT_FALSE(is_meant("31*", kSgtinHex));
  EXPECT_FALSE(is_meant("30", kSgtinHex));
}

TEST(EpcPattern, AStarAloneMatchesAll) {
  for (const char* id : {kSgtin, kSgtinHex, "pallet 7", "ABC"}) EXPECT_TRUE(is_meant("*", id));
  EXPECT_FALSE(is_meant("30*", "pallet 7"));
  EXPECT_FALSE(is_meant("urn:epc:pat:sgtin-96:*.*.*.*", "pallet 7"));
}

// The example of ALE 1.1, section 5.2.3: the group's name contains the value of X.
TEST(EpcPattern, GroupsByWhatXStandsFor) {
  EXPECT_EQ(group("urn:epc:pat:sgtin-96:X.X.*.*", kSgtin), "urn:epc:pat:sgtin-96:3.0614141.*.*");
  EXPECT_EQ(group("urn:epc:pat:sgtin-96:*.X.X.[0-9999]", kSgtin),
            "urn:epc:pat:sgtin-96:*.0614141.812345.[0-9999]");
  EXPECT_EQ(group("urn:epc:pat:sgtin-96:3.0614141.*.*", kSgtin),
            "urn:epc:pat:sgtin-96:3.0614141.*.*");
  EXPECT_EQ(group("30*", kSgtin), "30*");
}

TEST(EpcPattern, SaysWhatIsWrong) {
  const auto says = [](const char* text, const char* part) {
    const std::string message = error_of([&] { parse_epc_pattern(text); });
    EXPECT_TRUE(contains(message, part)) << message;
    EXPECT_TRUE(contains(message, text)) << message;
  };
  says("", "must be urn:epc:pat:");
  says("pallet*", "hexadecimal digits");
  says("3*0", "hexadecimal digits");
  says("urn:epc:pat:sgtin:3.0614141.*.*", "'sgtin' is not a scheme of 96 bits");
  says("urn:epc:idpat:sgtin-96:0614141.*.*", "'sgtin-96' is not a scheme");
  says("urn:epc:pat:sgtin-96:0614141.*.*", "needs 4 fields between dots, has 3");
  says("urn:epc:pat:sgtin-96:3.0614141.[9-1].*", "must be a range [LEAST-MOST]");
  says("urn:epc:pat:sgtin-96:3.0614141.[1-a].*", "must be a range [LEAST-MOST]");
  says("urn:epc:pat:sgtin-96:3.0614141.[1-2.*", "must be a range [LEAST-MOST]");
  says("urn:epc:pat:sgtin-96:3.0614141.**.*", "'**' must be digits");
  says("urn:epc:id:sgtin:0614141.1.1", "item reference '1' must be 6 digits");
}

}  // namespace
}  // namespace tagfield
