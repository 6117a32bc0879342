// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/units_seen.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "tagfield/base/read_range.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Readers report one or two cycles.
constexpr double kUsualPhase_rad = 2.0 * kTwoPi + 0.1;

}  // namespace

std::string likely_unit(double carrier) {
  constexpr double kLeast_hz = 3e8;
  constexpr double kMost_hz = 3e9;
  constexpr std::pair<const char*, double> kUnits[] = {{"kHz", 1e3}, {"MHz", 1e6}, {"GHz", 1e9}};
  for (const auto& [name, hertz] : kUnits) {
    const double carrier_hz = carrier * hertz;
    if (carrier_hz >= kLeast_hz && carrier_hz <= kMost_hz) {
      return fmt::format(": is it in {}?", name);
    }
  }
  return "";
}

void UnitsSeen::add_carrier(double carrier_hz, int line) {
  if (is_carrier(carrier_hz)) return;
  if (bad_carriers_++ > 0) return;
  carrier_ = carrier_hz;
  carrier_line_ = line;
}

void UnitsSeen::add_phase(double phase_rad, int line) {
  if (std::abs(phase_rad) <= std::abs(phase_)) return;
  phase_ = phase_rad;
  phase_line_ = line;
}

void UnitsSeen::tell(const std::string& file, const UnitNames& names,
                     Diagnostics& diagnostics) const {
  if (bad_carriers_ > 0) {
    diagnostics.warn(
        {file, carrier_line_},
        fmt::format("{} is {:.10g}, expected a carrier in Hz, from {:g} to {:g}{}{}", names.carrier,
                    carrier_, kMinCarrierHz, kMaxCarrierHz, likely_unit(carrier_),
                    bad_carriers_ > 1
                        ? fmt::format(" ({} {} are like that)", bad_carriers_, names.rows)
                        : ""));
  }
  if (std::abs(phase_) > kUsualPhase_rad) {
    diagnostics.warn(
        {file, phase_line_},
        fmt::format("{} is {}: whole cycles are dropped, which is right for unwrapped phases in "
                    "radians, but not for degrees or steps of a cycle{}",
                    names.phase, phase_, names.remedy));
  }
}

}  // namespace tagfield
