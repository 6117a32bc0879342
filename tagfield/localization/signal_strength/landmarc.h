// SPDX-License-Identifier: Apache-2.0
/// @file
/// Nearest reference tags in signal space, after Ni et al., "LANDMARC: indoor location sensing
/// using active RFID", PerCom 2003, doi 10.1109/PERCOM.2003.1192765. docs/methods.md.
#pragma once

#include <cstddef>

#include "tagfield/localization/method.h"

namespace tagfield {

/// With fewer no tag is located: that no more than one of a hundred orders of their places may suit
/// the RSSI as well as the true one takes five, 5! = 120.
inline constexpr std::size_t kFewestReferenceTags = 5;

struct LandmarcOptions {
  std::size_t neighbours = 4;  ///< k, at least 1.
  double bin_s = 1.0;          ///< RSSI is averaged over so long; over 0.
  /// An antenna that reads one of two tags only is taken to get the weakest RSSI of all from the
  /// other, less this [dB], at least 0.
  double unread_margin_db = 3.0;
  double max_expected_error_m = 5.0;  ///< In place of the problem's limit, which is for phase.
};

/// "landmarc": all tags, one by one. Throws Error on options out of their range.
Method landmarc_method(const LandmarcOptions& options = {});

}  // namespace tagfield
