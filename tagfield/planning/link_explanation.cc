// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/link_explanation.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/field/port_turns.h"
#include "tagfield/planning/internal/disturbed_link.h"
#include "tagfield/planning/internal/link_budget_lines.h"
#include "tagfield/planning/link_verdict.h"
#include "tagfield/planning/moment.h"

namespace tagfield {
namespace {

/// Powers below this count as nothing [dBm].
constexpr double kNothing_dbm = -250.0;
/// Least distance: with both ends at one point, the paper's RSSI would diverge [m].
constexpr double kMinLinkDistance = 1e-3;

std::optional<Time> turn_of(const Scenario& scenario, const std::string& antenna, Time time) {
  for (const PortCycle& cycle : port_cycles(physical_antennas(scenario))) {
    if (const auto turn = next_turn(cycle, antenna, time)) return turn;
  }
  return std::nullopt;
}

PaperLink paper_link(const LinkQuestion& question, double distance_m) {
  const AntennaParameters& antenna = question.antenna.parameters;
  const double apart_m = std::max(distance_m, kMinLinkDistance);
  PaperLink link;
  const PaperAntenna& model = paper(antenna);
  link.range_m = model.range_m;
  link.update = update_stamp(
      antenna,
      std::max<std::int64_t>(first_update_at(antenna, question.time + Duration(1)) - 1, 0));
  link.perturbed_range_m = perturbed_range(antenna, link.update, question.seed);
  link.read_probability = read_probability(antenna, distance_m);
  link.phase_rad = paper_phase(model.model, apart_m, 0.0);
  link.rssi_dbm = paper_rssi_dbm(model.model, apart_m, 0.0);
  link.sensitivity_dbm = model.sensitivity_dbm;
  return link;
}

void add_receiver(const RadioModel& model, const RadioLink& of_link, const CarrierNow& carrier,
                  const Disturbance& disturbance, PhysicalLink& link) {
  const ReaderHardware& hardware = model.hardware;
  const Reply reply = reply_of(of_link, carrier.phase_offset_rad, Eigen::Vector3d::Zero());
  link.snr_db = of_link.reply_dbm - noise_dbm(hardware);
  link.phase_rad = wrap_to_two_pi(reply.phase_rad);
  // The phase of a reply far below the noise is uniform over 2π.
  const double uniform_rad = kPi / std::sqrt(3.0);
  link.phase_sigma_rad = uniform_rad;
  if (!link.arrives) return;
  const double sigma = phase_sigma(hardware, of_link.reply_dbm, disturbance.in_replies_mw);
  if (std::isfinite(sigma)) link.phase_sigma_rad = std::min(sigma, uniform_rad);
}

PhysicalLink physical_link(const Scenario& scenario, const LinkQuestion& question) {
  const AntennaParameters& antenna = question.antenna.parameters;
  const RadioModel& model = *physical(antenna);
  const std::shared_ptr<const RadioWorld> world = radio_world_of(scenario);
  const RadioPort port = port_of(scenario, antenna, question.seed);
  const CarrierNow carrier = carrier_at(model, port, question.time);
  RadioView view = view_from(model, *world, question.X_WA, carrier.frequency_hz, port.antenna_key,
                             question.seed);
  if (model.effects.bodies) view.bodies = question.bodies;
  const auto kind = question.tag.model ? question.tag.model : default_tag_model();
  TagEnd tag{*kind, question.X_WT, stream_key(question.tag.id)};
  const Surrounded surrounded = tags_around(view, question);
  if (!surrounded.near.empty()) tag.around = &surrounded.around;
  std::vector<RadioPath> paths;
  const RadioLink of_link = link_of(view, tag, paths);

  PhysicalLink link;
  link.tag_dbm = of_link.tag_dbm;
  link.tag_sensitivity_dbm = kind->sensitivity_dbm;
  link.reply_dbm = of_link.reply_dbm;
  link.reader_sensitivity_dbm = model.hardware.sensitivity_dbm;
  link.arrives = of_link.tag_dbm > kNothing_dbm && of_link.reply_dbm > kNothing_dbm;
  link.channel = carrier.channel;
  link.frequency_hz = carrier.frequency_hz;
  link.near_tags = surrounded.near;
  const Disturbance disturbance = add_interference(scenario, question, view, tag, of_link, link);
  add_receiver(model, of_link, carrier, disturbance, link);
  add_budget(view, tag, of_link, link);
  link.takes_inventory = takes_inventory(model);
  if (link.takes_inventory) {
    link.turn = turn_of(scenario, antenna.name, question.time);
    const std::optional<TagOnAir> heard = on_air(model, of_link, tag, disturbance);
    link.decode_probability = heard ? heard->decode_probability : 0.0;
  }
  return link;
}

double normal_above(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

/// Fraction of replies whose RSSI by eq. (5) is at least the antenna's sensitivity.
double heard_probability(const PaperAntenna& antenna, double distance_m) {
  if (!antenna.sensitivity_dbm) return 1.0;
  // RSSIs are integers.
  const double min_dbm = std::ceil(*antenna.sensitivity_dbm) - 0.5;
  const double least = std::pow(10.0, min_dbm / 40.0);
  const double apart_m = std::max(distance_m, kMinLinkDistance);
  const double amplitude = antenna.model.communication_gain *
                           wavelength(antenna.model.frequency_hz) / (4.0 * kPi * apart_m);
  const double sigma = antenna.model.rssi_noise;
  if (!(sigma > 0.0)) return amplitude >= least ? 1.0 : 0.0;
  return normal_above((least - amplitude) / sigma) + normal_above((least + amplitude) / sigma);
}

}  // namespace

double read_probability(const AntennaParameters& antenna, double distance_m) {
  const PaperAntenna& model = paper(antenna);
  const double heard = heard_probability(model, distance_m);
  const double share = distance_m / model.range_m;
  if (!(model.range_sigma > 0.0)) return share <= 1.0 ? heard : 0.0;
  const double probability = normal_above((share - 1.0) / model.range_sigma) +
                             normal_above((share + 1.0) / model.range_sigma);
  return heard * std::clamp(probability, 0.0, 1.0);
}

std::vector<AntennaParameters> physical_antennas(const Scenario& scenario) {
  std::vector<AntennaParameters> all;
  for (const AntennaSpec& antenna : scenario.antennas) {
    if (meets_world(antenna.parameters)) all.push_back(antenna.parameters);
  }
  return all;
}

RadioPort port_of(const Scenario& scenario, const AntennaParameters& antenna, std::uint64_t seed) {
  return {stream_key(antenna.name), stream_key(antenna.reader),
          reader_number(physical_antennas(scenario), antenna.reader), seed};
}

double sum_of(const std::vector<BudgetLine>& lines) {
  double sum = 0.0;
  for (const BudgetLine& line : lines) sum += line.db;
  return sum;
}

LinkExplanation explain_link(const Scenario& scenario, const LinkQuestion& question) {
  LinkExplanation link;
  link.antenna = question.antenna.parameters.name;
  link.reader = question.antenna.parameters.reader;
  link.tag = question.tag.id;
  link.time = question.time;
  link.X_WA = question.X_WA;
  link.X_WT = question.X_WT;
  link.distance_m = (question.X_WT.translation - question.X_WA.translation).norm();
  link.absent = absence_of(question.tag, question.time);
  if (meets_world(question.antenna.parameters)) {
    link.physical = physical_link(scenario, question);
  } else {
    link.paper = paper_link(question, link.distance_m);
  }
  judge(question, link);
  return link;
}

}  // namespace tagfield
