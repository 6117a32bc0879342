// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a distance does to the phases of many channels: they fall apart by 4π Δf/c r. Each port's
/// channels have offsets of their own, which only tags at known places or a calibration tell.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/fixed/fixed_reads.h"

namespace tagfield {

/// Of one channel of a port.
struct ChannelTurn {
  std::complex<double> turn{1.0,
                            0.0};  ///< e^(j offset), the same tag's in all channels but for one.
  double references = 0.0;         ///< Tags that told it; 0: it is exact.
};

/// Offsets by antenna and carrier [Hz].
using ChannelTurns = std::map<std::string, std::map<double, ChannelTurn>>;

/// By the tags at known places and what is known beforehand (`offset_known`).
ChannelTurns channel_offsets(const LocalizationProblem& problem);

/// Whether phases show the carriers in another order than was told, as of a reader whose hop table
/// was not asked for. Neighbours' phases differ by the same at all places; those of channels far
/// apart differ by the distance. Of few tags or channels nothing is seen.
bool is_out_of_order(const std::vector<std::vector<FixedReads>>& tags);

/// How a hall bends phases: waves from everywhere of so much of the power, late by `delay_s` in the
/// mean, and noise of a read. Shares of 1.
struct PhaseField {
  double diffuse = 0.0;
  double delay_s = 20e-9;
  double noise = 0.01;
};

/// ln of the likelihood over distances, but for a constant.
struct RangeLikelihood {
  double first_m = 0.0, step_m = 0.0;
  Eigen::ArrayXd log;
};

/// Of the direct wave with diffuse ones, over phases alone (half of the complex normal law's
/// logarithm: only one of the two quadratures is seen). Empty where fewer than three channels have
/// offsets.
RangeLikelihood range_likelihood(const FixedReads& reads, const ChannelTurns& offsets,
                                 const PhaseField& field, double most_m, double step_m);

/// Greatest ln within `reach_m` of the distance.
double most_likely(const RangeLikelihood& of, double distance_m, double reach_m);

}  // namespace tagfield
