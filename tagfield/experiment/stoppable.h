// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization that can be stopped.
#pragma once

#include <atomic>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Thrown by the callbacks below, through the method that calls them.
struct LocatingStopped {};

/// Makes both callbacks of a localization throw LocatingStopped once `stop` is set: that of its
/// progress, after each tag, and that of paths through a known world, unless it is null, on which
/// methods may spend long for one tag. Does nothing if `stop` is null.
void make_stoppable(const std::atomic<bool>* stop, OnLocating& on_locating, TraceReplies& trace);

}  // namespace tagfield
