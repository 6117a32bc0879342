// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where tags of a given kind would be read, and which of the scenario's own tags are. See
/// docs/coverage.md.
#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "tagfield/planning/drive_samples.h"
#include "tagfield/planning/local_link.h"
#include "tagfield/report/coverage.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

struct CoverageRequest {
  std::vector<std::size_t> antennas;    ///< Indices into Scenario::antennas.
  std::shared_ptr<const TagModel> tag;  ///< The kind of tag; must be set.
  Orientations orientations;            ///< Of a tag at a grid cell.
  std::vector<double> heights_m;        ///< One layer each.
  CoverageGrid grid;
  std::vector<MovingBody> bodies;  ///< That block waves to all tags and cells, at these poses.
  std::uint64_t seed = 1;
  int threads = 1;                                ///< The results do not depend on it.
  const std::atomic<bool>* stop = nullptr;        ///< Set by the caller to end early.
  std::function<void(double share)> on_progress;  ///< Called from time to time; may be empty.
};

/// Warns of effects that the scenario enables and that maps of coverage and the forecast of a run
/// leave out: interference of other readers, coupling of tags, capture.
void warn_of_effects_left_out(const Scenario& scenario, Diagnostics& diagnostics);

/// Grid and tags of the request over all poses of `samples`; texts are left to the caller. Throws
/// Error if it was stopped.
Coverage cover(const Scenario& scenario, const std::vector<DriveSample>& samples,
               const CoverageRequest& request);

/// Throws Error if the request was stopped.
void throw_if_stopped(const CoverageRequest& request);

/// A grid of cells of `step_m` that covers `region` [m]. Throws Error if that takes more than
/// `max_cells`.
CoverageGrid grid_over(const Eigen::AlignedBox2d& region, double step_m,
                       std::size_t max_cells = 4'000'000);

/// Number of links to evaluate for the grid: cells × layers × antenna poses.
double links_of(const std::vector<DriveSample>& samples, const CoverageRequest& request);

}  // namespace tagfield
