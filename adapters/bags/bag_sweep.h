// SPDX-License-Identifier: Apache-2.0
/// @file
/// One pass over a bag.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "adapters/bags/bag_content.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// Contents of the bag's messages, in order of receipt; read_bag() lists the messages that are
/// used. `sink`, which must outlive the content, receives the reads and true distances.
/// `frequency_hz` is the carrier of reads that don't state it; without it one is assumed with a
/// warning. `on_progress` is called with 0 … 1, or empty. Throws Error as read_bag().
BagContent sweep_bag(const std::string& path, std::optional<double> frequency_hz,
                     const BagReadSink& sink, const std::function<void(double share)>& on_progress,
                     Diagnostics& diagnostics);

}  // namespace tagfield
