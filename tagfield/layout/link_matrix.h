// SPDX-License-Identifier: Apache-2.0
/// @file
/// All links of a plan: each way of mounting an antenna with each place and orientation of a tag.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tagfield/planning/forecast.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {

/// A tag of a group, somewhere.
struct LinkRow {
  std::size_t group = 0;        ///< Index into PlanSpec::tags.
  std::size_t place = 0;        ///< Index into the group's places,
  std::size_t orientation = 0;  ///< and orientations.
  std::size_t stop = 0;         ///< On the group's path; 0 at rest.
  RigidTransform X_WT;
};

/// A mount and where its antenna looks.
struct LinkColumn {
  std::size_t mount = 0;  ///< Index into PlanSpec::mounts.
  std::size_t look = 0;   ///< Index into PlanMount::X_WA.
};

/// Where a pallet is looked at.
struct PlanStop {
  double begin_s = 0.0;
  double end_s = 0.0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
};

/// The path in stops at most 0.5 m apart; one from 0 to `dwell_s` where there is no path.
std::vector<PlanStop> stops_of(const PlanTags& tags, double dwell_s);

/// Fading states of all links, a byte each (LinkStates).
struct LinkMatrix {
  std::vector<LinkRow> rows;
  std::vector<LinkColumn> columns;
  std::vector<std::size_t> carriers;            ///< By column.
  std::vector<std::vector<std::int8_t>> steps;  ///< By column: row by row, 9 × carriers each.

  [[nodiscard]] LinkStates states(std::size_t column, std::size_t row) const;
};

/// All rows of one place and orientation, one a stop.
struct LinkElement {
  std::size_t first_row = 0;
  std::size_t stops = 1;
};
/// In the order of the rows.
std::vector<LinkElement> elements_of(const LinkMatrix& matrix);

struct LinkMatrixRequest {
  std::uint64_t seed = 1;
  int threads = 1;     ///< The result does not depend on it.
  std::string folder;  ///< Where columns are kept; "" for nowhere.
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> on_progress;
};

/// How much of a matrix was there already.
struct LinkMatrixCounts {
  std::size_t columns = 0;
  std::size_t kept = 0;     ///< Taken from the folder.
  std::size_t damaged = 0;  ///< Found there, but not whole; computed again.
};

/// Evaluates all links, as they are, without the plan's `margin_db`. A column that the folder holds
/// is taken from there, each other one is written when it is done: what was interrupted goes on.
/// Throws Error where it was stopped, where a mount is inside a solid, or where the matrix would
/// take over 4 GB.
LinkMatrix evaluate_links(const ScenarioToPlan& to_plan, const LinkMatrixRequest& request,
                          LinkMatrixCounts& counts);

}  // namespace tagfield
