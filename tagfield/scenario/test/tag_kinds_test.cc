// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/tag_kinds.h"

#include <gtest/gtest.h>

#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

TEST(TagKinds, AreThereOnceEach) {
  const auto label = std::make_shared<const TagModel>();
  Scenario scenario;
  EXPECT_TRUE(kinds_of_tags(scenario).empty());
  scenario.tags.resize(4);
  scenario.tags[1].model = scenario.tags[3].model = label;
  const auto kinds = kinds_of_tags(scenario);
  ASSERT_EQ(kinds.size(), 2U);
  EXPECT_EQ(kinds[0]->sensitivity_dbm, default_tag_model()->sensitivity_dbm);
  EXPECT_EQ(kinds[1], label);
}

}  // namespace
}  // namespace tagfield
