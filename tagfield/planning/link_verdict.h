// SPDX-License-Identifier: Apache-2.0
/// @file
/// A link in one sentence.
#pragma once

#include <string>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// "+6.2 dB", with a minus sign as books print it; "nothing" where nothing gets there at all.
std::string signed_db(double db);

/// Sets `read` and `verdict` from all else.
void judge(const LinkQuestion& question, LinkExplanation& link);

}  // namespace tagfield
