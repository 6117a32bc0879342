// SPDX-License-Identifier: Apache-2.0
/// @file
/// The input of `tagfield plan`: possible tag and antenna positions, limits, and the aim.
/// docs/plan.md lists the keys.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {

struct TagModel;

/// Tags of one kind, each at any of a set of positions.
struct PlanTags {
  std::string name;
  std::string zone;                       ///< "" for none.
  std::shared_ptr<const TagModel> model;  ///< Never null.
  std::vector<RawParameter> settings;     ///< As written in the file, for writing them back.
  /// Possible positions [m]: in the world, or on the pallet if there is a path.
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Quaterniond> orientations;  ///< Equally likely.
  Trajectory path;                               ///< Of the pallet; empty for tags at rest.
  std::size_t count = 0;                         ///< Number of tags present at a time.
  Location location;
};

/// A mounting position for an antenna, with its possible orientations, of which one is chosen.
struct PlanMount {
  std::string name;
  std::string zone;  ///< Zone of the reader that it is for; "" for any.
  std::vector<RigidTransform> X_WA;
  std::vector<double> power_dbm;       ///< Powers to choose from; at least one.
  AntennaParameters antenna;           ///< Without names; always has a physical model.
  std::vector<RawParameter> settings;  ///< As written in the file.
  std::vector<std::string> profiles;   ///< Files.
  double cost = 0.0;                   ///< Of the antenna with its cable and mounting.
  Location location;
};

struct PlanLimits {
  std::size_t antennas = 16;
  std::size_t readers = 4;
  std::size_t ports = 4;  ///< Of each reader.
  double reader_cost = 0.0;
  std::optional<double> cost;   ///< Of all antennas and readers.
  std::optional<double> cross;  ///< Maximum share of a zone's tags read by others' readers.
};

/// The aim for each tag, one of three.
struct PlanAim {
  /// Read probability above which more is worth nothing.
  double read_probability = 1.0;
  /// Reads within the dwell time above which more are worth nothing; at least 1.
  std::optional<double> dwell_reads;
  /// Bound on the RMS position error in the plane [m] below which less is worth nothing.
  std::optional<double> position_error_m;
  /// The share to reach: of read_probability, the mean over all tags of min(P, read_probability) /
  /// read_probability; of the other aims, the forecast share of tags that attain them. The layout
  /// that reaches it with the least is chosen. None: the best layout within the limits.
  std::optional<double> share;
  /// What to minimize once the share is reached.
  enum class Minimize { kAntennas, kCost };
  Minimize minimize = Minimize::kAntennas;
};

struct PlanSpec {
  std::vector<PlanTags> tags;
  std::vector<PlanMount> mounts;
  PlanLimits limits;
  PlanAim aim;
  double dwell_s = 10.0;   ///< Dwell time of stationary tags.
  double margin_db = 0.0;  ///< Margin required of every link.
};

/// A scenario, its world, and its section `plan`.
struct ScenarioToPlan {
  ScenarioWithWorld loaded;
  PlanSpec plan;
};

/// Reads a scenario with a section `plan`; it needs no antennas and no tags of its own. Each of its
/// own stationary tags is added as a group of one. `world_options` add to the scenario's. Throws
/// Error "FILE:LINE: …".
ScenarioToPlan load_scenario_to_plan(const std::string& path,
                                     const std::vector<Override>& overrides,
                                     Diagnostics& diagnostics,
                                     const WorldOptions& world_options = {});

}  // namespace tagfield
