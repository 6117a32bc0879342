// SPDX-License-Identifier: Apache-2.0
/// @file
/// What antennas at rest read of a tag: a mean strength each, and a mean phase for each channel.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Reads of one channel, whose phases agree as far as `mean` is long.
struct ChannelPhase {
  std::complex<double> mean;  ///< Of e^(jφ).
  double reads = 0.0;
};

/// Of one tag by one antenna.
struct FixedReads {
  std::string antenna;
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();
  Eigen::Vector3d boresight_W = Eigen::Vector3d::UnitX();
  double rssi_dbm = 0.0;                    ///< Mean over the reads that have one;
  double strengths = 0.0;                   ///< so many.
  std::map<double, ChannelPhase> channels;  ///< By carrier [Hz].
};

/// By all antennas that stood; those that moved are left out.
std::vector<FixedReads> fixed_reads(const LocalizationProblem& problem,
                                    const SamplesOfTag& samples);

}  // namespace tagfield
