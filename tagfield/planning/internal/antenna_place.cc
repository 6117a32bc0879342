// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/internal/antenna_place.h"

#include <algorithm>
#include <cmath>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {
namespace {

/// At shorter distances the paper's RSSI diverges [m].
constexpr double kMinDistance = 0.01;

}  // namespace

AntennaAtPose::AntennaAtPose(const Scenario& scenario, const AntennaSpec& antenna,
                             const RadioWorld& world, const RigidTransform& X_WA,
                             const std::vector<MovingBody>& bodies, std::uint64_t seed)
    : antenna_(antenna), p_WA_(X_WA.translation) {
  const RadioModel* const model = physical(antenna.parameters);
  if (model == nullptr) return;
  carriers_hz_ = sampled_carriers(*model);
  const double middle_hz = carriers_hz_[carriers_hz_.size() / 2];
  const RadioPort port = port_of(scenario, antenna.parameters, seed);
  view_.emplace(view_from(*model, world, X_WA, middle_hz, port.antenna_key, seed));
  if (model->effects.bodies) view_->bodies = bodies;
}

double AntennaAtPose::distance(const Eigen::Vector3d& p_WT) const {
  return std::max((p_WT - p_WA_).norm(), kMinDistance);
}

/// The margin is the excess of RSSI over that at the limit of the range, by eq. (5).
CoverageCell AntennaAtPose::look_by_paper(double distance_m) const {
  const AntennaParameters& parameters = antenna_.parameters;
  CoverageCell seen;
  seen.power_dbm = paper_rssi_dbm(paper(parameters).model, distance_m, 0.0);
  seen.reply_dbm = seen.power_dbm;
  seen.margin_db = 40.0 * std::log10(paper(parameters).range_m / distance_m);
  seen.probability = read_probability(parameters, distance_m);
  return seen;
}

CoverageCell AntennaAtPose::look(const TagEnd& tag, const Orientations& orientations,
                                 std::vector<RadioPath>& paths) const {
  if (!view_) return look_by_paper(distance(tag.X_WT.translation));
  const LocalLink link = local_link(*view_, tag, orientations, carriers_hz_, 0, paths);
  return {link.tag_dbm, link.reply_dbm, link.margin_db, link.probability, -1};
}

LinkStates AntennaAtPose::states(const TagEnd& tag, std::vector<RadioPath>& paths) const {
  if (!view_) return {};
  return LinkStates(fading_margins_db(*view_, tag, carriers_hz_, 0, paths));
}

double AntennaAtPose::max_margin_db(const TagModel& tag, const Eigen::Vector3d& p_WT) const {
  if (!view_) return 40.0 * std::log10(paper(antenna_.parameters).range_m / distance(p_WT));
  return tagfield::max_margin_db(view_->model, tag, distance(p_WT));
}

void merge(const CoverageCell& seen, int antenna, CoverageCell& cell) {
  const double probability = std::max(cell.probability, seen.probability);
  if (seen.margin_db >= kMinPower_db && seen.margin_db > cell.margin_db) {
    cell = seen;
    cell.antenna = antenna;
  }
  cell.probability = probability;
}

}  // namespace tagfield
