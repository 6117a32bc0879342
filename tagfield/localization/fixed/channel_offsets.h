// SPDX-License-Identifier: Apache-2.0
/// @file
/// Ranging by the phases of many channels, which spread with distance by 4π Δf/c r. Each channel of
/// each port has its own phase offset, known only from tags at known positions or a calibration.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/fixed/fixed_reads.h"

namespace tagfield {

/// Phase offset of one channel of a port.
struct ChannelTurn {
  std::complex<double> turn{1.0, 0.0};  ///< e^(j offset), up to a turn common to all channels.
  double references = 0.0;              ///< Number of tags that it was estimated from; 0: exact.
};

/// Offsets by antenna and carrier [Hz].
using ChannelTurns = std::map<std::string, std::map<double, ChannelTurn>>;

/// Estimates the offsets from the tags at known positions and from prior knowledge
/// (`offset_known`).
ChannelTurns channel_offsets(const LocalizationProblem& problem);

/// Whether the phases contradict the given order of the carriers, as for a reader whose hop table
/// was never queried. The phase difference of neighbouring channels is the same at all positions;
/// that of distant channels varies with range. False if there are too few tags or channels to tell.
bool is_out_of_order(const std::vector<std::vector<FixedReads>>& tags);

/// Effect of a hall's multipath on phases: diffuse waves with this fraction of the power and this
/// mean excess delay, and noise per read. `diffuse` and `noise` are fractions of 1.
struct PhaseField {
  double diffuse = 0.0;
  double delay_s = 20e-9;
  double noise = 0.01;
};

/// ln of the likelihood over distances, up to a constant.
struct RangeLikelihood {
  double first_m = 0.0, step_m = 0.0;
  Eigen::ArrayXd log;
};

/// Range likelihood under a model of a direct wave plus diffuse waves, from phases alone (half of
/// the logarithm of the complex normal density: only one of the two quadratures is observed). Empty
/// if fewer than three channels have offsets.
RangeLikelihood range_likelihood(const FixedReads& reads, const ChannelTurns& offsets,
                                 const PhaseField& field, double max_m, double step_m);

/// Maximum of the log-likelihood within `reach_m` of the distance.
double most_likely(const RangeLikelihood& of, double distance_m, double reach_m);

}  // namespace tagfield
