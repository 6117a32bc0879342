/// @file
/// Distances from signal strength: RSSI falls by a straight line over the logarithm of the
/// distance, whose slope and height are estimated too. docs/methods.md has the equations and the
/// figures.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/method_settings.h"

namespace tagfield {

/// "trilateration": one slope for all, then all tags, one by one. Throws Error on options out of
/// their range.
Method trilateration_method(const TrilaterationOptions& options);

}  // namespace tagfield
