// SPDX-License-Identifier: Apache-2.0
/// @file
/// The quantity that sweeps are sorted and halved by.
#pragma once

#include <cstddef>
#include <limits>

#include "tagfield/experiment/bench/suite.h"

namespace tagfield {

/// Anything without a value for the target comes last.
inline constexpr double kLastTargetValue = std::numeric_limits<double>::infinity();

/// Value of the target for EntryStatistics or a SweepRow, whose members have the same names; less
/// is better.
template <typename Statistics>
double target_value(const Statistics& all, SweepTarget target) {
  const auto share = [&](std::size_t count) {
    return all.tags == 0 ? kLastTargetValue
                         : static_cast<double>(count) / static_cast<double>(all.tags);
  };
  const auto error = [&](double ErrorStatistics::*of) {
    return all.error_m ? (*all.error_m).*of : kLastTargetValue;
  };
  switch (target) {
    case SweepTarget::kMean:
      return error(&ErrorStatistics::mean);
    case SweepTarget::kMedian:
      return error(&ErrorStatistics::median);
    case SweepTarget::kP95:
      return error(&ErrorStatistics::p95);
    case SweepTarget::kMax:
      return error(&ErrorStatistics::max);
    case SweepTarget::kLocated:
      return all.tags == 0 ? kLastTargetValue : -share(all.located);
    case SweepTarget::kWrong:
      return share(all.wrong);
    case SweepTarget::kFalseClaims:
      return share(all.false_claims);
  }
  return kLastTargetValue;
}

}  // namespace tagfield
