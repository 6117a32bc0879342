// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/rf_modes.h"

#include <gtest/gtest.h>

namespace tagfield::llrp {
namespace {

TEST(RfModes, AreWhatGen2Allows) {
  for (const RfMode& mode : rf_modes()) {
    if (mode.link) {
      EXPECT_NO_THROW(check(*mode.link)) << mode.id;
    }
    EXPECT_EQ(find_mode(mode.id), &mode);
  }
  EXPECT_EQ(find_mode(99), nullptr);
}

TEST(Powers, RiseInQuartersOfADecibelAndAreFoundAgain) {
  const std::vector<double> table = power_table(31.5);
  EXPECT_EQ(table.front(), 10.0);
  EXPECT_EQ(table.back(), 31.5);
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(power_index_of(table, table[i]), i + 1);
    if (i > 0) {
      EXPECT_EQ(table[i] - table[i - 1], 0.25);
    }
  }
  EXPECT_EQ(power_table(20.0).back(), 30.0);  // tables extend to at least 30 dBm
}

}  // namespace
}  // namespace tagfield::llrp
