// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/reader_duty.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "tagfield/base/error.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

const AntennaDuty& duty_of(const std::string& antenna, const ReaderDuty& duty) {
  const auto found =
      std::find_if(duty.antennas.begin(), duty.antennas.end(),
                   [&](const AntennaDuty& known) { return known.antenna == antenna; });
  if (found == duty.antennas.end()) {
    throw Error(fmt::format("antenna '{}' is not one of the duty's", antenna));
  }
  return *found;
}

bool asks_for_inventory(const ReaderDuty& duty) {
  return duty.session || duty.target || duty.start_q || duty.adaptive_q || duty.link;
}

void apply_inventory(const ReaderDuty& duty, Gen2Reader& gen2) {
  InventorySettings& inventory = gen2.inventory;
  inventory.session = duty.session.value_or(inventory.session);
  inventory.target = duty.target.value_or(inventory.target);
  inventory.adaptive_q = duty.adaptive_q.value_or(inventory.adaptive_q);
  inventory.start_q = duty.start_q.value_or(inventory.start_q);
  // The range of Q must contain the requested Q.
  inventory.min_q = std::min(inventory.min_q, inventory.start_q);
  inventory.max_q = std::max(inventory.max_q, inventory.start_q);
  gen2.link = duty.link.value_or(gen2.link);
  check(inventory);
  check(gen2.link);
}

}  // namespace

AntennaParameters on_duty(const AntennaParameters& antenna, const ReaderDuty& duty,
                          std::vector<std::string>& warnings) {
  const AntennaDuty& own = duty_of(antenna.name, duty);
  AntennaParameters changed = antenna;
  const RadioModel* const mounted = physical(antenna);
  const bool asks = own.transmit_power_dbm || duty.plan || asks_for_inventory(duty);
  if (mounted == nullptr) {
    if (asks) {
      warnings.push_back(fmt::format(
          "antenna '{}' has the paper's model: power, carriers, session and Q have no effect on it",
          antenna.name));
    }
    return changed;
  }
  auto model = std::make_shared<RadioModel>(*mounted);
  model->transmit_power_dbm = own.transmit_power_dbm.value_or(model->transmit_power_dbm);
  model->plan = duty.plan.value_or(model->plan);
  if (takes_inventory(*model)) {
    apply_inventory(duty, *model->gen2);
  } else if (asks_for_inventory(duty)) {
    warnings.push_back(fmt::format(
        "antenna '{}' takes no inventory: session, target, Q and mode have no effect on it",
        antenna.name));
  }
  Diagnostics diagnostics;
  check(*model, diagnostics);
  for (const std::string& odd : diagnostics.warnings()) {
    warnings.push_back(fmt::format("antenna '{}': {}", antenna.name, odd));
  }
  changed.model = std::shared_ptr<const RadioModel>(std::move(model));
  check(changed);
  return changed;
}

}  // namespace tagfield
