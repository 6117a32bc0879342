// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world as JSON, for pages and programs; docs/live.md and openapi.json describe the contents.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tagfield/localization/tag_estimate.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield::http {

using Json = nlohmann::ordered_json;

/// Text on one line; invalid UTF-8 is replaced.
std::string json_text(const Json& json);

/// [x, y, z].
Json point_json(const Eigen::Vector3d& p);
/// [x, y, z, qx, qy, qz, qw].
Json pose_json(const RigidTransform& X);

/// The static world: solids with their shapes and materials; each mesh occurs once.
Json solids_json(const Scene& scene, const Scenario& scenario);
/// Obstacles that exist at `now` or will appear, at their positions; with their motion, and with
/// the times at which they appear and disappear, if they do.
Json obstacles_json(const Scenario& scenario, Time now);
/// Waypoints of robots, beginning at their start.
Json paths_json(const Scenario& scenario);

/// Gain relative to the maximum [dB], on a grid of the angle off the boresight and the azimuth
/// about it; null for the paper's antenna, which has no pattern.
Json beam_json(const AntennaParameters& antenna);
/// `kinds`: of the tags, for the range (see largest_range_m()).
Json antenna_json(const AntennaSpec& spec, const RigidTransform& X_WA, std::size_t port,
                  const std::vector<std::shared_ptr<const TagModel>>& kinds);

/// [xx, xy, yy] of the position's covariance [m²]; if it has none, that of an isotropic one with
/// the same expected error.
Json covariance_json(const Candidate& place);

}  // namespace tagfield::http
