// SPDX-License-Identifier: Apache-2.0
/// @file
/// Commands to a live reader that override its scenario.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/gen2/inventory_settings.h"
#include "tagfield/gen2/link_timing.h"
#include "tagfield/reader/antenna.h"
#include "tagfield/reader/channel_plan.h"

namespace tagfield {

/// One active antenna of a reader. Settings that are not given are as in the scenario.
struct AntennaDuty {
  std::string antenna;
  std::optional<double> transmit_power_dbm;
};

/// What a reader does until the next duty. Settings that are not given are as in the scenario.
struct ReaderDuty {
  std::vector<AntennaDuty> antennas;  ///< In the order of their turns; all others are off.
  std::optional<Session> session;
  std::optional<Target> target;
  std::optional<int> start_q;
  std::optional<bool> adaptive_q;
  std::optional<LinkSettings> link;
  std::optional<ChannelPlan> plan;
};

/// The antenna, which must be one of the duty's, with the settings of its reader's duty. Warns of
/// settings without effect; an antenna of the paper's model ignores all of them. Throws Error if a
/// value is out of range.
AntennaParameters on_duty(const AntennaParameters& antenna, const ReaderDuty& duty,
                          std::vector<std::string>& warnings);

}  // namespace tagfield
