// SPDX-License-Identifier: Apache-2.0
/// @file
/// A second opinion on places that explain little of the phases.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Tags whose phases' power a located place explains by less than half, though no pose error is
/// told that would: reflections do so, but so do reads of two tags and poses of another drive. They
/// stay located only where stretches of the way by themselves (the method `robust`) locate them
/// too, within three times what both are expected to be off, and are no better known than by those.
/// For methods that take all of the way as coherent.
void refuse_unconfirmed(const LocalizationProblem& problem, int threads,
                        LocalizationResult& result);

}  // namespace tagfield
