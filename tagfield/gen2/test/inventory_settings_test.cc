// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/inventory_settings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

template <class Value>
std::string complaint(Value InventorySettings::*member, Value value) {
  InventorySettings settings;
  settings.*member = value;
  return error_of([&] { check(settings); });
}

TEST(InventorySettings, DefaultsAreGood) { EXPECT_NO_THROW(check(InventorySettings{})); }

TEST(InventorySettings, BadOnesAreNamedWithTheirRange) {
  using S = InventorySettings;
  EXPECT_EQ(complaint(&S::start_q, 16), "start_q must be from 0 to 15, is 16");
  EXPECT_EQ(complaint(&S::min_q, 5),
            "min_q must be from 0 to 4 (start_q, the Q of the first round), is 5");
  EXPECT_EQ(complaint(&S::min_q, -1),
            "min_q must be from 0 to 4 (start_q, the Q of the first round), is -1");
  EXPECT_EQ(complaint(&S::max_q, 3),
            "max_q must be from 4 (start_q, the Q of the first round) to 15, is 3");
  EXPECT_NE(complaint(&S::max_q, 16), "(no error)");
  EXPECT_EQ(complaint(&S::q_step, 0.5), "q_step must be more than 0.1 and less than 0.5, is 0.5");
  EXPECT_EQ(complaint(&S::capture_db, std::optional<double>(-1.0)),
            "capture must be from 0 to 1000 dB, is -1");
  EXPECT_EQ(complaint(&S::power_up_s, 11.0), "power_up must be from 0 to 10 s, is 11");
  EXPECT_EQ(complaint(&S::round_overhead_s, -0.1),
            "round_overhead must be from 0 to 10 s, is -0.1");
  EXPECT_NE(complaint(&S::slot_overhead_s, std::nan("")), "(no error)");
  EXPECT_NE(complaint(&S::read_overhead_s, -1.0), "(no error)");
}

}  // namespace
}  // namespace tagfield
