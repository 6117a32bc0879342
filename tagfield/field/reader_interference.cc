// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/reader_interference.h"

#include "tagfield/base/units.h"

namespace tagfield {

ReceivedSender received_from(const OtherSender& sender, const RadioView& view,
                             std::vector<RadioPath>& paths) {
  const RadioModel& from = sender.view.model;
  const RadioModel& to = view.model;
  const std::complex<double> h =
      gain_to_antenna(view, from.antenna, sender.view.X_WA, sender.view.diffuse_key, paths);
  ReceivedSender received;
  received.whole_mw = sender.time_share * std::norm(h) *
                      from_db(from.transmit_power_dbm - from.cable_loss_db - to.cable_loss_db);
  const double offset_hz =
      kSpeedOfLight / sender.view.carrier.lambda_m - kSpeedOfLight / view.carrier.lambda_m;
  received.in_replies_mw =
      received.whole_mw * share_in_replies(transmit_spectrum_of(from), offset_hz, reply_link_of(to),
                                           to.hardware.bandwidth_hz);
  return received;
}

double power_at_tag_mw(const OtherSender& sender, const TagEnd& tag,
                       std::vector<RadioPath>& paths) {
  TagEnd of_sender = tag;
  of_sender.images = nullptr;  // They are only valid for ends inside the same solids.
  return sender.time_share * from_db(link_of(sender.view, of_sender, paths).tag_dbm);
}

double capture_db(const RadioLink& link, const Disturbance& disturbance) {
  return link.tag_dbm - to_db(disturbance.at_tag_mw);
}

bool hears_commands(const RadioLink& link, const Disturbance& disturbance) {
  return !(disturbance.at_tag_mw > 0.0) || capture_db(link, disturbance) >= kTagCapture_db;
}

}  // namespace tagfield
