// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/target.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tagfield/base/error.h"

namespace tagfield::http {
namespace {

using Parts = std::vector<std::string>;

TEST(Target, IsTakenApart) {
  const auto target = parsed_target("/api/tags/tag%201%2F2/move?to=a%26b&x=&y");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->parts, (Parts{"api", "tags", "tag 1/2", "move"}));
  EXPECT_EQ(target->query("to"), "a&b");
  EXPECT_EQ(target->query("x"), "");
  EXPECT_EQ(target->query("y"), "");
  EXPECT_EQ(target->query("z"), std::nullopt);
}

TEST(Target, BrokenOnesAreNone) {
  for (const char* bad : {"", "api", "/%", "/%2", "/%zz", "/%00", "/a?b=%0a", "http://x/api"}) {
    EXPECT_FALSE(parsed_target(bad)) << bad;
  }
}

TEST(Target, MatchesAPattern) {
  const auto target = parsed_target("/api/tags/a/move");
  EXPECT_TRUE(matches(*target, "/api/tags/{id}/move"));
  EXPECT_FALSE(matches(*target, "/api/tags/{id}"));
  EXPECT_FALSE(matches(*target, "/api/tags/{id}/move/x"));
  EXPECT_FALSE(matches(*target, "/api/antennas/{id}/move"));
  EXPECT_FALSE(matches(*parsed_target("/api/tags//move"), "/api/tags/{id}/move"));
}

TEST(Target, UnknownParametersAreRefused) {
  const auto target = parsed_target("/api/reads?tag=a&reder=b");
  require_known(*target, {"tag", "reder"});
  require_known(*parsed_target("/api/reads"), {});
  try {
    require_known(*target, {"tag", "reader"});
    ADD_FAILURE() << "'reder' was taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "'?reder' is not a parameter here (did you mean 'reader'?)");
  }
}

RC_GTEST_PROP(Target, AnyNameComesThroughItsEscape, (std::vector<unsigned char> bytes)) {
  std::string name;
  std::string escaped;
  for (const unsigned char byte : bytes) {
    if (byte < 0x20 || byte == 0x7f) continue;
    name += static_cast<char>(byte);
    escaped += fmt::format("%{:02x}", byte);
  }
  const auto target = parsed_target("/" + escaped + "?k=" + escaped);
  RC_ASSERT(target.has_value());
  RC_ASSERT(target->parts == Parts{name});
  RC_ASSERT(target->query("k") == name);
}

RC_GTEST_PROP(Target, NoTextBreaksIt, (std::string text)) { (void)parsed_target("/" + text); }

}  // namespace
}  // namespace tagfield::http
