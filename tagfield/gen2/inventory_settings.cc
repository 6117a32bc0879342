#include "tagfield/gen2/inventory_settings.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

void check_q(const char* name, int value, int least, int most) {
  if (value < least || value > most) {
    throw Error(fmt::format("{} must be from {} to {}, and is {}", name, least, most, value));
  }
}

void check_not_negative(const char* name, double value, const char* unit, double most) {
  if (!(value >= 0.0 && value <= most)) {
    throw Error(fmt::format("{} must be from 0 to {} {}, and is {}", name, most, unit, value));
  }
}

}  // namespace

void check(const InventorySettings& settings) {
  check_q("start_q", settings.start_q, 0, 15);
  check_q("min_q", settings.min_q, 0, settings.start_q);
  check_q("max_q", settings.max_q, settings.start_q, 15);
  if (!(settings.q_step > 0.1 && settings.q_step < 0.5)) {
    throw Error(
        fmt::format("q_step must be more than 0.1 and less than 0.5, and is {}", settings.q_step));
  }
  if (settings.capture_db) check_not_negative("capture", *settings.capture_db, "dB", 1000.0);
  check_not_negative("power_up", settings.power_up_s, "s", 10.0);
  check_not_negative("round_overhead", settings.round_overhead_s, "s", 10.0);
  check_not_negative("slot_overhead", settings.slot_overhead_s, "s", 10.0);
  check_not_negative("read_overhead", settings.read_overhead_s, "s", 10.0);
}

}  // namespace tagfield
