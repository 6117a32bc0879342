// SPDX-License-Identifier: Apache-2.0
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
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// One phase measured at one place.
struct PhaseSample {
  Time stamp;
  double phase_rad = 0.0;     ///< In [0, 2π).
  double frequency_hz = 0.0;  ///< Carrier.
  Eigen::Vector3d p_WA;       ///< Antenna [m].
  double rssi_dbm = 0.0;
};

/// Stands for an RSSI that was not reported [dBm].
inline constexpr double kNoRssi = -200.0;

/// Samples of one tag, by antenna, each in rising order of time.
using SamplesOfTag = std::map<std::string, std::vector<PhaseSample>>;

/// All samples, by tag.
using SamplesByTag = std::map<std::string, SamplesOfTag>;

struct BelievedTrack;

/// The antennas' believed poses by antenna, in rising order of time. Poses that are not finite,
/// repeat a stamp, or whose clock must have been wrong (strays.h) are left out, which is counted in
/// one warning for each antenna.
std::map<std::string, BelievedTrack> tracks_of(const std::vector<AntennaPose>& poses,
                                               Diagnostics& diagnostics);

/// Whether the reads have phases: false of eight or more whose phases are all one, as of readers
/// and tables that have none and say 0.
bool has_phases(const std::vector<TagRead>& reads);

/// Joins reads with the antennas' poses, interpolated at each read's stamp. A read whose antenna
/// has no pose at its stamp (poses further apart than `max_pose_gap_s` while the antenna moved, or
/// the stamp before the first or after the last) is left out and counted in one warning for each
/// antenna, which says why. An antenna with one pose stands still. Two reads of a tag by an antenna
/// at the same stamp: the first counts, and a warning counts the others. Reads whose clock must
/// have been wrong (strays.h) are left out, which is told, too.
SamplesByTag join_reads_with_tracks(const std::vector<TagRead>& reads,
                                    const std::map<std::string, BelievedTrack>& tracks,
                                    double max_pose_gap_s, Diagnostics& diagnostics);

}  // namespace tagfield
