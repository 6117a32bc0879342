// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads of a tag by stationary antennas, reduced to a mean RSSI per antenna and a mean phase per
/// channel.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Reads on one channel; the magnitude of `mean` measures how well their phases agree.
struct ChannelPhase {
  std::complex<double> mean;  ///< Mean of e^(jφ).
  double reads = 0.0;
};

/// Reads of one tag by one antenna.
struct FixedReads {
  std::string antenna;
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();
  Eigen::Vector3d boresight_W = Eigen::Vector3d::UnitX();
  double rssi_dbm = 0.0;                    ///< Mean over the reads that have one;
  double strengths = 0.0;                   ///< Number of those reads.
  std::map<double, ChannelPhase> channels;  ///< By carrier [Hz].
};

/// Reads by all stationary antennas; those that moved are left out.
std::vector<FixedReads> fixed_reads(const LocalizationProblem& problem,
                                    const SamplesOfTag& samples);

}  // namespace tagfield
