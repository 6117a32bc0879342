// SPDX-License-Identifier: Apache-2.0
/// @file
/// What to simulate, as a plain struct. docs/scenario.md tells how to write one as YAML.
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

/// What something that moves is to waves: as high as this, and made of that.
struct BodySpec {
  double height_m = 1.75;
  Material material;
};

/// Taller than a robot's laser; seen from above a disc, or a rectangle.
struct ObstacleSpec {
  std::string name;
  double radius_m = 0.0;                             ///< 0 for a rectangle.
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< Of the rectangle.
  double yaw_rad = 0.0;
  /// Where its middle is, x and y; one position for one that stands. Before the first and after
  /// the last it stays where that is.
  Trajectory motion;
  Time appears;
  std::optional<Time> disappears;
  std::optional<BodySpec> body;  ///< None: waves don't notice it.
  Location location;
};

/// Whether it is there at `stamp`.
bool is_there(const ObstacleSpec& spec, Time stamp);

/// Those that are there at `stamp`, where they are then.
Obstacles obstacles_at(const std::vector<ObstacleSpec>& specs, Time stamp);

/// Least distance from `p_W` to an obstacle's surface at `stamp` [m], negative inside; a large
/// number where there is none.
double distance_to_obstacles(const Obstacles& obstacles, const Eigen::Vector2d& p_W);

struct Scenario;

/// A part of the hall, such as a dock door or a shelf, and the readers that shall read it.
struct ZoneSpec {
  std::string name;
  Eigen::AlignedBox3d box_W;         ///< [m]; unbounded in z where the scenario gives no heights.
  std::vector<std::string> readers;  ///< Names as of reader_groups(); none: nobody's.
  Location location;                 ///< Where it was written, for messages.
};

/// Who reads by each of the scenario's antennas: the antenna's reader, or where it rides on a robot
/// the robot, whose antennas pass the same tags on the same way.
std::vector<std::string> reader_groups(const Scenario& scenario);

/// Each of `names` once, in the order in which they come.
std::vector<std::string> distinct(const std::vector<std::string>& names);

/// Throws Error where a zone names a reader that no antenna belongs to.
void require_readers_of_zones(const Scenario& scenario);

/// The first of the zones that holds `p_W`; their count where none does.
std::size_t zone_at(const std::vector<ZoneSpec>& zones, const Eigen::Vector3d& p_W);

struct NavigationSpec;
struct RadioWorld;
struct TagModel;

/// An antenna and what carries it. Frame P is the carrier's: the robot's base, or the world.
struct AntennaSpec {
  AntennaParameters parameters;
  std::string on;       ///< Name of a robot, or "" for the world.
  RigidTransform X_PA;  ///< With the lift at its lower end.
  Lift lift;            ///< Moves the antenna along P's z.
  /// Poses X_WA of an earlier run: where the antenna is, and when it updates, instead of all of the
  /// above and of its rate. Empty for an antenna that is carried.
  Trajectory recorded;
  Location location;  ///< Where it was written, for messages.
};

/// A tag and how it moves.
struct TagSpec {
  std::string id;
  std::string on;                         ///< Name of a robot, or "" for the world.
  std::shared_ptr<const TagModel> model;  ///< What kind it is, for the physical models.
  /// Poses in P; one of them for a tag at rest in P. Before the first and after the last the
  /// tag stays where that is.
  Trajectory motion;
  bool in_steps = false;  ///< Each pose holds until the next; otherwise straight between them.
  Time appears;
  std::optional<Time> disappears;
  Location location;
};

/// Whether the tag can move in the world.
inline bool moves(const TagSpec& tag) { return !tag.on.empty() || tag.motion.size() > 1; }

struct WorldSpec {
  std::string path;                       ///< "" for empty space.
  std::vector<std::string> search_paths;  ///< For `model://`.
  bool skip_missing = false;              ///< Goes on without files that are missing or broken.
};

/// How the tags' heights are known to localization.
enum class KnownHeight {
  kTag,      ///< Each tag's own, as from the rack that it is on.
  kAntenna,  ///< Not at all: as high as the antennas in the mean.
  kNumber,   ///< One for all, in `height_m`.
  kAbove,    ///< To be estimated, above the antennas.
  kBelow,    ///< Likewise below.
};

/// The method of a scenario that asks who is read, and for no places.
inline constexpr const char* kNoLocalization = "none";

struct LocalizationSpec {
  std::string method = "hyperbola";  ///< Or kNoLocalization.
  std::vector<std::string> compare;  ///< Methods that locate the same reads, for comparison.
  MethodSettings settings;           ///< Of `method` and of those that are compared.
  TagArea area;                      ///< Where tags can be.
  EstimateLimits limits;
  KnownHeight known_height = KnownHeight::kTag;
  double height_m = 0.0;
  std::optional<bool> half_turns;  ///< As in KnownBeforehand.
  bool offset_known = false;  ///< Whether the antennas' phase offsets are known, as calibrated.
  std::vector<std::string> reference_tags;   ///< IDs of those whose places are known.
  std::optional<PoseErrorModel> pose_error;  ///< Where not told, that of the pose's source.
};

/// How moving tags are tracked; see docs/tracking.md.
struct TrackingSpec {
  TrackingOptions options;
  std::optional<PassingLine> line;  ///< At which the tags' order is told.
};

struct Scenario {
  std::string name;
  std::string description;
  WorldSpec world;
  RadioWorldOptions materials;  ///< What the world is made of, for the physical models.
  /// The world as waves see it; null for free space.
  std::shared_ptr<const RadioWorld> radio_world;
  std::uint64_t seed = 1;
  double time_step_s = 0.01;
  std::optional<double> duration_s;  ///< Where not set: until all robots have arrived.
  double real_time = 0.0;            ///< Multiple of real time to run at; 0 for as fast as it can.
  std::vector<RobotSpec> robots;
  PoseBelief pose;
  /// For PoseSource::kSlam, as the scenario's file tells it; null for what is usual.
  std::shared_ptr<const NavigationSpec> navigation;
  std::vector<ObstacleSpec> obstacles;
  std::vector<AntennaSpec> antennas;
  std::vector<TagSpec> tags;
  std::vector<ZoneSpec> zones;  ///< Empty: each tag is meant for the reader that comes nearest.
  LocalizationSpec localization;
  TrackingSpec tracking;
};

/// IDs of all tags, in the scenario's order.
inline std::vector<std::string> tags_of(const Scenario& scenario) {
  std::vector<std::string> tags;
  tags.reserve(scenario.tags.size());
  for (const TagSpec& tag : scenario.tags) tags.push_back(tag.id);
  return tags;
}

}  // namespace tagfield
