// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the numbers of reads say about their units.
#pragma once

#include <cstddef>
#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

/// ": is it in MHz?" where a unit makes a UHF carrier of it, else "".
std::string likely_unit(double carrier);

/// How a source names its numbers.
struct UnitNames {
  std::string carrier = "frequency_hz";
  std::string phase = "phase_rad";
  std::string rows = "rows";
  std::string remedy = ", which a --format tells";  ///< For phases in other units.
};

/// Looks at the numbers of all reads.
class UnitsSeen {
 public:
  /// `line`: that states it, or 0.
  void add_carrier(double carrier_hz, int line = 0);
  void add_phase(double phase_rad, int line = 0);
  /// Warns of carriers that can't be in Hz and of phases that are hardly in radians.
  void tell(const std::string& file, const UnitNames& names, Diagnostics& diagnostics) const;

 private:
  std::size_t bad_carriers_ = 0;
  double carrier_ = 0.0;  ///< The first bad one.
  int carrier_line_ = 0;
  double phase_ = 0.0;  ///< The one of greatest magnitude.
  int phase_line_ = 0;
};

}  // namespace tagfield
