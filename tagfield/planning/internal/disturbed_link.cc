// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/internal/disturbed_link.h"

#include <algorithm>

#include "tagfield/base/units.h"
#include "tagfield/field/port_turns.h"
#include "tagfield/field/tag_coupling.h"

namespace tagfield {
namespace {

/// The tags, with that of the question as number 0.
TagPopulation population_of(const LinkQuestion& question,
                            const std::vector<std::shared_ptr<const TagModel>>& kinds) {
  constexpr double kCell_m = 1.0;
  TagPopulation tags(kCell_m);
  const auto add = [&](const TagSpec& tag, const RigidTransform& X_WT) {
    const auto slot = static_cast<std::uint32_t>(tags.size());
    tags.add(slot, tag.id, X_WT.translation);
    tags.turn(slot, X_WT.rotation);
    tags.set_model(slot, kinds[slot]);
  };
  add(question.tag, question.X_WT);
  for (const OtherTag& other : question.other_tags) add(other.tag, other.X_WT);
  return tags;
}

std::vector<std::shared_ptr<const TagModel>> kinds_of(const LinkQuestion& question) {
  const std::shared_ptr<const TagModel> otherwise = default_tag_model();
  const auto kind = [&](const TagSpec& tag) { return tag.model ? tag.model : otherwise; };
  std::vector<std::shared_ptr<const TagModel>> kinds = {kind(question.tag)};
  for (const OtherTag& other : question.other_tags) kinds.push_back(kind(other.tag));
  return kinds;
}

double forward_db(const RadioView& view, const TagEnd& tag) {
  std::vector<RadioPath> paths;
  return to_db(std::norm(link_of(view, tag, paths).forward));
}

/// Effect of the neighbour in `slot` on the field at the chip of the first tag if it were the only
/// one.
double alone_db(const RadioView& view, const TagPopulation& tags, std::uint32_t slot) {
  const TagEnd alone{tags.model(0), tags.pose(0), tags.key(0)};
  const Eigen::RowVectorXcd shares =
      shares_among({{&tags.model(0), tags.pose(0)}, {&tags.model(slot), tags.pose(slot)}},
                   view.carrier.lambda_m);
  const TagSurroundings around{shares(0),
                               {{&tags.model(slot), tags.pose(slot), tags.key(slot), shares(1)}}};
  TagEnd coupled = alone;
  coupled.around = &around;
  return forward_db(view, coupled) - forward_db(view, alone);
}

InterferingReader in_words(const OtherSender& sender, const RadioView& view, const TagEnd& tag) {
  std::vector<RadioPath> paths;
  const ReceivedSender received = received_from(sender, view, paths);
  InterferingReader one;
  one.reader = sender.reader;
  one.antenna = sender.antenna;
  one.offset_hz =
      kSpeedOfLight / sender.view.carrier.lambda_m - kSpeedOfLight / view.carrier.lambda_m;
  one.time_share = sender.time_share;
  one.received_dbm = to_db(received.whole_mw);
  one.in_replies_dbm = to_db(received.in_replies_mw);
  one.at_tag_dbm = to_db(power_at_tag_mw(sender, tag, paths));
  return one;
}

OtherSender sender_of(const Scenario& scenario, const LinkQuestion& question, const RadioView& view,
                      const OtherAntenna& place, double time_share) {
  const AntennaParameters& other = place.antenna.parameters;
  const RadioModel& model = *physical(other);
  const RadioPort port = port_of(scenario, other, question.seed);
  const CarrierNow carrier = carrier_at(model, port, question.time);
  RadioView from = view_from(model, view.world, place.X_WA, carrier.frequency_hz, port.antenna_key,
                             question.seed);
  if (model.effects.bodies) from.bodies = question.bodies;
  return {other.reader, other.name, from, time_share};
}

}  // namespace

Surrounded tags_around(const RadioView& view, const LinkQuestion& question) {
  Surrounded surrounded;
  if (!couples_tags(view.model)) return surrounded;
  surrounded.kinds = kinds_of(question);
  const TagPopulation tags = population_of(question, surrounded.kinds);
  TagCouplings couplings;
  couplings.see(tags);
  const CoupledTag coupled = couplings.of(0, view.carrier.lambda_m);
  surrounded.around.own = coupled.own;
  for (const auto& [slot, share] : coupled.neighbours) {
    const RigidTransform X_WT = tags.pose(slot);
    surrounded.around.neighbours.push_back(
        {surrounded.kinds[slot].get(), X_WT, tags.key(slot), share});
    surrounded.near.push_back({tags.id(slot), (X_WT.translation - question.X_WT.translation).norm(),
                               alone_db(view, tags, slot)});
  }
  std::stable_sort(surrounded.near.begin(), surrounded.near.end(),
                   [](const NearTag& a, const NearTag& b) { return a.distance_m < b.distance_m; });
  return surrounded;
}

Disturbance add_interference(const Scenario& scenario, const LinkQuestion& question,
                             const RadioView& view, const TagEnd& tag, const RadioLink& of_link,
                             PhysicalLink& link) {
  Disturbance sum;
  if (!is_disturbed(view.model)) return sum;
  LinkInterference all;
  const std::vector<AntennaParameters> antennas = physical_antennas(scenario);
  for (const SendingAntenna& sending :
       others_sending(antennas, question.antenna.parameters, question.time)) {
    for (const OtherAntenna& place : question.other_antennas) {
      if (place.antenna.parameters.name != antennas[sending.number].name) continue;
      all.by.push_back(
          in_words(sender_of(scenario, question, view, place, sending.time_share), view, tag));
      sum.in_replies_mw += from_db(all.by.back().in_replies_dbm);
      sum.at_tag_mw += from_db(all.by.back().at_tag_dbm);
    }
  }
  const ReaderHardware& hardware = view.model.hardware;
  all.noise_dbm = noise_dbm(hardware);
  all.total_dbm = to_db(from_db(all.noise_dbm) + sum.in_replies_mw);
  all.sinr_db = sinr_db(hardware, of_link.reply_dbm, sum.in_replies_mw);
  all.required_sinr_db = required_sinr_db(reply_bits(view.model));
  all.capture_db = capture_db(of_link, sum);
  all.required_capture_db = kTagCapture_db;
  link.interference = all;
  return sum;
}

}  // namespace tagfield
