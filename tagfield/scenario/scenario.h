// SPDX-License-Identifier: Apache-2.0
/// @file
/// What to simulate, as a plain struct. docs/scenario.md describes the YAML format.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/time.h"
#include "tagfield/channel/material.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"
#include "tagfield/motion/lift.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/reader/antenna.h"
#include "tagfield/scenario/robot_spec.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

struct Obstacles;  // of laser/simulated_laser.h

/// A moving body as seen by waves: its height and material.
struct BodySpec {
  double height_m = 1.75;
  Material material;
};

/// An obstacle taller than a robot's laser; seen from above, a disc or a rectangle.
struct ObstacleSpec {
  std::string name;
  double radius_m = 0.0;                             ///< 0 for a rectangle.
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< Of the rectangle.
  double yaw_rad = 0.0;
  /// Position of its centre, x and y; a single one if it is stationary. Before the first and after
  /// the last it stays there.
  Trajectory motion;
  Time appears;
  std::optional<Time> disappears;
  std::optional<BodySpec> body;  ///< None: invisible to waves.
  Location location;
};

/// Whether the obstacle is present at `stamp`.
bool is_there(const ObstacleSpec& spec, Time stamp);

/// The obstacles present at `stamp`, at their positions then.
Obstacles obstacles_at(const std::vector<ObstacleSpec>& specs, Time stamp);

/// Minimum distance from `p_W` to an obstacle's surface [m], negative inside; a large number if
/// there are none.
double distance_to_obstacles(const Obstacles& obstacles, const Eigen::Vector2d& p_W);

struct Scenario;

/// A part of the hall, such as a dock door or a shelf, and the readers meant to read it.
struct ZoneSpec {
  std::string name;
  Eigen::AlignedBox3d box_W;         ///< [m]; unbounded in z if the scenario gives no heights.
  std::vector<std::string> readers;  ///< Names as in reader_groups(); empty: no reader's.
  Location location;                 ///< Location in the file, for messages.
};

/// The reader group of each of the scenario's antennas: the antenna's reader, or for antennas on a
/// robot the robot, since its antennas pass the same tags along the same path.
std::vector<std::string> reader_groups(const Scenario& scenario);

/// Each of `names` once, in order of first occurrence.
std::vector<std::string> distinct(const std::vector<std::string>& names);

/// Throws Error if a zone names a reader that no antenna belongs to.
void require_readers_of_zones(const Scenario& scenario);

/// Index of the first zone that contains `p_W`; their count if none does.
std::size_t zone_at(const std::vector<ZoneSpec>& zones, const Eigen::Vector3d& p_W);

struct NavigationSpec;
struct RadioWorld;
struct TagModel;

/// An antenna and what carries it. Frame P is the carrier's: the robot's base, or the world.
struct AntennaSpec {
  AntennaParameters parameters;
  std::string on;       ///< Name of a robot, or "" for the world.
  RigidTransform X_PA;  ///< With the lift at its lowest position.
  Lift lift;            ///< Moves the antenna along P's z.
  /// Poses X_WA of an earlier run. They give the antenna's pose and its update times, instead of
  /// all of the above and of its rate. Empty if not replayed.
  Trajectory recorded;
  Location location;  ///< Location in the file, for messages.
};

/// A tag and how it moves.
struct TagSpec {
  std::string id;
  std::string on;                         ///< Name of a robot, or "" for the world.
  std::shared_ptr<const TagModel> model;  ///< Its kind, for the physical models.
  /// Poses in P; a single one for a tag at rest in P. Before the first and after the last the tag
  /// stays there.
  Trajectory motion;
  bool in_steps = false;  ///< Each pose holds until the next; else linear interpolation.
  Time appears;
  std::optional<Time> disappears;
  Location location;
};

/// Whether the tag can move in the world.
inline bool moves(const TagSpec& tag) { return !tag.on.empty() || tag.motion.size() > 1; }

struct WorldSpec {
  std::string path;                       ///< "" for empty space.
  std::vector<std::string> search_paths;  ///< For `model://`.
  bool skip_missing = false;              ///< Skips missing or broken files.
};

/// What localization knows about the tags' heights.
enum class KnownHeight {
  kTag,      ///< Each tag's own height, as from the rack that it is on.
  kAntenna,  ///< Unknown: the antennas' mean height is used.
  kNumber,   ///< One height for all, `height_m`.
  kAbove,    ///< Estimated, above the antennas.
  kBelow,    ///< Estimated, below the antennas.
};

/// The method of a scenario that is about which tags are read, without localization.
inline constexpr const char* kNoLocalization = "none";

struct LocalizationSpec {
  std::string method = "hyperbola";  ///< Or kNoLocalization.
  std::vector<std::string> compare;  ///< Methods run on the same reads, for comparison.
  MethodSettings settings;           ///< Of `method` and of the compared ones.
  TagArea area;                      ///< Where tags can be.
  EstimateLimits limits;
  KnownHeight known_height = KnownHeight::kTag;
  double height_m = 0.0;
  std::optional<bool> pi_ambiguity;  ///< As in KnownBeforehand.
  bool offset_known = false;  ///< Whether the antennas' phase offsets are known, as calibrated.
  std::vector<std::string> reference_tags;   ///< IDs of tags with known positions.
  std::optional<PoseErrorModel> pose_error;  ///< Default: that of the pose source.
};

/// How moving tags are tracked; see docs/tracking.md.
struct TrackingSpec {
  TrackingOptions options;
  std::optional<PassingLine> line;  ///< Line at which the order of the tags is reported.
};

struct Scenario {
  std::string name;
  std::string description;
  WorldSpec world;
  RadioWorldOptions materials;  ///< Materials of the world, for the physical models.
  /// The world as waves see it; null for free space.
  std::shared_ptr<const RadioWorld> radio_world;
  std::uint64_t seed = 1;
  double time_step_s = 0.01;
  std::optional<double> duration_s;  ///< If not set: until all robots have arrived.
  double real_time = 0.0;            ///< Multiple of real time to run at; 0 for as fast as it can.
  std::vector<RobotSpec> robots;
  PoseBelief pose;
  /// Robot that is driven from outside, if any, and therefore believes its wheel odometry, with the
  /// errors of navigation.odometry, whatever `pose` says of the others; not in the scenario file.
  std::string driven_robot;
  /// For PoseSource::kSlam, as in the scenario file; null for the defaults.
  std::shared_ptr<const NavigationSpec> navigation;
  std::vector<ObstacleSpec> obstacles;
  std::vector<AntennaSpec> antennas;
  std::vector<TagSpec> tags;
  std::vector<ZoneSpec> zones;  ///< Empty: each tag is meant for the reader that comes closest.
  LocalizationSpec localization;
  TrackingSpec tracking;
};

/// Source of the believed poses of one robot.
inline PoseSource pose_source_of(const Scenario& scenario, const std::string& robot) {
  const bool is_driven = !robot.empty() && robot == scenario.driven_robot;
  return is_driven ? PoseSource::kOdometry : scenario.pose.source;
}

/// Source of the run's believed poses as a whole: odometry if a robot is driven from outside.
inline PoseSource pose_source_of(const Scenario& scenario) {
  return scenario.driven_robot.empty() ? scenario.pose.source : PoseSource::kOdometry;
}

/// IDs of all tags, in the scenario's order.
inline std::vector<std::string> tags_of(const Scenario& scenario) {
  std::vector<std::string> tags;
  tags.reserve(scenario.tags.size());
  for (const TagSpec& tag : scenario.tags) tags.push_back(tag.id);
  return tags;
}

}  // namespace tagfield
