// SPDX-License-Identifier: Apache-2.0
/// @file
/// An explained link as human-readable text.
#pragma once

#include <string>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// The verdict first, then budgets, receiver and paths.
std::string to_text(const LinkExplanation& link);

}  // namespace tagfield
