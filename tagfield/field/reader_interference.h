// SPDX-License-Identifier: Apache-2.0
/// @file
/// Effects of other readers' signals on a link: noise at the reader, and a second carrier at the
/// tag. See docs/interference.md.
#pragma once

#include <string>
#include <vector>

#include "tagfield/field/radio_link.h"

namespace tagfield {

/// A transmitting antenna of another reader.
struct OtherSender {
  std::string reader;
  std::string antenna;
  RadioView view;           ///< From its pose, with its images.
  double time_share = 1.0;  ///< Share of the time in which it transmits.
};

/// A sender's power at a reader's port.
struct ReceivedSender {
  double whole_mw = 0.0;
  double in_replies_mw = 0.0;  ///< Its power in the band of the tags' replies.
};

/// The power of `sender` at the view's receiving antenna, whose images must be there; `paths` is
/// workspace.
ReceivedSender received_from(const OtherSender& sender, const RadioView& view,
                             std::vector<RadioPath>& paths);

/// At the tag's chip [mW].
double power_at_tag_mw(const OtherSender& sender, const TagEnd& tag, std::vector<RadioPath>& paths);

/// The interference on a link; none by default.
struct Disturbance {
  double in_replies_mw = 0.0;  ///< At the reader's port.
  double at_tag_mw = 0.0;      ///< Power of other readers' carriers, at the chip.
};

/// By how much a tag's reader must be stronger than all other carriers at the tag for its commands
/// to be decoded: an interfering carrier of more than half the modulation depth, 0.9 in Gen2 (Table
/// 6.6), can move the envelope across the tag's threshold: 20 log10(2/0.9).
inline constexpr double kTagCapture_db = 6.94;

/// Whether the tag decodes its reader's commands.
bool hears_commands(const RadioLink& link, const Disturbance& disturbance);

/// Power of its reader's carrier over that of all others at the chip [dB].
double capture_db(const RadioLink& link, const Disturbance& disturbance);

}  // namespace tagfield
