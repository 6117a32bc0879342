// SPDX-License-Identifier: Apache-2.0
/// @file
/// What other readers' signals do to a link: as noise at the reader, as another carrier at the tag.
/// See docs/interference.md.
#pragma once

#include <string>
#include <vector>

#include "tagfield/field/radio_link.h"

namespace tagfield {

/// Another reader's antenna that sends.
struct OtherSender {
  std::string reader;
  std::string antenna;
  RadioView view;           ///< From there, with its images.
  double time_share = 1.0;  ///< Of its time in which it sends.
};

/// A sender's power at a reader's port.
struct ReceivedSender {
  double whole_mw = 0.0;
  double in_replies_mw = 0.0;  ///< What comes through with the tags' replies.
};

/// Of `sender` at the view's receiving antenna, whose images are there; `paths` is workspace.
ReceivedSender received_from(const OtherSender& sender, const RadioView& view,
                             std::vector<RadioPath>& paths);

/// At the tag's chip [mW].
double power_at_tag_mw(const OtherSender& sender, const TagEnd& tag, std::vector<RadioPath>& paths);

/// What a link has against it; nothing by default.
struct Disturbance {
  double in_replies_mw = 0.0;  ///< At the reader's port.
  double at_tag_mw = 0.0;      ///< Of other readers' carriers, at the chip.
};

/// How much stronger than all other carriers a tag's reader must be there for its commands to be
/// made out: a carrier of more than half of the modulation's depth beside it, 0.9 in Gen2 (Table
/// 6.6), moves an envelope across its threshold: 20 log10(2/0.9).
inline constexpr double kTagCapture_db = 6.94;

/// Whether the tag makes out its reader's commands.
bool hears_commands(const RadioLink& link, const Disturbance& disturbance);

/// Its reader's carrier over all others at the chip [dB].
double capture_db(const RadioLink& link, const Disturbance& disturbance);

}  // namespace tagfield
