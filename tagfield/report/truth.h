/// @file
/// What really was, as the simulator knows it: read by this room alone, to judge estimates.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/files.h"

namespace tagfield {

/// Where a tag was from a time on.
struct TagPosition {
  Time stamp;
  std::string tag;
  Eigen::Vector3d p_WT;  ///< [m]
};

/// The distance behind one read.
struct TrueDistance {
  Time stamp;
  std::string antenna;
  std::string tag;
  double distance_m = 0.0;
};

struct Truth {
  std::vector<AntennaPose> antenna_poses;  ///< A fixed antenna has one row.
  std::vector<AntennaPose> robot_poses;    ///< `antenna` holds the robot's name.
  std::vector<TagPosition> tag_positions;  ///< A tag at rest has one row, at its appearance.
  std::vector<TrueDistance> distances;     ///< A row a read, in the order of the reads.
};

/// Adds truth/antenna_poses.csv, truth/robot_poses.csv, truth/tags.csv (`stamp_s,tag,x_m,y_m,z_m`)
/// and truth/distances.csv (`stamp_s,antenna,tag,distance_m`).
void stage_truth(const Truth& truth, StagedFolder& folder);

/// Reads them from a run's folder, distances excepted (nothing judges by them). Throws Error if one
/// is missing or malformed.
Truth read_truth(const std::string& run_folder);

}  // namespace tagfield
