// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/tag_estimate.h"

#include <gtest/gtest.h>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

TEST(Verdict, HasAWordThatReadsBack) {
  EXPECT_EQ(to_string(Verdict::kLocated), "located");
  EXPECT_EQ(to_string(Verdict::kAmbiguous), "ambiguous");
  EXPECT_EQ(to_string(Verdict::kNotLocated), "not_located");
  for (const Verdict verdict : {Verdict::kLocated, Verdict::kAmbiguous, Verdict::kNotLocated}) {
    EXPECT_EQ(verdict_from_string(to_string(verdict)), verdict);
  }
}

TEST(Verdict, UnknownWordIsAnErrorThatNamesIt) {
  try {
    verdict_from_string("lost");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'lost'"), std::string::npos);
  }
}

}  // namespace
}  // namespace tagfield
