// SPDX-License-Identifier: Apache-2.0
/// @file
/// Nearest reference tags in signal space, after Ni et al., "LANDMARC: indoor location sensing
/// using active RFID", PerCom 2003, doi 10.1109/PERCOM.2003.1192765. docs/methods.md.
#pragma once

#include <cstddef>

#include "tagfield/localization/method.h"

namespace tagfield {

/// With fewer, no tag is located: a permutation test at the 1 % level needs at least five tags, as
/// 5! = 120.
inline constexpr std::size_t kFewestReferenceTags = 5;

struct LandmarcOptions {
  std::size_t neighbours = 4;  ///< k, at least 1.
  double bin_s = 1.0;          ///< RSSI is averaged over this time; over 0.
  /// If an antenna reads only one of two tags, the other's RSSI is taken as the weakest of all
  /// minus this [dB], at least 0.
  double unread_margin_db = 3.0;
  double max_expected_error_m = 5.0;  ///< Replaces the problem's limit, which is for phase.
};

/// Method "landmarc": each tag independently. Throws Error on options out of range.
Method landmarc_method(const LandmarcOptions& options = {});

}  // namespace tagfield
