// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tags beside a short straight scan, as along a rail, amid reflections: phase and RSSI together as
/// a field that comes by two paths, and the distances of all tags pooled. docs/methods.md has the
/// equations and the figures.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

struct ScanOptions {
  double max_range_m = 4.0;  ///< No tag is further from the scan; over 0.5.
  double max_error_m = 0.5;  ///< A place expected to be worse is not given; over 0.
  double min_share = 0.7;    ///< Of the field's power, that two paths explain; in (0, 1].
};

/// "scan": all tags together. Throws Error on options out of their range.
Method scan_method(const ScanOptions& options = {});

}  // namespace tagfield
