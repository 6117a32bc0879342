// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a live reader is told to do, over what its scenario says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/gen2/inventory_settings.h"
#include "tagfield/gen2/link_timing.h"
#include "tagfield/reader/antenna.h"
#include "tagfield/reader/channel_plan.h"

namespace tagfield {

/// One antenna of a reader at work. What is not given is as the scenario says.
struct AntennaDuty {
  std::string antenna;
  std::optional<double> transmit_power_dbm;
};

/// What a reader does from now on, until told otherwise. What is not given is as the scenario says.
struct ReaderDuty {
  std::vector<AntennaDuty>
      antennas;  ///< That send, in the order of their turns; all others are off.
  std::optional<Session> session;
  std::optional<Target> target;
  std::optional<int> start_q;
  std::optional<bool> adaptive_q;
  std::optional<LinkSettings> link;
  std::optional<ChannelPlan> plan;
};

/// The antenna as its reader's duty has it: one of the duty's antennas. What the duty asks for and
/// has no effect, as all of it has none on an antenna of the paper's model, is warned of. Throws
/// Error where a value is out of range.
AntennaParameters on_duty(const AntennaParameters& antenna, const ReaderDuty& duty,
                          std::vector<std::string>& warnings);

}  // namespace tagfield
