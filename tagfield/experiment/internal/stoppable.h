// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization that can be stopped.
#pragma once

#include <atomic>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Thrown by the callbacks below, through the method that calls them.
struct LocatingStopped {};

/// The callback, which throws LocatingStopped once `stop` is set; itself if `stop` is null.
OnLocating stoppable(OnLocating on_locating, const std::atomic<bool>* stop);

/// The same for paths through the known world, on which methods may spend long for each tag. Null
/// stays null.
TraceReplies stoppable(TraceReplies trace, const std::atomic<bool>* stop);

}  // namespace tagfield
