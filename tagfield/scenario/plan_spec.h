// SPDX-License-Identifier: Apache-2.0
/// @file
/// What `tagfield plan` is asked: where tags can be, where antennas can be, what is allowed and
/// what is aimed at. docs/plan.md lists the keys.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {

struct TagModel;

/// Tags of one kind that can be anywhere among some places.
struct PlanTags {
  std::string name;
  std::string zone;                       ///< "" for none.
  std::shared_ptr<const TagModel> model;  ///< Never null.
  std::vector<RawParameter> settings;     ///< As they were written, for whoever writes them again.
  /// Where they can be [m]: in the world, or on the pallet where there is a path.
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Quaterniond> orientations;  ///< Each as likely.
  Trajectory path;                               ///< Of the pallet; empty for tags at rest.
  std::size_t count = 0;                         ///< Tags that there are at a time.
  Location location;
};

/// A place for an antenna, with the ways in which it can be mounted there, of which one is taken.
struct PlanMount {
  std::string name;
  std::string zone;  ///< Of the reader that it is for; "" for any.
  std::vector<RigidTransform> X_WA;
  std::vector<double> power_dbm;       ///< To choose from; at least one.
  AntennaParameters antenna;           ///< Without names; always a physical one.
  std::vector<RawParameter> settings;  ///< As they were written.
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
  std::optional<double> cross;  ///< Most share of a zone's tags that other zones' readers read.
};

/// What is aimed at, for each tag: one of three.
struct PlanAim {
  /// Probability to be read, beyond which more is worth nothing.
  double read_probability = 1.0;
  /// Reads in the dwell time, beyond which more are worth nothing; at least 1.
  std::optional<double> dwell_reads;
  /// Bound on the error of its place in the plane, root mean square [m], below which less is worth
  /// nothing.
  std::optional<double> position_error_m;
  /// Of read_probability, the mean over all tags of what they have of it; else the share of tags
  /// that have it, as forecast, that is enough: the layout that has it with the least is taken.
  /// None: the best that the limits allow.
  std::optional<double> share;
  /// Of what there is to be least of where the share is reached.
  enum class Least { kAntennas, kCost };
  Least least = Least::kAntennas;
};

struct PlanSpec {
  std::vector<PlanTags> tags;
  std::vector<PlanMount> mounts;
  PlanLimits limits;
  PlanAim aim;
  double dwell_s = 10.0;   ///< That tags at rest are there to be read.
  double margin_db = 0.0;  ///< That every link must have to spare.
};

/// A scenario, its world, and its section `plan`.
struct ScenarioToPlan {
  ScenarioWithWorld loaded;
  PlanSpec plan;
};

/// Reads a scenario with a section `plan`; it needs no antennas and no tags of its own. Tags of its
/// own that rest are a group "tags" of the plan's. `world_options` add to what the scenario says.
/// Throws Error "FILE:LINE: …".
ScenarioToPlan load_scenario_to_plan(const std::string& path,
                                     const std::vector<Override>& overrides,
                                     Diagnostics& diagnostics,
                                     const WorldOptions& world_options = {});

}  // namespace tagfield
