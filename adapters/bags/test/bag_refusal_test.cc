// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "adapters/bags/bag_recording.h"
#include "adapters/bags/bag_structure.h"
#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

TEST(BagRefusal, SaysWhichOptionReadsBags) {
  Diagnostics diagnostics;
  EXPECT_TRUE(is_bag("runs/run.bag"));
  EXPECT_EQ(error_of([&] { require_whole_bag("runs/run.bag", diagnostics); }),
            "runs/run.bag: this tagfield was built without ROS 1 and cannot read bags; build it "
            "again after 'scripts/setup --ros' (TAGFIELD_ROS1)");
}

}  // namespace
}  // namespace tagfield
