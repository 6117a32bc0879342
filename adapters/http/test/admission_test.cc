// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/admission.h"

#include <gtest/gtest.h>

namespace tagfield::http {
namespace {

TEST(Admission, ThisMachineHasAddressesAndTwoNames) {
  for (const char* own : {"localhost", "localhost:8080", "LOCALHOST", "127.0.0.1:1", "[::1]:8080",
                          "[::1]", "192.168.1.7:8080", "hall-pc:8080"}) {
    EXPECT_TRUE(is_own_host(own, "hall-pc")) << own;
  }
  for (const char* other : {"", "evil.example", "evil.example:8080", "localhost.evil.example",
                            "127.0.0.1.evil.example", "[::1", ":8080", "hall-pc.evil.example"}) {
    EXPECT_FALSE(is_own_host(other, "hall-pc")) << other;
  }
  EXPECT_FALSE(is_own_host("", ""));
}

TEST(Admission, CommandsComeFromOurPageOrNone) {
  EXPECT_TRUE(is_own_origin("", "localhost:8080"));
  EXPECT_TRUE(is_own_origin("http://localhost:8080", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("http://localhost:9090", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("http://evil.example", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("null", "localhost:8080"));
}

TEST(Admission, SecretsAreTheSameOrNot) {
  EXPECT_TRUE(is_same_secret("abc", "abc"));
  for (const char* other : {"", "ab", "abcd", "abd"}) EXPECT_FALSE(is_same_secret(other, "abc"));
  const std::string token = new_token();
  EXPECT_EQ(token.size(), 32U);
  EXPECT_NE(token, new_token());
}

}  // namespace
}  // namespace tagfield::http
