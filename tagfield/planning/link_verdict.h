// SPDX-License-Identifier: Apache-2.0
/// @file
/// Summary of a link in one sentence.
#pragma once

#include <string>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// "+6.2 dB", with a typographic minus sign; "nothing" if no power arrives at all.
std::string signed_db(double db);

/// Sets `read` and `verdict` from the other members.
void judge(const LinkQuestion& question, LinkExplanation& link);

}  // namespace tagfield
