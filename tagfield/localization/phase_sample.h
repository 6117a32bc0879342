/// @file
/// A read joined with where its antenna was believed to be.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/time.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/reader/tag_read.h"

namespace tagfield {

/// One phase measured at one place.
struct PhaseSample {
  Time stamp;
  double phase_rad = 0.0;     ///< In [0, 2π).
  double frequency_hz = 0.0;  ///< Carrier.
  Eigen::Vector3d p_WA;       ///< Antenna [m].
};

/// Samples of one tag, by antenna, each in rising order of time.
using SamplesOfTag = std::map<std::string, std::vector<PhaseSample>>;

/// All samples, by tag.
using SamplesByTag = std::map<std::string, SamplesOfTag>;

/// Joins reads with the antennas' poses, interpolated at each read's stamp. A read whose antenna
/// has no pose at its stamp (poses further apart than `max_pose_gap_s` while the antenna moved, or
/// the stamp before the first or after the last) is left out and counted in one warning for each
/// antenna. An antenna with one pose stands still. Two reads of a tag by an antenna at the same
/// stamp: the first counts.
SamplesByTag join_reads_with_poses(const std::vector<TagRead>& reads,
                                   const std::vector<AntennaPose>& poses, double max_pose_gap_s,
                                   Diagnostics& diagnostics);

}  // namespace tagfield
