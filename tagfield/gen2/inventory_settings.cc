// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/inventory_settings.h"

#include <fmt/format.h>

#include "tagfield/base/range_check.h"

namespace tagfield {

void check(const InventorySettings& settings) {
  require_in_range("start_q", settings.start_q, 0, 15);
  require(settings.min_q >= 0 && settings.min_q <= settings.start_q, "min_q",
          fmt::format("from 0 to {} (start_q, the Q of the first round)", settings.start_q),
          settings.min_q);
  require(settings.max_q >= settings.start_q && settings.max_q <= 15, "max_q",
          fmt::format("from {} (start_q, the Q of the first round) to 15", settings.start_q),
          settings.max_q);
  require(settings.q_step > 0.1 && settings.q_step < 0.5, "q_step",
          "more than 0.1 and less than 0.5", settings.q_step);
  if (settings.capture_db) require_in_range("capture", *settings.capture_db, 0.0, 1000.0, "dB");
  require_in_range("power_up", settings.power_up_s, 0.0, 10.0, "s");
  require_in_range("round_overhead", settings.round_overhead_s, 0.0, 10.0, "s");
  require_in_range("slot_overhead", settings.slot_overhead_s, 0.0, 10.0, "s");
  require_in_range("read_overhead", settings.read_overhead_s, 0.0, 10.0, "s");
}

}  // namespace tagfield
