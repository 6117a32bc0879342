// SPDX-License-Identifier: Apache-2.0
/// @file
/// All links of a plan: each way of mounting an antenna with each position and orientation of a
/// tag.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tagfield/channel/moving_body.h"
#include "tagfield/planning/forecast.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {

/// A tag of a group at one pose.
struct LinkRow {
  std::size_t group = 0;        ///< Index into PlanSpec::tags.
  std::size_t place = 0;        ///< Index into the group's positions (PlanTags::places),
  std::size_t orientation = 0;  ///< and orientations.
  std::size_t stop = 0;         ///< On the group's path; 0 at rest.
  RigidTransform X_WT;
};

/// A mount with one orientation of its antenna.
struct LinkColumn {
  std::size_t mount = 0;  ///< Index into PlanSpec::mounts.
  std::size_t look = 0;   ///< Index into PlanMount::X_WA.
};

/// A stop at which a pallet is evaluated.
struct PlanStop {
  double begin_s = 0.0;
  double end_s = 0.0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
};

/// The path as stops at most 0.5 m apart; a single one from 0 to `dwell_s` if there is no path.
std::vector<PlanStop> stops_of(const PlanTags& tags, double dwell_s);

/// Fading states of all links, one byte each (LinkStates).
struct LinkMatrix {
  std::vector<LinkRow> rows;
  std::vector<LinkColumn> columns;
  std::vector<std::size_t> carriers;            ///< By column.
  std::vector<std::vector<std::int8_t>> steps;  ///< By column: all rows, 9 × carriers each.

  [[nodiscard]] LinkStates states(std::size_t column, std::size_t row) const;
};

/// All rows of one position and orientation, one per stop.
struct LinkElement {
  std::size_t first_row = 0;
  std::size_t stops = 1;
};
/// In the order of the rows.
std::vector<LinkElement> elements_of(const LinkMatrix& matrix);

struct LinkMatrixRequest {
  std::uint64_t seed = 1;
  int threads = 1;                   ///< The result does not depend on it.
  std::string folder;                ///< Cache of columns; "" for none.
  std::vector<MovingBody> bodies{};  ///< That block waves, at these poses.
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> on_progress;
};

/// How much of a matrix was already in the cache.
struct LinkMatrixCounts {
  std::size_t columns = 0;
  std::size_t kept = 0;     ///< Read from the folder.
  std::size_t damaged = 0;  ///< Found there but incomplete; computed again.
};

/// Evaluates all links without the plan's `margin_db`. Columns found in the folder are read from
/// there; each other one is written when it is done, so that an interrupted evaluation can resume.
/// Throws Error if it was stopped, if a mount is inside a solid, or if the matrix would take over 4
/// GB.
LinkMatrix evaluate_links(const ScenarioToPlan& to_plan, const LinkMatrixRequest& request,
                          LinkMatrixCounts& counts);

}  // namespace tagfield
