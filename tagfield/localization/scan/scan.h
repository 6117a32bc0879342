// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization of tags beside a short straight scan, such as along a rail, amid reflections: phase
/// and RSSI are combined into a field that arrives by two paths, and the distances of all tags are
/// pooled. docs/methods.md has the equations and the figures.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

struct ScanOptions {
  double max_range_m = 4.0;  ///< Maximum distance of a tag from the scan; over 0.5.
  double max_error_m = 0.5;  ///< Maximum expected error of a located tag; over 0.
  double min_share = 0.7;    ///< Minimum share of the field's power in two paths; in (0, 1].
};

/// Method "scan": all tags together. Throws Error on options out of range.
Method scan_method(const ScanOptions& options = {});

}  // namespace tagfield
