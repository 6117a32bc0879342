/// @file
/// An explained link as text for people and as JSON for machines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// The verdict first, then budgets, receiver and paths.
std::string to_text(const LinkExplanation& link);

/// All of it; powers of what never arrives are null.
nlohmann::ordered_json to_json(const LinkExplanation& link);

}  // namespace tagfield
