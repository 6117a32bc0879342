// SPDX-License-Identifier: Apache-2.0
/// @file
/// Confirmation, by a second method, of positions that explain little of the phases.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Checks tags whose position explains less than half of the phases' power although no pose error
/// was stated that could account for it. Reflections cause this, but so do reads of two tags and
/// poses of another drive. Such tags stay located only if separate sections of the path (the method
/// `robust`) locate them too, within three times their combined expected error, and their expected
/// error is then at least that of `robust`. Applies to methods that treat the whole path as
/// coherent. Where `joint` corrects the poses, this applies to tags whose residuals are over twice
/// the median of all located ones, if there are at least four: they are at another minimum, or have
/// moved.
void refuse_unconfirmed(const LocalizationProblem& problem, int threads,
                        LocalizationResult& result);

}  // namespace tagfield
