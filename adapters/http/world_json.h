// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world as JSON, for pages and programs: docs/live.md and openapi.json say what is in it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tagfield/localization/tag_estimate.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield::http {

using Json = nlohmann::ordered_json;

/// On one line; bytes that are no UTF-8 are replaced.
std::string json_text(const Json& json);

/// [x, y, z].
Json point_json(const Eigen::Vector3d& p);
/// [x, y, z, qx, qy, qz, qw].
Json pose_json(const RigidTransform& X);

/// The world at rest: solids with their shapes and what each is made of, meshes once each.
Json solids_json(const Scene& scene, const Scenario& scenario);
/// Those that are there `now` or will be, where they are; with their motion, and when they come and
/// go, where they do.
Json obstacles_json(const Scenario& scenario, Time now);
/// Waypoints of robots, from where they start.
Json paths_json(const Scenario& scenario);

/// Gain over direction against the greatest [dB], on a grid of the angle off the boresight and the
/// azimuth about it; null for the paper's antenna, which has none.
Json beam_json(const AntennaParameters& antenna);
Json antenna_json(const AntennaSpec& spec, const RigidTransform& X_WA, std::size_t port);

/// [xx, xy, yy] of the place's covariance [m²]; where it is not told as well known either way.
Json covariance_json(const Candidate& place);

}  // namespace tagfield::http
