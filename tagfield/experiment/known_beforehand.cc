// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/known_beforehand.h"

#include <algorithm>

#include "tagfield/experiment/known_world.h"
#include "tagfield/experiment/odometry_drift.h"
#include "tagfield/field/antenna_facts.h"

namespace tagfield {
namespace {

TagHeights heights_of(const Scenario& scenario) {
  const LocalizationSpec& spec = scenario.localization;
  TagHeights heights;
  if (spec.known_height == KnownHeight::kNumber) heights.of_all = spec.height_m;
  if (spec.known_height == KnownHeight::kAbove) heights.estimated = HeightSide::kAbove;
  if (spec.known_height == KnownHeight::kBelow) heights.estimated = HeightSide::kBelow;
  if (spec.known_height != KnownHeight::kTag) return heights;
  for (const TagSpec& tag : scenario.tags) {
    if (!moves(tag)) heights.of_tag[tag.id] = tag.motion.front().X_WB.translation.z();
  }
  return heights;
}

std::map<std::string, Eigen::Vector3d> reference_tags_of(const Scenario& scenario) {
  std::map<std::string, Eigen::Vector3d> places;
  for (const std::string& id : scenario.localization.reference_tags) {
    const auto tag = std::find_if(scenario.tags.begin(), scenario.tags.end(),
                                  [&](const TagSpec& spec) { return spec.id == id; });
    if (tag == scenario.tags.end())
      throw Error("reference tag '" + id + "' is not a tag of the scenario");
    if (moves(*tag)) throw Error("reference tag '" + id + "' moves");
    places[id] = tag->motion.front().X_WB.translation;
  }
  return places;
}

/// Offsets of the paper's model; those of the physical models' readers are unknown.
std::vector<KnownOffset> offsets_of(const Scenario& scenario) {
  std::vector<KnownOffset> offsets;
  if (!scenario.localization.offset_known) return offsets;
  for (const AntennaSpec& antenna : scenario.antennas) {
    const AntennaParameters& parameters = antenna.parameters;
    const std::optional<StatedPhase> stated = stated_phase(parameters);
    if (!stated) {
      throw Error("antenna '" + parameters.name +
                  "': localization.offset can only be known with model: paper");
    }
    offsets.push_back({parameters.name, std::nullopt, stated->offset_rad});
  }
  return offsets;
}

/// The error model stated by the pose source; none for odometry and laser.
std::optional<PoseErrorModel> pose_error_of(const Scenario& scenario) {
  const PoseBelief& pose = scenario.pose;
  if (scenario.localization.pose_error) return scenario.localization.pose_error;
  if (!odometry_of(scenario).empty()) return std::nullopt;
  const bool any_on_a_robot =
      std::any_of(scenario.antennas.begin(), scenario.antennas.end(),
                  [](const AntennaSpec& antenna) { return !antenna.on.empty(); });
  // Poses of fixed and recorded antennas are known exactly.
  if (pose.source == PoseSource::kTrue || !any_on_a_robot) return PoseErrorModel{};
  if (pose.source != PoseSource::kNoisy) return std::nullopt;
  return PoseErrorModel{pose.sigma_m, pose.yaw_sigma_rad, pose.time_constant_s};
}

/// Antennas with circular polarization, where a tag's phase depends on the orientation of its
/// dipole.
std::map<std::string, Hand> circular_antennas(const Scenario& scenario) {
  std::map<std::string, Hand> circular;
  for (const AntennaSpec& antenna : scenario.antennas) {
    const auto kind = polarization_of(antenna.parameters);
    if (!kind || *kind == PolarizationKind::kLinear) continue;
    circular[antenna.parameters.name] =
        *kind == PolarizationKind::kRightCircular ? Hand::kRight : Hand::kLeft;
  }
  return circular;
}

}  // namespace

KnownBeforehand known_beforehand(const Scenario& scenario) {
  KnownBeforehand known;
  known.heights = heights_of(scenario);
  known.reference_tags = reference_tags_of(scenario);
  known.offsets = offsets_of(scenario);
  known.pose_error = pose_error_of(scenario);
  known.drift = odometry_drift(scenario);
  known.pi_ambiguity = scenario.localization.pi_ambiguity;
  known.area = scenario.localization.area;
  known.limits = scenario.localization.limits;
  known.trace = traced_replies(scenario);
  known.circular = circular_antennas(scenario);
  // Successive poses of an antenna are separated by its update interval.
  for (const AntennaSpec& antenna : scenario.antennas) {
    known.max_pose_gap_s = std::max(known.max_pose_gap_s, 1.5 / antenna.parameters.rate_hz);
  }
  return known;
}

}  // namespace tagfield
