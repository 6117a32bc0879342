// SPDX-License-Identifier: Apache-2.0
/// @file
/// Civil time (ISO 8601), as in the clocks of other software: seconds since 1970-01-01T00:00:00Z
/// without leap seconds.
#pragma once

#include <chrono>
#include <string>

#include "tagfield/base/time.h"

namespace tagfield {

/// Parses "2020-01-01", "2020-01-01T08:30:00Z" or "2020-01-01T08:30:00.25+01:00", as time since
/// 1970. Throws Error on anything else, and before 1830 or after 2114.
Time utc_from_text(const std::string& text);

/// "2020-01-01T08:30:00.250Z", with 0 to 9 decimals, truncated; in another zone
/// "2020-01-01T09:30:00.250+01:00".
std::string utc_text(Time since_1970, int decimals, std::chrono::minutes zone = {});

/// "+01:00", and back: within ±14 hours. Throws Error on anything else.
std::string zone_text(std::chrono::minutes zone);
std::chrono::minutes zone_from_text(const std::string& text);

}  // namespace tagfield
