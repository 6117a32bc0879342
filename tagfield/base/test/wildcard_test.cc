// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/wildcard.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace tagfield {
namespace {

TEST(Wildcard, MatchesTheWholeName) {
  EXPECT_TRUE(matches("port_*", "port_16"));
  EXPECT_TRUE(matches("port_?", "port_1"));
  EXPECT_FALSE(matches("port_?", "port_16"));
  EXPECT_FALSE(matches("port", "port_1"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("*_left_*", "dock_1_left_2"));
  EXPECT_TRUE(matches("a*ab", "aaab"));
  EXPECT_FALSE(matches("a*ab", "aaba"));
  EXPECT_TRUE(is_pattern("a?"));
  EXPECT_FALSE(is_pattern("a.b"));
}

/// Tries everything that the first star may match.
bool naively_matches(const std::string& pattern, const std::string& name) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() == '*') {
    for (std::size_t taken = 0; taken <= name.size(); ++taken) {
      if (naively_matches(pattern.substr(1), name.substr(taken))) return true;
    }
    return false;
  }
  if (name.empty() || (pattern.front() != '?' && pattern.front() != name.front())) return false;
  return naively_matches(pattern.substr(1), name.substr(1));
}

RC_GTEST_PROP(Wildcard, IsWhatTryingAllSays, ()) {
  const auto word = [](const char* letters) {
    return *rc::gen::container<std::string>(rc::gen::elementOf(std::string(letters))).as("a word");
  };
  const std::string pattern = word("ab*?").substr(0, 8);
  const std::string name = word("ab").substr(0, 10);
  RC_ASSERT(matches(pattern, name) == naively_matches(pattern, name));
}

}  // namespace
}  // namespace tagfield
